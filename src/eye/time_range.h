// Moments that an eye may be asked about.
#pragma once

#include <algorithm>

#include "aureole/eye/ranges.h"

namespace aureole::eye {

// The nearest one to a time. Of what is no number it is the first.
inline double nearest_moment_s(double time_s) noexcept {
    return time_s >= -kFarthestTimeS ? std::min(time_s, kFarthestTimeS) : -kFarthestTimeS;
}

}  // namespace aureole::eye
