// The eye in motion over ten minutes: spectra, bounds, continuity, and that any order will do.
#include "aureole/eye/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/eye/ranges.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::eye {
namespace {

constexpr double kMinutes = 10;
constexpr double kSamplesPerS = 10;
constexpr wave::ApertureGrid kGrid = {512, 10};

LivingEye living(double luminance_cd_m2, MotionSettings settings = {}) {
    return LivingEye(Eye{}, std::move(settings), LuminanceCurve(luminance_cd_m2));
}

std::vector<double> over_ten_minutes(const std::function<double(double)>& value) {
    std::vector<double> values;
    for (int i = 0; i < static_cast<int>(kMinutes * 60 * kSamplesPerS); ++i) {
        values.push_back(value(i / kSamplesPerS));
    }
    return values;
}

// Share of the variance between two frequencies, under a Hann window, by direct sums.
double share_between(const std::vector<double>& values, double low_hz, double high_hz) {
    const auto n = values.size();
    double mean = 0;
    for (const double value : values) mean += value / static_cast<double>(n);
    std::vector<double> windowed(n);
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double window = std::sin(kPi * static_cast<double>(i) / static_cast<double>(n));
        windowed[i] = (values[i] - mean) * window * window;
        energy += windowed[i] * windowed[i];
    }
    double band = 0;
    const double seconds = static_cast<double>(n) / kSamplesPerS;
    for (int k = static_cast<int>(std::ceil(low_hz * seconds)); k <= high_hz * seconds; ++k) {
        const auto turn = std::polar(1.0, -2 * kPi * k / static_cast<double>(n));
        std::complex<double> phasor = 1;
        std::complex<double> sum = 0;
        for (const double value : windowed) {
            sum += value * phasor;
            phasor *= turn;
        }
        band += 2 * std::norm(sum) / static_cast<double>(n);
    }
    return band / energy;
}

TEST(Hippus, HasItsSpectrumAndStaysWithinHalfAMillimetre) {
    for (const double luminance : {0.01, 10.0, 3000.0}) {
        const LivingEye eye = living(luminance);
        const double mean_mm = eye.at(0).mean_pupil_mm;
        const std::vector<double> pupils =
            over_ten_minutes([&](double t) { return eye.at(t).eye.pupil_diameter_mm; });
        EXPECT_GT(share_between(pupils, 0.04, 2), 0.999) << luminance;
        double largest = 0;
        for (const double pupil : pupils) largest = std::max(largest, std::abs(pupil - mean_mm));
        EXPECT_LE(largest, 0.5) << luminance;
        EXPECT_GT(largest, 0.02) << luminance;
    }
}

TEST(Hippus, IsSlowerAndWeakerInWidePupils) {
    const LivingEye bright = living(1000);
    const LivingEye dark = living(0.01);
    const auto pupil_of = [](const LivingEye& eye) {
        return over_ten_minutes([&](double t) { return eye.at(t).eye.pupil_diameter_mm; });
    };
    const auto narrow = pupil_of(bright);
    const auto wide = pupil_of(dark);
    EXPECT_GT(share_between(narrow, 0.5, 2), 2 * share_between(wide, 0.5, 2) + 0.01);
    const auto range = [](const std::vector<double>& values) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        return *most - *least;
    };
    EXPECT_GT(range(narrow), 2 * range(wide));
}

TEST(Hippus, DoesNotRaceWhenThePupilChangesLate) {
    // Ten minutes in, the pupil narrows within a second: with t / p for the noise's argument it
    // would pass through dozens of periods.
    const LivingEye eye(Eye{}, {}, LuminanceCurve({0, 600, 601, 1000}, {1, 1, 100, 100}));
    for (double t = 599; t < 602; t += 0.01) {
        const auto hippus = [&](double time_s) {
            const Moment moment = eye.at(time_s);
            return moment.eye.pupil_diameter_mm - moment.mean_pupil_mm;
        };
        ASSERT_LT(std::abs(hippus(t + 0.01) - hippus(t)), 0.02) << t;
    }
}

