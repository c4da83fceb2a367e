#include "ibl/lobe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "ibl/lobe_taps.h"

namespace aureole::ibl {
namespace {

constexpr double kAlphas[] = {0.003, 0.05, 0.3, 0.8, 1};

// w(mu) of prefilter.h.
double weight(double mu, double alpha2) {
    const double q = 1 - (1 - alpha2) * (1 + mu) / 2;
    return mu / (q * q);
}

// Integral of w from mu to 1. With q = A - c mu, A = (1 + a^2) / 2, c = (1 - a^2) / 2,
// it is (A (1 / a^2 - 1 / q) - ln(q / a^2)) / c^2, and (1 - mu^2) / 2 for a = 1.
double light_within(double mu, double alpha2) {
    if (alpha2 == 1) return (1 - mu * mu) / 2;
    const double a = (1 + alpha2) / 2;
    const double c = (1 - alpha2) / 2;
    const double q = a - c * mu;
    return (a * (1 / alpha2 - 1 / q) - std::log(q / alpha2)) / (c * c);
}

// D (N.H) dw of half vectors: the share within an angle, by its definition.
double half_within(double mu, double alpha2) {
    const double cosine2 = (1 + mu) / 2;
    return (1 - cosine2) / (1 + (alpha2 - 1) * cosine2);
}

TEST(Lobe, LightIsDistributedAsItsWeight) {
    for (const double alpha : kAlphas) {
        const double alpha2 = alpha * alpha;
        const Lobe lobe(alpha, LobeDensity::kLight);
        for (double y = 0.001; y < 1; y += 0.0371) {
            const Lobe::Sample sample = lobe.sample({0.2, y});
            EXPECT_GE(sample.light.z, 0);
            EXPECT_NEAR(light_within(sample.light.z, alpha2) / light_within(0, alpha2), y, 2e-5)
                << alpha;
            EXPECT_NEAR(sample.density_per_sr * 2 * kPi * light_within(0, alpha2) /
                            weight(sample.light.z, alpha2),
                        1, 1e-3)
                << alpha << " " << y;
            EXPECT_EQ(sample.weight, 1);
        }
    }
}

TEST(Lobe, HalfVectorsAreDistributedAsD) {
    for (const double alpha : kAlphas) {
        const double alpha2 = alpha * alpha;
        const Lobe lobe(alpha, LobeDensity::kHalfVector);
        for (double y = 0.001; y < 1; y += 0.0371) {
            const Lobe::Sample sample = lobe.sample({0.7, y});
            EXPECT_NEAR(half_within(sample.light.z, alpha2), y, 1e-9) << alpha;
            EXPECT_EQ(sample.weight, std::max(0.0, sample.light.z));
            // The density is the derivative of that share.
            const double step = 1e-4 * y;
            const double mu0 = lobe.sample({0.7, y - step}).light.z;
            const double mu1 = lobe.sample({0.7, y + step}).light.z;
            EXPECT_NEAR(sample.density_per_sr * 2 * kPi * (mu0 - mu1) / (2 * step), 1, 2e-3);
        }
    }
}

// All directions around the normal, whatever is random.
TEST(Lobe, SamplesFillTheirHistogram) {
    constexpr int kRings = 12;
    constexpr int kSectors = 8;
    constexpr int kSamples = 200000;
    for (const double alpha : {0.1, 0.5, 1.0}) {
        const double alpha2 = alpha * alpha;
        const Lobe lobe(alpha, LobeDensity::kLight);
        std::array<int, kRings* kSectors> histogram = {};
        Random random(6);
        for (int i = 0; i < kSamples; ++i) {
            const Lobe::Sample sample = lobe.sample({random.uniform(), random.uniform()});
            EXPECT_NEAR(dot(sample.light, sample.light), 1, 1e-12);
            // Rings of equal cosine.
            const int ring = std::min(kRings - 1, static_cast<int>(sample.light.z * kRings));
            const double azimuth = std::atan2(sample.light.y, sample.light.x) / (2 * kPi) + 0.5;
            const int sector = std::min(kSectors - 1, static_cast<int>(azimuth * kSectors));
            ++histogram[static_cast<std::size_t>(ring * kSectors + sector)];
        }
        double chi2 = 0;
        for (int ring = 0; ring < kRings; ++ring) {
            const double low = static_cast<double>(ring) / kRings;
            const double high = static_cast<double>(ring + 1) / kRings;
            const double expected = kSamples *
                                    (light_within(low, alpha2) - light_within(high, alpha2)) /
                                    (kSectors * light_within(0, alpha2));
            for (int sector = 0; sector < kSectors; ++sector) {
                const double off =
                    histogram[static_cast<std::size_t>(ring * kSectors + sector)] - expected;
                chi2 += off * off / expected;
            }
        }
        constexpr double kFreedom = kRings * kSectors - 1;
        EXPECT_LT(chi2, kFreedom + 5 * std::sqrt(2 * kFreedom)) << alpha;
    }
}

double total_weight(const std::vector<LobeTap>& taps) {
    double sum = 0;
    for (const LobeTap& tap : taps) {
        sum += static_cast<double>(tap.weights[0]) + static_cast<double>(tap.weights[1]);
    }
    return sum;
}

TEST(LobeTaps, AllHaveWeightAndTheirSumIsOne) {
    const FisLevel fis = {256, 9, 1, 0};
    for (const LobeDensity density : {LobeDensity::kHalfVector, LobeDensity::kLight}) {
        for (const double alpha : kAlphas) {
            for (const int count : {1, 8, 31, 128}) {
                const auto taps = hammersley_taps(Lobe(alpha, density), count, fis);
                EXPECT_EQ(taps.size(), static_cast<std::size_t>(count));
                EXPECT_NEAR(total_weight(taps), 1, 1e-5);
                for (const LobeTap& tap : taps) {
                    EXPECT_GT(tap.z, 0);
                    EXPECT_GE(tap.weights[0], 0);
                    EXPECT_GE(tap.weights[1], 0);
                    EXPECT_LT(tap.level + (tap.weights[1] > 0 ? 1 : 0), 9);
                }
            }
        }
    }
}

// With alpha = 1 light is spread evenly over the sphere by half vectors; Hammersley's points of odd
// index fall below the horizon, but count for how far apart samples are.
TEST(LobeTaps, LevelsCountTheSamplesThatWereReplaced) {
    const FisLevel fis = {256, 9, 1, 0};
    const auto taps = hammersley_taps(Lobe(1, LobeDensity::kHalfVector), 40, fis);
    for (const LobeTap& tap : taps) {
        const double sum =
            static_cast<double>(tap.weights[0]) + static_cast<double>(tap.weights[1]);
        EXPECT_NEAR(tap.level + static_cast<double>(tap.weights[1]) / sum,
                    fis.of(1 / (4 * kPi), 79), 1e-5);
    }
}

// A sample of an even density over the sphere covers 1/n of it: the level at which that is a texel.
TEST(LobeTaps, LevelsFollowFromSolidAngles) {
    const double even = 1 / (4 * kPi);
    EXPECT_NEAR((FisLevel{256, 9, 1, 0}).of(even, 6 * 256 * 256), 0, 1e-9);
    EXPECT_NEAR((FisLevel{256, 9, 1, 0}).of(even, 6 * 16 * 16), 4, 1e-9);
    EXPECT_NEAR((FisLevel{256, 9, 4, 0}).of(even, 6 * 16 * 16), 5, 1e-9);
    EXPECT_NEAR((FisLevel{256, 9, 1, 0.5}).of(even, 6 * 16 * 16), 4.5, 1e-9);
    EXPECT_EQ((FisLevel{256, 9, 1, 0}).of(1e9, 1000), 0);
    EXPECT_EQ((FisLevel{256, 9, 1, 0}).of(0, 32), 8);
}

}  // namespace
}  // namespace aureole::ibl
