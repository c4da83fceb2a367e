// The prefiltered environment without approximation: the oracle for the methods of prefilter.h.
//
// The environment is taken as constant over each texel. P(N, a) is then the sum over all texels of
// their radiance times the integral of w(L) over them, divided by the integral of w over the
// hemisphere, which is known in closed form. The integrals over texels are good to about 1e-6 of
// their own.
//
// FilterMethod::kExact fills whole levels this way, 64 neighbours at a time, which is some seven
// times faster per texel; this class is for single directions, to measure errors on a sample.
#pragma once

#include <array>
#include <memory>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

class ExactFilter {
  public:
    // Keeps no reference to `environment`, which is finite; needs about 25 bytes per texel.
    // Throws InvalidArgument if it is empty.
    explicit ExactFilter(const CubeMap& environment);
    ~ExactFilter();
    ExactFilter(ExactFilter&&) noexcept;
    ExactFilter& operator=(ExactFilter&&) noexcept;

    // P(normal, alpha), R, G, B. alpha = roughness^2 in (0, 1]; below 1e-5 it counts as 1e-5, when
    // the lobe is far narrower than any texel. `normal` may have any length but 0. Takes some
    // milliseconds for 256 x 256 texels per face. From any number of threads.
    std::array<double, 3> at(const Direction& normal, double alpha) const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::ibl
