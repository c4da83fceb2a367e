// Blinks over ten minutes, and one at a time.
#include "aureole/eye/blinking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"

namespace aureole::eye {
namespace {

constexpr BlinkSettings kSpontaneous = {.blinking = Blinking::kSpontaneous};

// Sforza et al. 2008: 11 to 19 a minute. VanderWerf et al. 2003: 334 +- 67 ms, of which closing
// 92 +- 17 and opening 242 +- 55.
TEST(Blinks, HavePublishedRatesAndDurations) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const std::vector<Blink> blinks = Blinks(kSpontaneous, seed).between(0, 600);
        EXPECT_GE(blinks.size(), 110U);
        EXPECT_LE(blinks.size(), 190U);
        double closing = 0;
        double opening = 0;
        for (const Blink& blink : blinks) {
            ASSERT_GT(blink.opening_s, blink.closing_s);
            ASSERT_GT(blink.closing_s + blink.opening_s, 0.1);
            ASSERT_LT(blink.closing_s + blink.opening_s, kLongestBlinkS);
            closing += blink.closing_s / static_cast<double>(blinks.size());
            opening += blink.opening_s / static_cast<double>(blinks.size());
        }
        EXPECT_NEAR(closing, 0.092, 0.005);
        EXPECT_NEAR(opening, 0.242, 0.015);
    }
}

TEST(Blinks, ComeAtIrregularIntervalsAndNeverOverlap) {
    const std::vector<Blink> blinks = Blinks(kSpontaneous, 7).between(-300, 300);
    double sum = 0;
    double square = 0;
    for (std::size_t i = 1; i < blinks.size(); ++i) {
        ASSERT_GE(blinks[i].start_s, blinks[i - 1].end_s());
        const double interval = blinks[i].start_s - blinks[i - 1].start_s;
        sum += interval;
        square += interval * interval;
    }
    const double count = static_cast<double>(blinks.size() - 1);
    const double mean = sum / count;
    EXPECT_NEAR(mean, 4, 0.3);
    EXPECT_GT(std::sqrt(square / count - mean * mean) / mean, 0.25);
}

TEST(Blinks, ClosureIsThatOfTheListedBlinks) {
    const Blinks blinks(kSpontaneous, 3);
    const std::vector<Blink> listed = blinks.between(-1, 60);
    double largest = 0;
    for (int i = 0; i < 60000; ++i) {
        const double t = i * 1e-3;
        double expected = 0;
        for (const Blink& blink : listed) expected = std::max(expected, blink.closure(t));
        ASSERT_EQ(blinks.closure(t), expected) << t;
        largest = std::max(largest, expected);
    }
    EXPECT_GT(largest, 0.99);
}

TEST(Blinks, CloseAndOpenWithoutAStep) {
    const Blink blink;
    EXPECT_EQ(blink.closure(0), 0);
    EXPECT_EQ(blink.closure(blink.closing_s), 1);
    EXPECT_EQ(blink.closure(blink.end_s()), 0);
    constexpr double kStep = 1e-4;
    for (double t = -0.01; t < blink.end_s() + 0.01; t += kStep) {
        // The steepest part of a smooth step is 1.5 times its mean.
        ASSERT_LE(std::abs(blink.closure(t + kStep) - blink.closure(t)),
                  1.51 * kStep / blink.closing_s);
    }
}

TEST(Blinks, AtGivenTimesOnly) {
    BlinkSettings settings = {.blinking = Blinking::kVoluntary, .voluntary_s = {2, 2.1, 7}};
    const Blinks blinks(settings, 1);
    const auto any = [&](double from_s, double to_s) {
        double largest = 0;
        for (double t = from_s; t < to_s; t += 1e-3) largest = std::max(largest, blinks.closure(t));
        return largest;
    };
    EXPECT_EQ(any(0, 2), 0);
    EXPECT_GT(any(2, 2.3), 0.99);
    EXPECT_EQ(any(2.6, 7), 0);
    EXPECT_GT(any(7, 8), 0.99);
    EXPECT_EQ(any(8, 20), 0);
    settings.blinking = Blinking::kSuppressed;
    EXPECT_EQ(Blinks(settings, 1).closure(2.1), 0);
    settings = {.blinking = Blinking::kVoluntary, .voluntary_s = {3, 1}};
    EXPECT_THROW(Blinks(settings, 1), InvalidArgument);
    settings = {.blinking = Blinking::kSpontaneous, .per_minute = 100};
    EXPECT_THROW(Blinks(settings, 1), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
