// From 0 to 1 without corners.
#pragma once

#include <algorithm>

namespace aureole {

// 0 up to `from`, 1 from `to` on, between them a cubic that is level at both ends. from < to.
inline double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace aureole
