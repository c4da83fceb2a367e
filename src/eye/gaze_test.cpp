// Turning eyes, and the vitreous against its differential equation.
#include "aureole/eye/gaze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {
namespace {

// x = vitreous angle in space: x'' = -2 d w (x' - g') - w^2 (x - g), by small steps.
void expect_lag_follows_equation(const Gaze& gaze, const VitreousMechanics& mechanics,
                                 double from_s, double to_s) {
    constexpr double kStep = 1e-5;
    const double w = 2 * std::acos(-1.0) * mechanics.frequency_hz;
    double x = gaze.at(from_s).yaw_deg + gaze.vitreous_lag(from_s, mechanics).yaw_deg;
    double v = (gaze.at(from_s + kStep).yaw_deg +
                gaze.vitreous_lag(from_s + kStep, mechanics).yaw_deg - x) /
               kStep;
    double g = gaze.at(from_s).yaw_deg;
    double largest = 0;
    const int steps = static_cast<int>((to_s - from_s) / kStep);
    for (int k = 0; k < steps; ++k) {
        const double next = gaze.at(from_s + (k + 1) * kStep).yaw_deg;
        v += kStep *
             (-2 * mechanics.damping * w * (v - (next - g) / kStep) - w * w * (x - (next + g) / 2));
        x += kStep * v;
        g = next;
        if (k % 5000 != 0) continue;
        const double lag = gaze.vitreous_lag(from_s + (k + 1) * kStep, mechanics).yaw_deg;
        ASSERT_NEAR(lag, x - g, 0.01) << from_s + k * kStep;
        largest = std::max(largest, std::abs(lag));
    }
    EXPECT_GT(largest, 1);
}

TEST(Vitreous, FollowsItsDifferentialEquation) {
    const Gaze gaze =
        Gaze::through({0.1, 0.15, 0.9, 1.2}, {{0, 0, 0}, {10, 0, 0}, {10, 0, 0}, {-5, 0, 0}});
    for (const double damping : {0.3, 1.0, 1.2, 3.0}) {
        expect_lag_follows_equation(gaze, {0.5, damping}, 0, 3);
    }
}

TEST(Vitreous, FollowsItsDifferentialEquationThroughSaccades) {
    expect_lag_follows_equation(Gaze::saccades(5), {}, 20, 22);
}

TEST(Vitreous, StaysBehindAtFirstAndComesToRestWithTheEye) {
    const Gaze gaze = Gaze::through({0, 0.001}, {{0, 0, 0}, {10, -4, 2}});
    const Rotation at_once = gaze.vitreous_lag(0.001);
    EXPECT_NEAR(at_once.yaw_deg, -10, 0.05);
    EXPECT_NEAR(at_once.pitch_deg, 4, 0.02);
    EXPECT_NEAR(at_once.roll_deg, -2, 0.01);
    // The fluid drags it along past its rest, to which it creeps back without another turn.
    int turns = 0;
    double before = at_once.yaw_deg;
    double last = gaze.vitreous_lag(0.01).yaw_deg;
    double farthest = last;
    for (double t = 0.02; t < 20; t += 0.01) {
        const double now = gaze.vitreous_lag(t).yaw_deg;
        turns += (now - last) * (last - before) < 0 ? 1 : 0;
        farthest = std::max(farthest, now);
        before = last;
        last = now;
    }
    EXPECT_EQ(turns, 1);
    EXPECT_LT(farthest, 2);
    EXPECT_NEAR(last, 0, 1e-6);
    EXPECT_EQ(gaze.vitreous_lag(-1).yaw_deg, 0);
    EXPECT_EQ(Gaze().vitreous_lag(3).yaw_deg, 0);
}

// Bahill, Adler & Stark 1975: 86 % of natural saccades are shorter than 15 deg.
TEST(Saccades, HavePublishedSizesAndRate) {
    const Gaze gaze = Gaze::saccades(1);
    int saccades = 0;
    int shorter = 0;
    Rotation before = gaze.at(0);
    for (int i = 1; i <= 1800; ++i) {
        const Rotation now = gaze.at(i / 3.0);
        const double angle =
            std::hypot(now.yaw_deg - before.yaw_deg, now.pitch_deg - before.pitch_deg);
        saccades += angle > 0 ? 1 : 0;
        shorter += angle < 15 ? 1 : 0;
        before = now;
    }
    EXPECT_EQ(saccades, 1800);
    EXPECT_NEAR(shorter / 1800.0, 0.86, 0.02);
}

TEST(Saccades, AreContinuous) {
    const Gaze gaze = Gaze::saccades(2);
    constexpr double kStep = 1e-4;
    for (int i = 0; i < 100000; ++i) {
        const double moved =
            std::abs(gaze.at((i + 1) * kStep).yaw_deg - gaze.at(i * kStep).yaw_deg);
        ASSERT_LT(moved, 455 * kStep);  // A deg in 21 ms + 2.2 ms A: never faster than 1 / 2.2 ms
    }
}

TEST(Gaze, RefusesWhatIsNoCurve) {
    EXPECT_THROW(Gaze::through({}, {}), InvalidArgument);
    EXPECT_THROW(Gaze::through({0, 1}, {{}}), InvalidArgument);
    EXPECT_THROW(Gaze::through({1, 0}, {{}, {}}), InvalidArgument);
    EXPECT_THROW(Gaze::through({0}, {{std::nan(""), 0, 0}}), InvalidArgument);
    EXPECT_THROW(Gaze::through({0}, {{0, -2e6, 0}}), InvalidArgument);
    EXPECT_THROW(Gaze::through({-2 * kFarthestTimeS, 0}, {{}, {}}), InvalidArgument);
    EXPECT_THROW(check(VitreousMechanics{0, 1}), InvalidArgument);
    EXPECT_THROW(check(VitreousMechanics{1, 0}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
