#include "aureole/color/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"

namespace aureole::color {
namespace {

TEST(Rgb, MatricesAreInverse) {
    const Rgb colour = {0.2, -1.3, 40.0};
    const Rgb back = rgb_from_xyz(xyz_from_rgb(colour));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], colour[c], 1e-12);
    // The inverse that IEC 61966-2-1 prints.
    const Rgb from_x = rgb_from_xyz({1, 0, 0});
    const Rgb from_y = rgb_from_xyz({0, 1, 0});
    const Rgb from_z = rgb_from_xyz({0, 0, 1});
    const double printed[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(from_x[c], printed[c][0], 2e-4);
        EXPECT_NEAR(from_y[c], printed[c][1], 2e-4);
        EXPECT_NEAR(from_z[c], printed[c][2], 2e-4);
    }
}

TEST(Rgb, WhiteIsD65AndPrimariesAreThoseOfSrgb) {
    const auto expect_xy = [](const Rgb& rgb, double x, double y) {
        EXPECT_NEAR(chromaticity(rgb)[0], x, 1e-4);
        EXPECT_NEAR(chromaticity(rgb)[1], y, 1e-4);
    };
    expect_xy({1, 1, 1}, 0.3127, 0.3290);
    expect_xy({1, 0, 0}, 0.64, 0.33);
    expect_xy({0, 1, 0}, 0.30, 0.60);
    expect_xy({0, 0, 1}, 0.15, 0.06);
}

TEST(Rgb, LuminanceIsY) {
    const Rgb colour = {3, 0.5, 7};
    EXPECT_NEAR(xyz_from_rgb(colour)[1], luminance(colour), 1e-12);
    EXPECT_NEAR(luminance({1, 1, 1}), 1, 1e-12);
}

TEST(Rgb, SrgbEncodingHasItsPublishedValuesAndInverse) {
    EXPECT_NEAR(srgb_encode(0.18F), 0.461356, 1e-5);
    EXPECT_NEAR(srgb_encode(0.5F), 0.735357, 1e-5);
    EXPECT_NEAR(srgb_encode(0.002F), 0.02584, 1e-6);
    EXPECT_FLOAT_EQ(srgb_encode(-0.5F), -srgb_encode(0.5F));
    for (const float v : {-2.0F, -0.01F, 0.0F, 0.001F, 0.0031F, 0.0032F, 0.2F, 1.0F, 8.0F}) {
        EXPECT_NEAR(srgb_decode(srgb_encode(v)), v, 1e-6F * std::max(1.0F, std::abs(v)));
    }
}

// CIE 1931 2-degree observer, CIE 015 table: the fit's stated errors are .015, .008, .024.
TEST(Observer, IsWithinTheStatedErrorOfTheCieTable) {
    const double table[][4] = {{400, 0.01431, 0.000396, 0.06785}, {450, 0.33620, 0.03800, 1.77211},
                               {500, 0.00490, 0.32300, 0.27200},  {550, 0.43345, 0.99495, 0.00875},
                               {600, 1.06220, 0.63100, 0.00080},  {650, 0.28350, 0.10700, 0.0},
                               {700, 0.011359, 0.004102, 0.0}};
    for (const auto& row : table) {
        const Xyz xyz = cie_1931_observer(row[0]);
        EXPECT_NEAR(xyz[0], row[1], 0.015) << row[0];
        EXPECT_NEAR(xyz[1], row[2], 0.008) << row[0];
        EXPECT_NEAR(xyz[2], row[3], 0.024) << row[0];
    }
}

Rgb integral(Illuminant illuminant) {
    Xyz sum{};
    for (double nm = 380.5; nm < 780; nm += 1) {
        const Xyz observer = cie_1931_observer(nm);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += observer[c] * relative_power(illuminant, nm);
    }
    return rgb_from_xyz({sum[0] / sum[1], 1, sum[2] / sum[1]});
}

TEST(Illuminant, D65IsWhiteThroughTheObserver) {
    const auto xy = chromaticity(integral(Illuminant::kD65));
    EXPECT_NEAR(xy[0], 0.3127, 0.002);
    EXPECT_NEAR(xy[1], 0.3290, 0.002);
}

TEST(Illuminant, EqualEnergyIsPink) {
    const Rgb rgb = integral(Illuminant::kEqualEnergy);
    EXPECT_NEAR(rgb[0], 1.20, 0.015);
    EXPECT_NEAR(rgb[1], 0.95, 0.015);
    EXPECT_NEAR(rgb[2], 0.91, 0.015);
}

