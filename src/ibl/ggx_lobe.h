// The weight of light in a prefiltered environment (prefilter.h) and its integral.
#pragma once

#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {

// With mu = N.L, w = mu / q^2 where q = 1 - (1 - a^2) (1 + mu) / 2 = a^2 + b (1 - mu), which is a^2
// in the middle of the lobe.
struct GgxLobe {
    explicit GgxLobe(double alpha) : a2(alpha * alpha), b((1 - alpha * alpha) / 2) {}

    double a2 = 1;
    double b = 0;

    double weight(double mu) const {
        const double q = a2 + b * (1 - mu);
        return mu > 0 ? mu / (q * q) : 0;
    }

    // Over the hemisphere, in sr. Substituting q for mu gives 2 pi (y - ln(1 + y)) / b^2 with
    // y = b / a^2; where b is small its series takes over.
    double integral() const {
        const double y = b / a2;
        if (y < 1e-3) return 2 * kPi / (a2 * a2) * (0.5 - y / 3 + y * y / 4 - y * y * y / 5);
        return 2 * kPi * (y - std::log1p(y)) / (b * b);
    }
};

}  // namespace aureole::ibl
