// Curves of luminance and the lag of the pupil, against the differential equation.
#include "aureole/eye/luminance_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

TEST(LuminanceCurve, IsStraightInTheLogarithmAndHoldsItsEnds) {
    const LuminanceCurve curve({1, 3, 4}, {1, 100, 0});
    EXPECT_DOUBLE_EQ(curve.at(-5), 1);
    EXPECT_NEAR(curve.at(2), 10, 1e-12);
    EXPECT_NEAR(curve.at(3), 100, 1e-12);
    EXPECT_NEAR(curve.at(9), 1e-6, 1e-18);
    EXPECT_DOUBLE_EQ(LuminanceCurve(7).at(1e6), 7);
}

TEST(LuminanceCurve, RefusesWhatIsNoCurve) {
    EXPECT_THROW(LuminanceCurve({}, {}), InvalidArgument);
    EXPECT_THROW(LuminanceCurve({0, 0}, {1, 1}), InvalidArgument);
    EXPECT_THROW(LuminanceCurve({0, 1}, {1}), InvalidArgument);
    EXPECT_THROW(LuminanceCurve({0, 1}, {1, -1}), InvalidArgument);
    EXPECT_THROW(LuminanceCurve(2 * kBrightestCdM2), InvalidArgument);
    EXPECT_LE(LuminanceCurve(kBrightestCdM2).at(0), kBrightestCdM2);
    EXPECT_THROW(LuminanceCurve({0, 2 * kFarthestTimeS}, {1, 1}), InvalidArgument);
    EXPECT_THROW(LuminanceCurve({0, std::nan("")}, {1, 1}), InvalidArgument);
}

// Both lags by small steps of dy/dt = (x - y) / T.
TEST(PupilReflex, FollowsItsDifferentialEquation) {
    std::vector<double> times_s;
    std::vector<double> luminances;
    for (int i = 0; i < 60; ++i) {
        times_s.push_back(0.13 * i);
        luminances.push_back(std::pow(10.0, 2 * std::sin(1.7 * i) + (i > 20 && i < 35 ? 2 : 0)));
    }
    const LuminanceCurve curve(times_s, luminances);
    const PupilReflex reflex;
    constexpr double kStep = 2e-5;
    double fast = std::log10(curve.at(0));
    double slow = fast;
    int compared = 0;
    for (int k = 0; k < 480000; ++k) {
        const double middle = std::log10(curve.at((k + 0.5) * kStep - reflex.delay_s));
        fast += (middle - fast) * kStep / reflex.constriction_s;
        slow += (middle - slow) * kStep / reflex.dilation_s;
        if (k % 20000 != 0) continue;
        const double damped = damped_luminance_cd_m2(curve, (k + 1) * kStep, reflex);
        ASSERT_NEAR(std::log10(damped), std::max(fast, slow), 1e-4) << k * kStep;
        ++compared;
    }
    EXPECT_EQ(compared, 24);
}

TEST(PupilReflex, ConstrictsThreeTimesAsFastAsItDilates) {
    // The time until 63 % of a step over two decades are done.
    const auto response_s = [](double from, double to) {
        const LuminanceCurve curve({0, 1e-6}, {from, to});
        const double target = std::log10(from) + (1 - std::exp(-1)) * std::log10(to / from);
        double t = 0;
        while ((std::log10(damped_luminance_cd_m2(curve, t)) - target) * (to - from) < 0) t += 1e-4;
        return t - PupilReflex{}.delay_s;
    };
    EXPECT_NEAR(response_s(1, 100), 0.3, 1e-3);
    EXPECT_NEAR(response_s(100, 1), 0.9, 1e-3);
    EXPECT_NEAR(damped_luminance_cd_m2(LuminanceCurve(42), 3), 42, 1e-12);
}

TEST(PupilReflex, RefusesAbsurdTimes) {
    EXPECT_NO_THROW(check(PupilReflex{}));
    EXPECT_THROW(check(PupilReflex{-1, 0.3, 0.9}), InvalidArgument);
    EXPECT_THROW(check(PupilReflex{0.2, 0, 0.9}), InvalidArgument);
    EXPECT_THROW(check(PupilReflex{0.2, 0.9, 0.3}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