TEST(Illuminant, IsNormalisedInterpolatedAndClamped) {
    EXPECT_DOUBLE_EQ(relative_power(Illuminant::kD65, 560), 100);
    EXPECT_NEAR(relative_power(Illuminant::kD65, 565), (100 + 96.3342) / 2, 1e-9);
    EXPECT_DOUBLE_EQ(relative_power(Illuminant::kD65, 300), 49.9755);
    EXPECT_DOUBLE_EQ(relative_power(Illuminant::kD65, 900), 63.3828);
    EXPECT_DOUBLE_EQ(relative_power(Illuminant::kEqualEnergy, 412), 100);
}

TEST(SampleSpectrum, WeightsSumToOnePerComponent) {
    for (const auto spacing : {WavelengthSpacing::kLogarithmic, WavelengthSpacing::kLinear}) {
        for (const auto illuminant : {Illuminant::kD65, Illuminant::kEqualEnergy}) {
            for (const int count : {1, 2, 7, 32, 64, 500}) {
                Rgb sum{};
                double y = 0;
                for (const SpectralBand& band : sample_spectrum(count, spacing, illuminant)) {
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += band.rgb[c];
                    y += band.y;
                }
                for (const double s : {sum[0], sum[1], sum[2], y}) EXPECT_NEAR(s, 1, 1e-12);
            }
        }
    }
}

TEST(SampleSpectrum, SpacingIsAsNamed) {
    const auto logarithmic = sample_spectrum(64);
    const auto linear = sample_spectrum(32, WavelengthSpacing::kLinear);
    for (std::size_t i = 2; i < logarithmic.size(); ++i) {
        EXPECT_NEAR(logarithmic[i].wavelength_nm / logarithmic[i - 1].wavelength_nm,
                    std::pow(770.0 / 380, 1.0 / 64), 1e-12);
    }
    for (std::size_t i = 0; i < linear.size(); ++i) {
        EXPECT_NEAR(linear[i].wavelength_nm, 380 + 390.0 / 32 * (static_cast<double>(i) + 0.5),
                    1e-9);
    }
}

// Blue, then green, then red leads; and the spectral locus is outside the gamut.
TEST(SampleSpectrum, MonochromaticHuesAreInOrder) {
    const auto bands = sample_spectrum(200);
    const auto at = [&](double nm) {
        const SpectralBand* best = bands.data();
        for (const SpectralBand& band : bands) {
            if (std::abs(band.wavelength_nm - nm) < std::abs(best->wavelength_nm - nm)) {
                best = &band;
            }
        }
        return best->rgb;
    };
    const Rgb blue = at(450);
    const Rgb green = at(530);
    const Rgb red = at(640);
    EXPECT_GT(blue[2], std::max(blue[0], blue[1]));
    EXPECT_GT(green[1], std::max(green[0], green[2]));
    EXPECT_GT(red[0], std::max(red[1], red[2]));
    EXPECT_LT(at(500)[0], 0);
}

// Band integrals, not samples: cutting every band in two adds up to the same weights.
TEST(SampleSpectrum, RefinesConsistently) {
    const auto coarse = sample_spectrum(16);
    const auto fine = sample_spectrum(32);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(coarse[i].rgb[c], fine[2 * i].rgb[c] + fine[2 * i + 1].rgb[c], 2e-4);
        }
    }
}

TEST(SampleSpectrum, RefusesWhatHasNoMeaning) {
    EXPECT_THROW(sample_spectrum(0), InvalidArgument);
    const auto with_range = [](double low, double high) {
        return sample_spectrum(8, WavelengthSpacing::kLogarithmic, Illuminant::kD65, {low, high});
    };
    EXPECT_THROW(with_range(0, 700), InvalidArgument);
    EXPECT_THROW(with_range(600, 500), InvalidArgument);
    EXPECT_THROW(with_range(380, INFINITY), InvalidArgument);
    EXPECT_THROW(with_range(2000, 3000), InvalidArgument) << "invisible";
    EXPECT_THROW(single_wavelength(0), InvalidArgument);
    EXPECT_NO_THROW(with_range(400, 700));
}

TEST(SingleWavelength, HasUnitWeight) {
    const auto bands = single_wavelength(568);
    ASSERT_EQ(bands.size(), 1U);
    EXPECT_EQ(bands[0].wavelength_nm, 568);
    EXPECT_EQ(bands[0].rgb, (Rgb{1, 1, 1}));
    EXPECT_EQ(bands[0].y, 1);
}

}  // namespace
}  // namespace aureole::color
