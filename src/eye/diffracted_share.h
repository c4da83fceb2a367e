// How much of the light goes into the halo and the streaks.
#pragma once

#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"

namespace aureole::eye {

// Whether the pupil shows any of the lens fibres.
inline bool shows_fibres(const Eye& eye) noexcept {
    return pupil_axes(eye).long_mm / 2 > eye.anatomy.gratings.inner_radius_mm &&
           eye.anatomy.gratings.phase_rad != 0;
}

// w_h, and 0 where there is no halo to be weighted.
inline double visible_halo_weight(const Eye& eye) {
    return shows_fibres(eye) ? halo_weight(eye) : 0;
}

// At most half of the light goes there, whatever the looks ask for: what a share of both together
// must be multiplied by.
inline double diffracted_limit(double share) noexcept {
    constexpr double kMost = 0.5;
    return share > kMost ? kMost / share : 1;
}

}  // namespace aureole::eye