TEST(Accommodation, HasTwoBandsWithinHalfADioptre) {
    const LivingEye eye = living(0.001);
    const std::vector<double> values =
        over_ten_minutes([&](double t) { return eye.at(t).accommodation_d; });
    const double slow = share_between(values, 0.01, 0.6);
    const double fast = share_between(values, 1, 2.3);
    EXPECT_GT(slow, 0.5);
    EXPECT_GT(fast, 0.1);
    EXPECT_GT(slow + fast, 0.999);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    EXPECT_GE(*least, -0.5);
    EXPECT_LE(*most, 0.5);
    EXPECT_GT(*most - *least, 0.3);
}

TEST(Accommodation, IsStrongerInLargerPupilsAndScalesTheLens) {
    const LivingEye wide = living(0.01);
    const LivingEye narrow = living(1000);
    for (const double t : {1.0, 33.3, 200.0}) {
        const Moment a = wide.at(t);
        const Moment b = narrow.at(t);
        EXPECT_GT(std::abs(a.accommodation_d), 1.5 * std::abs(b.accommodation_d));
        // 9.2 mm of lens lose .067 mm per dioptre.
        EXPECT_NEAR(9.2 * (1 - a.eye.pose.lens_scale), 0.067 * a.accommodation_d, 1e-12);
    }
}

TEST(LivingEye, IsContinuous) {
    MotionSettings settings;
    settings.gaze = Gaze::saccades(1);
    settings.blinks.blinking = Blinking::kSpontaneous;
    const LivingEye eye(Eye{}, settings,
                        LuminanceCurve({0, 5, 6, 10, 11, 20}, {1, 1, 1e5, 1e5, 1, 1}));
    constexpr double kStep = 1e-3;
    bool closed = false;
    for (int i = 0; i < 20000; ++i) {
        const Moment a = eye.at(i * kStep);
        const Moment b = eye.at((i + 1) * kStep);
        ASSERT_LT(std::abs(a.eye.pupil_diameter_mm - b.eye.pupil_diameter_mm), 0.02);
        ASSERT_LT(std::abs(a.eye.pose.lens_scale - b.eye.pose.lens_scale), 1e-4);
        ASSERT_LT(std::abs(a.eye.pose.vitreous_yaw_deg - b.eye.pose.vitreous_yaw_deg), 0.5);
        ASSERT_LT(std::abs(a.light_share - b.light_share), 0.05);
        ASSERT_LT(std::abs(a.squint - b.squint), 0.01);
        ASSERT_NO_THROW(check(a.eye));
        closed = closed || a.closed;
    }
    EXPECT_TRUE(closed);
}

// Any double may be asked for, and is answered with an eye that can be drawn.
TEST(LivingEye, IsAskedForMomentsBeyondItsRange) {
    MotionSettings settings;
    settings.gaze = Gaze::saccades(1);
    settings.blinks.blinking = Blinking::kSpontaneous;
    const LivingEye eye(Eye{}, settings, LuminanceCurve({0, 1}, {1, kBrightestCdM2}));
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    for (const double time_s : {1e30, kEndless, 1e300}) {
        const Moment late = eye.at(time_s);
        const Moment early = eye.at(-time_s);
        ASSERT_NO_THROW(check(late.eye));
        ASSERT_NO_THROW(check(early.eye));
        EXPECT_EQ(late.eye, eye.at(kFarthestTimeS).eye);
        EXPECT_EQ(early.eye, eye.at(-kFarthestTimeS).eye);
    }
    ASSERT_NO_THROW(check(eye.at(std::nan("")).eye));
    EXPECT_NE(eye.at(kFarthestTimeS).eye, eye.at(kFarthestTimeS - 1).eye);
}

