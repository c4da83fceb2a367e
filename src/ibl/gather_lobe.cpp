#include "ibl/gather_lobe.h"

#include <array>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// Lobes that are this wide are the cosine to float precision.
constexpr double kCosineAlpha = 0.9999;
// c1 at which the horizon begins to matter: alpha = .03.
constexpr double kNarrowest = 0.002;
// For the cosine; its edge is looked after, and elsewhere it is a polynomial.
constexpr float kNoPole = 4;

struct Limits {
    float size, spread, error, dipole, horizon_error, distance2, interpolation_error;
};

// Found by measuring: docs/environment_filtering.md has errors and times.
constexpr std::array<Limits, 3> kLimits = {{
    {2.0F, 0.3F, 3e-3F, 2.5e-4F, 1e-3F, 3, 1e-2F},
    {0.8F, 0.3F, 1e-4F, 3.5e-5F, 1e-4F, 5, 1e-3F},
    {0.5F, 0.3F, 1e-5F, 1e-5F, 3e-5F, 8, 1e-4F},
}};

}  // namespace

GatherLobe gather_lobe(double alpha, FilterQuality quality) {
    GatherLobe lobe;
    if (alpha > kCosineAlpha) {
        lobe.shape = LobeShape::kCosine;
        lobe.total = static_cast<float>(kPi);
        lobe.pole = kNoPole;
    } else {
        // The integral over N.L of (c0 - c1 q) / q^2, with d(N.L) = -dq / scale.
        const double a2 = alpha * alpha;
        const double scale = (1 - a2) / (2 * a2);
        const double c0 = 1 + 1 / scale;
        const double at_horizon = 1 + scale;
        const double total =
            2 * kPi / scale * (c0 * (1 - 1 / at_horizon) - std::log(at_horizon) / scale);
        lobe.shape = 1 / scale < kNarrowest ? LobeShape::kNarrow : LobeShape::kWide;
        lobe.scale = static_cast<float>(scale);
        lobe.c0 = static_cast<float>(c0);
        lobe.c1 = static_cast<float>(1 / scale);
        lobe.total = static_cast<float>(total);
        lobe.pole = static_cast<float>(2 / scale);
    }
    const Limits& limits = kLimits[static_cast<std::size_t>(quality)];
    lobe.most_size = limits.size;
    lobe.most_spread = limits.spread;
    lobe.most_error = limits.error;
    lobe.most_dipole = limits.dipole * lobe.total / static_cast<float>(4 * kPi * std::sqrt(alpha));
    lobe.most_horizon_error = limits.horizon_error;
    lobe.least_distance2 = limits.distance2;
    lobe.most_interpolation_error = limits.interpolation_error;
    return lobe;
}

GatherLobe scaled_to(const GatherLobe& lobe, double mean_luminance) {
    GatherLobe scaled = lobe;
    const auto unit = lobe.total * static_cast<float>(mean_luminance);
    scaled.most_error *= unit;
    scaled.most_horizon_error *= unit;
    scaled.most_interpolation_error *= unit;
    return scaled;
}

}  // namespace aureole::ibl
