// The ways of ghosts at some wavelengths, ready for the ray kernels.
#pragma once

#include <span>
#include <vector>

#include "aureole/lens/ghosts.h"
#include "aureole/lens/iris.h"
#include "lens/ray_kernels.h"
#include "lens/reflectance_table.h"

namespace aureole::lens {

class TracedWays {
  public:
    TracedWays(const Lens& lens, std::span<const Bounces> ghosts,
               std::span<const double> wavelengths_nm);

    // Room for the steps of any way.
    std::vector<RayStep> scratch() const;
    // Of a ghost at a wavelength, both by their index; written to `scratch`.
    std::span<const RayStep> way(int ghost, int wavelength,
                                 std::vector<RayStep>& scratch) const noexcept;
    float sensor_distance_mm() const { return sensor_distance_mm_; }  // from the last vertex
    double axial_transmission(int wavelength) const {
        return table_.axial_transmission(wavelength);
    }

  private:
    RayStep step_at(const Step& step, std::size_t wavelength) const noexcept;

    std::vector<Face> faces_;
    std::vector<std::vector<double>> indices_;  // by wavelength, by medium
    ReflectanceTable table_;
    std::vector<Step> steps_;
    std::vector<std::size_t> first_;  // of each ghost, and the end
    std::size_t longest_ = 0;
    float sensor_distance_mm_ = 0;
};

// What the kernels need to know of an iris. Points into it.
IrisField iris_field(const Iris& iris);

}  // namespace aureole::lens
