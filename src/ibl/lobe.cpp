#include "ibl/lobe.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// sin^2 of the angle between half vector and normal that a share y of D (N.H) dw is within: the
// complement of Karis' cos^2 = (1 - y) / (1 + (a^2 - 1) y), exact for small angles too.
double half_sine2(double y, double alpha2) { return alpha2 * y / (1 - (1 - alpha2) * y); }

// N.L = 2 (N.H)^2 - 1.
double light_cosine(double y, double alpha2) { return 1 - 2 * half_sine2(y, alpha2); }

constexpr int kTableIntervals = 1024;

}  // namespace

// In y the density of half vectors is even, so that of D (N.L) is N.L itself, as a function of y:
// smooth, but for small alpha it falls from 1 to 0 in the last alpha^2 before the horizon, where
// y = 1 / (1 + alpha^2). Nodes get denser towards there.
Lobe::Lobe(double alpha, LobeDensity density) : density_(density) {
    const double a = std::clamp(alpha, kLeastAlpha, 1.0);
    alpha2_ = a * a;
    if (density == LobeDensity::kHalfVector) return;
    const double horizon = 1 / (1 + alpha2_);
    for (int i = 0; i <= kTableIntervals; ++i) {
        const double rest = 1 - static_cast<double>(i) / kTableIntervals;
        y_.push_back(horizon * (1 - rest * rest * rest));
        cosine_.push_back(i == kTableIntervals ? 0 : light_cosine(y_.back(), alpha2_));
        integral_.push_back(i == 0 ? 0
                                   : integral_.back() +
                                         (y_.end()[-1] - y_.end()[-2]) *
                                             (cosine_.end()[-1] + cosine_.end()[-2]) / 2);
    }
}

double Lobe::light_y(double y) const noexcept {
    const double wanted = y * integral_.back();
    const auto above = std::upper_bound(integral_.begin() + 1, integral_.end() - 1, wanted);
    const auto i = static_cast<std::size_t>(above - integral_.begin());
    // Between two nodes N.L is a straight line and its integral a parabola:
    // rest = c0 h + slope h^2 / 2, in the form without cancellation.
    const double rest = wanted - integral_[i - 1];
    const double slope = (cosine_[i] - cosine_[i - 1]) / (y_[i] - y_[i - 1]);
    const double root =
        std::sqrt(std::max(0.0, cosine_[i - 1] * cosine_[i - 1] + 2 * slope * rest));
    return std::min(y_[i], y_[i - 1] + 2 * rest / (cosine_[i - 1] + root));
}

Lobe::Sample Lobe::sample(const SquarePoint& point) const noexcept {
    const double y = density_ == LobeDensity::kLight ? light_y(point.y) : point.y;
    const double sine2 = half_sine2(y, alpha2_);
    const double cosine = 1 - 2 * sine2;
    const double sine = 2 * std::sqrt(sine2 * (1 - sine2));
    const double azimuth = 2 * kPi * point.x;
    // D (Walter et al. 2007, eq. 33), and dw of half vectors = dw of light / (4 V.H).
    const double denominator = sine2 + alpha2_ * (1 - sine2);
    const double half_density = alpha2_ / (kPi * denominator * denominator) / 4;
    Sample sample;
    sample.light = {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
    if (density_ == LobeDensity::kLight) {
        sample.weight = 1;
        sample.density_per_sr = half_density * std::max(0.0, cosine) / integral_.back();
    } else {
        sample.weight = std::max(0.0, cosine);
        sample.density_per_sr = half_density;
    }
    return sample;
}

}  // namespace aureole::ibl
