// Reflectance of every face by the cosine of incidence, tabulated for tracing in bulk.
#pragma once

#include <span>
#include <vector>

#include "aureole/lens/lens.h"

namespace aureole::lens {

// For all faces of a lens and some wavelengths; built by several threads.
class ReflectanceTable {
  public:
    ReflectanceTable(const Lens& lens, std::span<const double> wavelengths_nm);

    // kReflectanceSamples pairs (s, p) by the cosine on the side that light comes from; total
    // reflection is 1. `backwards`: light travels towards the scene.
    const float* pairs(int face, int band, bool backwards) const;
    // Of the whole lens for light along the axis: T_0.
    double axial_transmission(int band) const {
        return axial_transmission_[static_cast<std::size_t>(band)];
    }

  private:
    std::size_t offset(std::size_t face, std::size_t band, bool backwards) const;

    std::size_t faces_ = 0;
    std::vector<float> samples_;
    std::vector<double> axial_transmission_;
};

}  // namespace aureole::lens
