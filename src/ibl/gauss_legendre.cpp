#include "ibl/gauss_legendre.h"

#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {

// The zeros of the Legendre polynomial by Newton's method from Tricomi's estimate (Abramowitz &
// Stegun 22.16.6), the weights 2 / ((1 - x^2) P'(x)^2) (25.4.29).
GaussRule gauss_legendre(int points) {
    constexpr int kIterations = 8;
    GaussRule rule;
    for (int i = points; i >= 1; --i) {
        double x = std::cos(kPi * (i - 0.25) / (points + 0.5));
        double slope = 1;
        for (int iteration = 0; iteration < kIterations; ++iteration) {
            double before = 1;
            double legendre = x;
            for (int k = 2; k <= points; ++k) {
                const double next = ((2 * k - 1) * x * legendre - (k - 1) * before) / k;
                before = legendre;
                legendre = next;
            }
            slope = points * (x * legendre - before) / (x * x - 1);
            x -= legendre / slope;
        }
        rule.nodes.push_back(x);
        rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace aureole::ibl
