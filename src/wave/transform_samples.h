// What every reader of a transform needs to know about its samples: the ring they belong to, and
// how much of their light the raster has swallowed.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/wave/aperture.h"

namespace aureole::wave {

// ring[k] for k = 0 .. samples / 2 of the row at distance |l| from the axis. Ring r ends where
// k^2 + l^2 exceeds (r + 1/2)^2, that is (in integers) r^2 + r; along a row it grows by at most
// one per sample.
inline void ring_row(int samples, int l, std::int32_t* ring) {
    const std::int64_t l2 = static_cast<std::int64_t>(l) * l;
    std::int64_t r = l < 0 ? -l : l;
    for (std::int64_t k = 0; k <= samples / 2; ++k) {
        r += k * k + l2 > r * r + r ? 1 : 0;
        ring[k] = static_cast<std::int32_t>(r);
    }
}

// 1 / sinc^2(pi k / N) for k = 0 .. N/2. A sample of a mask is a mean over its square, which
// multiplies the transform by sinc(pi k / N) sinc(pi l / N): .41 of the intensity is left at
// the end of either axis. The product of two of these factors restores |F|^2.
// All 1 for a field whose samples are not means.
inline std::vector<float> box_filter_gain(const Field& field) {
    const int samples = field.grid.samples;
    std::vector<float> gain(static_cast<std::size_t>(samples / 2) + 1, 1.0F);
    if (!field.box_filtered) return gain;
    for (std::size_t k = 1; k < gain.size(); ++k) {
        const double x = kPi * static_cast<double>(k) / samples;
        gain[k] = static_cast<float>(std::pow(x / std::sin(x), 2));
    }
    return gain;
}

}  // namespace aureole::wave
