// How patterns end where the band of their raster does.
#pragma once

#include <cstddef>

#include "aureole/base/smoothstep.h"
#include "aureole/wave/spectral_psf.h"

namespace aureole::eye {

// Streaks fade out over this last part of the transform's half width, so that no wavelength's band
// ends in a visible (and, as bands scale with wavelength, coloured) square.
inline constexpr double kStreaksFade = 0.35;

// 1 inside, falling to 0 at the transform's half width over the given share of it.
inline double band_fade(std::size_t ring, int samples, double share) {
    const double half = samples / 2.0;
    return smoothstep(0, share, 1 - static_cast<double>(ring) / half);
}

// Of streaks, times `scale`.
inline wave::RingWeights streak_weights(int samples, double scale) {
    wave::RingWeights weights;
    weights.scale.resize(static_cast<std::size_t>(samples / 2));
    for (std::size_t ring = 0; ring < weights.scale.size(); ++ring) {
        weights.scale[ring] = static_cast<float>(band_fade(ring, samples, kStreaksFade) * scale);
    }
    return weights;
}

}  // namespace aureole::eye
