#include "aureole/color/primary_spectra.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "aureole/base/error.h"

namespace aureole::color {
namespace {

TEST(PrimarySpectra, SharesAreOfTheWholeAndNoneIsNegative) {
    for (double nm = 370; nm <= 780; nm += 0.7) {
        const Rgb share = primary_shares(nm);
        EXPECT_NEAR(share[0] + share[1] + share[2], 1, 1e-12) << nm;
        for (const double s : share) {
            EXPECT_GE(s, -1e-6) << nm;
            EXPECT_LE(s, 1 + 1e-6) << nm;
        }
    }
}

// Integrated here with steps and sums of its own.
TEST(PrimarySpectra, LightOfAPrimaryHasItsColour) {
    std::array<Xyz, 3> sum{};
    Xyz white{};
    for (double nm = 380.125; nm < 770; nm += 0.25) {
        const Xyz observer = cie_1931_observer(nm);
        const Rgb share = primary_shares(nm);
        for (std::size_t c = 0; c < 3; ++c) {
            const double light = relative_power(Illuminant::kD65, nm) * observer[c];
            white[c] += light;
            for (std::size_t j = 0; j < 3; ++j) sum[j][c] += share[j] * light;
        }
    }
    const Rgb scale = rgb_from_xyz(white);
    for (std::size_t j = 0; j < 3; ++j) {
        const Rgb rgb = rgb_from_xyz(sum[j]);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(rgb[c] / scale[c], j == c ? 1 : 0, 2e-4) << j << c;
        }
    }
}

class PrimaryBands : public testing::TestWithParam<WavelengthSpacing> {};

TEST_P(PrimaryBands, AreTheBandsOfWhiteSharedOut) {
    for (const int count : {8, 32, 256}) {
        const auto white = sample_spectrum(count, GetParam());
        const auto bands = sample_primaries(count, GetParam());
        ASSERT_EQ(bands.size(), white.size());
        std::array<Rgb, 3> sum{};
        for (std::size_t b = 0; b < bands.size(); ++b) {
            EXPECT_EQ(bands[b].wavelength_nm, white[b].wavelength_nm);
            for (std::size_t c = 0; c < 3; ++c) {
                double all = 0;
                for (std::size_t j = 0; j < 3; ++j) {
                    all += bands[b].primary[j][c];
                    sum[j][c] += bands[b].primary[j][c];
                }
                EXPECT_NEAR(all, white[b].rgb[c], 1e-6);
            }
        }
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[j][c], j == c ? 1 : 0, 1e-4);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Spacings, PrimaryBands,
                         testing::Values(WavelengthSpacing::kLogarithmic,
                                         WavelengthSpacing::kLinear));

TEST(PrimarySpectra, RefusesNoBands) { EXPECT_THROW(sample_primaries(0), InvalidArgument); }

}  // namespace
}  // namespace aureole::color
