// What the tests of starbursts measure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/lens/starburst.h"

namespace aureole::lens {

// One band of the spectrum lies at the geometric mean of its ends.
inline const double kOneBandMm = mm_from_nm(std::sqrt(380.0 * 770.0));
inline constexpr StarburstOptions kOneBand{.samples = 1024, .bands = 1};
inline constexpr StarburstOptions kSmall{.samples = 1024};

// Pixels of q lambda / D.
inline wave::KernelGrid grid_of(int size, double q, double diameter_mm) {
    return {size, size, deg_from_rad(q * kOneBandMm / diameter_mm), Projection::kConstantPitch};
}

// Sum over pixels of channel c, each times share(dx, dy), dy upwards.
inline double sum(const wave::Psf& psf, int c, const std::function<double(int, int)>& share) {
    double total = 0;
    const int w = psf.grid.width / 2;
    const int h = psf.grid.height / 2;
    for (int y = -h; y <= h; ++y) {
        for (int x = -w; x <= w; ++x) {
            total += static_cast<double>(psf.kernel.at(x + w, h - y, c)) * share(x, y);
        }
    }
    return total;
}

// The part of a pixel within `radius` pixels of the axis.
inline double inside_circle(int x, int y, double radius) {
    const double r = std::hypot(x, y);
    if (r < radius - 1) return 1;
    if (r > radius + 1) return 0;
    constexpr int kParts = 32;
    int inside = 0;
    for (int j = 0; j < kParts; ++j) {
        for (int i = 0; i < kParts; ++i) {
            const double dx = x + (i + 0.5) / kParts - 0.5;
            const double dy = y + (j + 0.5) / kParts - 0.5;
            inside += dx * dx + dy * dy < radius * radius ? 1 : 0;
        }
    }
    return static_cast<double>(inside) / (kParts * kParts);
}

inline double encircled(const wave::Psf& psf, int c, double radius_px) {
    return sum(psf, c, [=](int x, int y) { return inside_circle(x, y, radius_px); });
}

// Mean over the ring [from, to) in pixels.
inline double ring_mean(const wave::Psf& psf, int c, double from, double to) {
    int pixels = 0;
    const double total = sum(psf, c, [&](int x, int y) {
        const double r = std::hypot(x, y);
        if (r < from || r >= to) return 0.0;
        ++pixels;
        return 1.0;
    });
    return total / pixels;
}

// Energy over directions from the axis, of pixels between two radii; bin 0 begins at +x, bins go
// counter-clockwise. Of the full turn.
inline std::vector<double> by_direction(const wave::Psf& psf, double from, double to, int bins) {
    std::vector<double> energy(static_cast<std::size_t>(bins), 0.0);
    const int w = psf.grid.width / 2;
    const int h = psf.grid.height / 2;
    for (int y = -h; y <= h; ++y) {
        for (int x = -w; x <= w; ++x) {
            const double r = std::hypot(x, y);
            if (r < from || r >= to) continue;
            const double turn = std::atan2(y, x) / (2 * kPi);
            const auto bin = static_cast<std::size_t>((turn - std::floor(turn)) * bins);
            energy[std::min(bin, energy.size() - 1)] +=
                static_cast<double>(psf.kernel.at(x + w, h - y, 1));
        }
    }
    return energy;
}

// Directions (deg) of bins that hold more than `times` the mean, neighbours joined.
inline std::vector<double> spikes(const std::vector<double>& energy, double times) {
    double mean = 0;
    for (const double e : energy) mean += e / static_cast<double>(energy.size());
    const std::size_t n = energy.size();
    std::size_t start = 0;
    while (start < n && energy[start] > times * mean) ++start;
    std::vector<double> found;
    double weight = 0;
    double position = 0;
    for (std::size_t k = 0; k <= n; ++k) {
        const double e = k < n ? energy[(start + k) % n] : 0;
        if (e > times * mean) {
            weight += e;
            position += e * (static_cast<double>(start + k) + 0.5);
        } else if (weight > 0) {
            found.push_back(std::fmod(position / weight * 360 / static_cast<double>(n), 360.0));
            weight = position = 0;
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

// Airy: the share inside radius theta is 1 - J0^2(v) - J1^2(v), v = pi D theta / lambda (Rayleigh
// 1881; Born & Wolf 8.5.2).
inline double airy_outside(double theta_over_lambda_d) {
    const double v = kPi * theta_over_lambda_d;
    const double j0 = std::cyl_bessel_j(0.0, v);
    const double j1 = std::cyl_bessel_j(1.0, v);
    return j0 * j0 + j1 * j1;
}

// How far the energy of a kernel and of what lies beyond it is from 1, in the worst colour;
// infinite if a pixel is no number, or if less than nothing or all of it lies beyond.
inline double energy_error(const wave::Psf& psf) {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        const double beyond = psf.off_kernel_energy[static_cast<std::size_t>(c)];
        if (!(beyond >= -1e-6 && beyond < 1)) return HUGE_VAL;
        double total = beyond;
        for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
            const float value = psf.kernel.plane(c)[i];
            if (!std::isfinite(value)) return HUGE_VAL;
            total += static_cast<double>(value);
        }
        worst = std::max(worst, std::abs(total - 1));
    }
    return worst;
}

}  // namespace aureole::lens
