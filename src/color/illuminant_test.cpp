#include "aureole/color/illuminant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/color/spectrum.h"

namespace aureole::color {
namespace {

struct Published {
    Illuminant illuminant;
    double x;
    double y;
    double tolerance;
};

// Where the observer's fit is what differs, within .002; mercury's table puts its lines up to 1 nm
// beside their wavelengths.
constexpr Published kPublished[] = {
    {Illuminant::kD65, 0.3127, 0.3290, 0.0005},
    {Illuminant::kEqualEnergy, 0.3333, 0.3333, 0.0005},
    {Illuminant::kTungsten, 0.44758, 0.40745, 0.002},
    {Illuminant::kSodium, 0.5692, 0.4302, 0.002},  // CIE 1931 at 589 nm
    {Illuminant::kHighPressureSodium, 0.5217, 0.4180, 0.001},
    {Illuminant::kMercury, 0.3112, 0.3829, 0.0065},
    {Illuminant::kLed, 0.3756, 0.3723, 0.0015}};

TEST(Illuminants, HaveTheirPublishedChromaticities) {
    for (const Published& lamp : kPublished) {
        const Xyz xyz = tristimulus(lamp.illuminant);
        const double sum = xyz[0] + xyz[1] + xyz[2];
        EXPECT_NEAR(xyz[0] / sum, lamp.x, lamp.tolerance) << name_of(lamp.illuminant);
        EXPECT_NEAR(xyz[1] / sum, lamp.y, lamp.tolerance) << name_of(lamp.illuminant);
        EXPECT_DOUBLE_EQ(xyz[1], 1) << name_of(lamp.illuminant);
    }
}

TEST(Illuminants, HaveNames) {
    for (const Published& lamp : kPublished) {
        EXPECT_EQ(illuminant_from_name(name_of(lamp.illuminant)), lamp.illuminant);
    }
    EXPECT_THROW(illuminant_from_name("neon"), InvalidArgument);
}

TEST(Illuminants, TungstenIsTheTableOfIlluminantA) {
    for (const auto& [nm, power] : {std::pair(380.0, 9.7951), std::pair(450.0, 33.0859),
                                    std::pair(560.0, 100.0), std::pair(780.0, 241.675)}) {
        EXPECT_NEAR(relative_power(Illuminant::kTungsten, nm) / power, 1, 2e-5) << nm;
    }
}

// Values of the CIE's table; its peak is 18.87 at 450 nm.
TEST(Illuminants, LedIsWithinFourPercentOfThePeakOfLedB3) {
    const double table[][2] = {{425, 2.37},  {440, 12.11}, {450, 18.87}, {460, 9.90},
                               {475, 5.11},  {500, 8.94},  {550, 14.26}, {595, 16.55},
                               {640, 11.71}, {700, 2.95},  {760, 0.50}};
    for (const auto& row : table) {
        EXPECT_NEAR(relative_power(Illuminant::kLed, row[0]), row[1], 0.04 * 18.87) << row[0];
    }
}

TEST(Illuminants, LinesAreBandsAtTheirWavelengths) {
    const auto sodium = sample_spectrum(64, WavelengthSpacing::kLogarithmic, Illuminant::kSodium);
    ASSERT_EQ(sodium.size(), 2U);
    EXPECT_DOUBLE_EQ(sodium[0].wavelength_nm, 588.995);
    EXPECT_DOUBLE_EQ(sodium[1].wavelength_nm, 589.592);
    EXPECT_NEAR(sodium[0].y, 2.0 / 3, 0.005);

    const auto mercury = sample_spectrum(64, WavelengthSpacing::kLinear, Illuminant::kMercury);
    ASSERT_EQ(mercury.size(), 70U);
    EXPECT_DOUBLE_EQ(mercury[67].wavelength_nm, 546.075);
    // Green and yellow lines make most of its light.
    EXPECT_GT(mercury[67].y, 0.4);
    EXPECT_GT(mercury[67].y + mercury[68].y + mercury[69].y, 0.8);
}

TEST(Illuminants, LinesOutsideTheRangeAreLeftOut) {
    const auto bands =
        sample_spectrum(8, WavelengthSpacing::kLinear, Illuminant::kMercury, {430, 577.5});
    EXPECT_EQ(bands.size(), 11U);
    EXPECT_THROW(sample_spectrum(8, WavelengthSpacing::kLinear, Illuminant::kSodium, {400, 500}),
                 InvalidArgument);
}

class LampWeights : public testing::TestWithParam<Illuminant> {};

// The rule of energy: each component sums to 1, and where the source has the component, its
// weights times the source's colour are the light of the bands.
TEST_P(LampWeights, SumToOneAndKeepTheColour) {
    const Rgb lamp = rgb_from_xyz(tristimulus(GetParam()));
    for (const int count : {1, 33, 256}) {
        const auto bands = sample_spectrum(count, WavelengthSpacing::kLogarithmic, GetParam());
        Rgb sum{};
        double sum_y = 0;
        for (const SpectralBand& band : bands) {
            for (std::size_t c = 0; c < 3; ++c) sum[c] += band.rgb[c];
            sum_y += band.y;
            const double luminance_of_band =
                luminance({lamp[0] * band.rgb[0], lamp[1] * band.rgb[1], lamp[2] * band.rgb[2]});
            EXPECT_NEAR(luminance_of_band, band.y, 3e-3);
        }
        for (const double s : {sum[0], sum[1], sum[2], sum_y}) EXPECT_NEAR(s, 1, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(Lamps, LampWeights,
                         testing::Values(Illuminant::kD65, Illuminant::kTungsten,
                                         Illuminant::kSodium, Illuminant::kHighPressureSodium,
                                         Illuminant::kMercury, Illuminant::kLed),
                         [](const auto& instance) {
                             std::string name(name_of(instance.param));
                             std::erase(name, '-');
                             return name;
                         });

// High-pressure sodium has next to no blue in sRGB: its weights would be 15 times the light.
TEST(Illuminants, MissingComponentsTakeTheWeightsOfLuminance) {
    const auto bands =
        sample_spectrum(64, WavelengthSpacing::kLogarithmic, Illuminant::kHighPressureSodium);
    for (const SpectralBand& band : bands) EXPECT_EQ(band.rgb[2], band.y);
    const auto lies_apart = [](const SpectralBand& band) { return band.rgb[0] != band.y; };
    EXPECT_TRUE(std::all_of(bands.begin(), bands.end(), lies_apart));
}

}  // namespace
}  // namespace aureole::color
