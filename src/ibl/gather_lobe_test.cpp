#include "ibl/gather_lobe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// prefilter.h's weight, scaled to N.L at its maximum.
double weight(double cosine, double alpha) {
    const double a2 = alpha * alpha;
    return cosine * std::pow(a2 / (1 - (1 - a2) * (1 + cosine) / 2), 2);
}

TEST(GatherLobe, IsTheWeightOfTheSplitSum) {
    for (const double alpha : {.01, .1, .5, .9, .9995}) {
        const GatherLobe lobe = gather_lobe(alpha, FilterQuality::kNormal);
        for (const double cosine : {.01, .3, .9, .999, 1.0}) {
            const double q = 1 + lobe.scale * (1 - cosine);
            const double w = (lobe.c0 - lobe.c1 * q) / (q * q);
            EXPECT_NEAR(w, weight(cosine, alpha), 1e-6 + 1e-4 * w) << alpha << " " << cosine;
        }
    }
}

TEST(GatherLobe, TotalIsItsIntegral) {
    for (const double alpha : {.01, .1, .5, .9, .9995, 1.0}) {
        constexpr int kSteps = 200000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {  // in x with 1 - N.L = x^3, dense where the lobe is
            const double x = (i + 0.5) / kSteps;
            sum += 3 * x * x * weight(1 - x * x * x, alpha) / kSteps;
        }
        EXPECT_NEAR(gather_lobe(alpha, FilterQuality::kHigh).total / (2 * kPi * sum), 1, 2e-5)
            << alpha;
    }
}

TEST(GatherLobe, BetterQualitiesAllowLess) {
    for (const double alpha : {.02, .3, 1.0}) {
        const GatherLobe draft = gather_lobe(alpha, FilterQuality::kDraft);
        const GatherLobe normal = gather_lobe(alpha, FilterQuality::kNormal);
        const GatherLobe high = gather_lobe(alpha, FilterQuality::kHigh);
        EXPECT_GT(draft.most_error, normal.most_error);
        EXPECT_GT(normal.most_error, high.most_error);
        EXPECT_GT(draft.most_dipole, normal.most_dipole);
        EXPECT_GT(normal.most_dipole, high.most_dipole);
        EXPECT_GT(draft.most_interpolation_error, high.most_interpolation_error);
        EXPECT_LT(draft.least_distance2, high.least_distance2);
    }
}

}  // namespace
}  // namespace aureole::ibl