TEST(LivingEye, IsTheSameInAnyOrder) {
    MotionSettings settings;
    settings.gaze = Gaze::saccades(1);
    settings.blinks.blinking = Blinking::kSpontaneous;
    const LuminanceCurve curve({0, 5, 6}, {1, 1, 1e4});
    const LivingEye one(Eye{}, settings, curve);
    const auto numbers = [](const Moment& m) {
        return std::vector<double>{
            m.eye.pupil_diameter_mm,       m.accommodation_d, m.eye.pose.vitreous_yaw_deg,
            m.eye.pose.vitreous_pitch_deg, m.eye.eyelid,      m.light_share};
    };
    std::vector<std::vector<double>> forwards;
    for (int i = 0; i < 200; ++i) forwards.push_back(numbers(one.at(i / 24.0)));
    const LivingEye other(Eye{}, settings, curve);
    for (int i = 199; i >= 0; --i) {
        EXPECT_EQ(numbers(other.at(i / 24.0)), forwards[static_cast<std::size_t>(i)]);
    }
    Eye person;
    person.seed = 2;
    EXPECT_NE(numbers(LivingEye(person, settings, curve).at(1)), forwards[24]);
}

TEST(Lids, DimByTheShareOfThePupilThatTheyLeaveOpen) {
    Eye eye;
    eye.anatomy.pupil_irregularity = 0;
    const double full = wave::area_mm2(draw_pupil(eye, kGrid));
    for (const double eyelid : {0.05, 0.2, 0.5, 0.8}) {
        eye.eyelid = eyelid;
        EXPECT_NEAR(open_share(eye), wave::area_mm2(draw_pupil(eye, kGrid)) / full, 1e-3);
    }
    MotionSettings settings;
    settings.blinks = {.blinking = Blinking::kVoluntary, .voluntary_s = {1}};
    const LivingEye blinking = living(10, settings);
    EXPECT_EQ(blinking.at(0.9).light_share, 1);
    double darkest = 1;
    for (double t = 1; t < 1.5; t += 1e-3) {
        const Moment moment = blinking.at(t);
        darkest = std::min(darkest, moment.light_share);
        Eye open = moment.eye;
        open.eyelid = 0;
        if (!moment.closed) {
            ASSERT_EQ(moment.light_share, open_share(moment.eye) / open_share(open));
        }
        ASSERT_GT(wave::area_mm2(draw_pupil(moment.eye, {128, 10})), 0);
    }
    EXPECT_LT(darkest, 0.01);
}

TEST(Lids, LeaveTheViewAloneIfOnlyStreaksAreWanted) {
    MotionSettings settings;
    settings.blinks = {.blinking = Blinking::kVoluntary, .voluntary_s = {1}, .streaks_only = true};
    const LivingEye eye = living(10, settings);
    double lowest = 0;
    for (double t = 0.9; t < 1.5; t += 1e-3) {
        const Moment moment = eye.at(t);
        ASSERT_EQ(moment.light_share, 1);
        ASSERT_EQ(moment.eye.eyelid, 0);
        lowest = std::max(lowest, moment.eye.pose.lash_closure);
    }
    EXPECT_GT(lowest, 0.99);
}

TEST(Lids, SquintInBrightLight) {
    const Moment shade = living(1000).at(3);
    const Moment snow = living(50000).at(3);
    EXPECT_EQ(shade.eye.eyelid, 0);
    EXPECT_NEAR(snow.eye.eyelid, 0.5, 1e-12);
    EXPECT_LT(snow.light_share, 0.6);
    const double between = living(1e4).at(3).eye.eyelid;
    EXPECT_GT(between, 0.05);
    EXPECT_LT(between, 0.45);
}

TEST(LivingEye, RefusesAbsurdValues) {
    const auto refuses = [](auto change) {
        MotionSettings settings;
        change(settings);
        EXPECT_THROW(living(10, settings), InvalidArgument);
    };
    refuses([](MotionSettings& s) { s.hippus = 2; });
    refuses([](MotionSettings& s) { s.accommodation = -1; });
    refuses([](MotionSettings& s) { s.squint = 1; });
    refuses([](MotionSettings& s) { s.mean_pupil_mm = 20; });
    refuses([](MotionSettings& s) { s.vitreous.damping = 0; });
    refuses([](MotionSettings& s) { s.pupil_conditions.age_years = 0; });
    refuses([](MotionSettings& s) { s.blinks.per_minute = 0; });
    Eye shut;
    shut.eyelid = 0.999;
    EXPECT_THROW(LivingEye(shut, {}, LuminanceCurve(10)), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
