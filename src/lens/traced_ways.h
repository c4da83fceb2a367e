// The ways of all ghosts at all wavelengths, ready for the ray kernels.
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

    std::span<const RayStep> way(int ghost, int band) const;
    float sensor_distance_mm() const { return sensor_distance_mm_; }  // from the last vertex
    double axial_transmission(int band) const { return table_.axial_transmission(band); }

  private:
    int bands_ = 0;
    ReflectanceTable table_;
    std::vector<RayStep> steps_;
    std::vector<std::size_t> first_;  // of ghost * bands + band, and the end
    float sensor_distance_mm_ = 0;
};

// What the kernels need to know of an iris. Points into it.
IrisField iris_field(const Iris& iris);

}  // namespace aureole::lens
