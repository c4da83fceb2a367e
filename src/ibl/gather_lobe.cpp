#include "ibl/gather_lobe.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// Lobes that are this wide are the cosine to float precision.
constexpr double kCosineAlpha = 0.9999;

double env(const char* n, double d) { const char* s = std::getenv(n); return s ? std::atof(s) : d; }

}  // namespace

GatherLobe gather_lobe(double alpha, FilterQuality quality) {
    GatherLobe lobe;
    const double a2 = alpha * alpha;
    if (alpha > kCosineAlpha) {
        lobe.shape = LobeShape::kCosine;
        lobe.total = static_cast<float>(kPi);
        lobe.pole = 4;
    } else {
        // The integral over mu = N.L of (c0 - c1 q) / q^2, with dmu = -dq / scale.
        const double scale = (1 - a2) / (2 * a2);
        const double c0 = 1 + 1 / scale;
        const double last = 1 + scale;
        const double total =
            2 * kPi / scale * (c0 * (1 - 1 / last) - std::log(last) / scale);
        lobe.shape = 1 / scale < .002 ? LobeShape::kNarrow : LobeShape::kWide;
        lobe.scale = static_cast<float>(scale);
        lobe.c0 = static_cast<float>(c0);
        lobe.c1 = static_cast<float>(1 / scale);
        lobe.total = static_cast<float>(total);
        lobe.pole = static_cast<float>(2 / scale);
    }
    const bool draft = quality == FilterQuality::kDraft;
    const bool high = quality == FilterQuality::kHigh;
    lobe.most_spread = static_cast<float>(env("EPS2", draft ? .5 : high ? .16 : .25));
    lobe.most_error = static_cast<float>(env("TAU", draft ? 1e-2 : high ? 1e-5 : 1e-4));
    lobe.most_horizon_error = static_cast<float>(env("TAUH", draft ? 1e-2 : high ? 1e-4 : 3e-4));
    lobe.most_relative = static_cast<float>(env("REL", .3));
    lobe.most_interpolation_error = static_cast<float>(env("TAUI", 1e-3));
    lobe.interpolation = static_cast<float>(env("KAPPA", 2.5));
    return lobe;
}

}  // namespace aureole::ibl
