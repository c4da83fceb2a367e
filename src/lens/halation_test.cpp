// Laws of the light that a film's base throws back.
#include "aureole/lens/halation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "lens/starburst_test_support.h"

namespace aureole::lens {
namespace {

constexpr double kEflMm = 50;
// Pixels of so many mm on the film.
wave::KernelGrid film_grid(int size, double pixel_mm) {
    return {size, size, deg_from_rad(pixel_mm / kEflMm), Projection::kConstantPitch};
}

// Judd 1942, "Fresnel reflection of diffusely incident light": .596 of diffuse light comes back
// from within n = 1.5.
TEST(Halation, ReturnsWhatJuddTabulates) {
    EXPECT_NEAR(diffuse_reflectance(1.5), 0.596, 0.001);
    EXPECT_NEAR(diffuse_reflectance(1.0001), 0, 0.001);
    EXPECT_NEAR(diffuse_reflectance(1.5, 1), 1, 1e-6);
}

TEST(Halation, HasUnitEnergyAtAnyScale) {
    for (const double pixel_mm : {0.001, 0.0188, 0.13, 5.0}) {
        for (const int size : {1, 7, 201}) {
            const auto psf = halation_psf({.share = 0.4}, kEflMm, film_grid(size, pixel_mm));
            EXPECT_LT(energy_error(psf), 1e-5) << pixel_mm << ' ' << size;
            const float middle = psf.kernel.at(size / 2, size / 2, 0);
            EXPECT_GT(middle, 0.6F - 1e-5F) << pixel_mm << ' ' << size;
        }
    }
}

// The middle pixel holds what the sums and the integral outside leave: a small one has its share of
// a smooth, dark middle. It fails if either is off by a thousandth of the ring.
TEST(Halation, PixelsAndWhatLiesBeyondAddUp) {
    constexpr double kLayerMm = 0.13;
    for (const double pixel_mm : {0.005, 0.0188}) {
        const HalationOptions all{
            .share = 1, .layer_mm = kLayerMm, .refractive_index = 1.5, .backing = 0};
        const auto psf = halation_psf(all, kEflMm, film_grid(301, pixel_mm));
        const double t = pixel_mm / (2 * kLayerMm);
        // Straight through: R = ((n - 1) / (n + 1))^2 = .04.
        EXPECT_NEAR(static_cast<double>(psf.kernel.at(150, 150, 0)), 0.04 / (kPi * 0.596) * t * t,
                    1e-3)
            << pixel_mm;
    }
}

// Beyond the critical angle all comes back: the energy outside r is 1 / (1 + (r / 2d)^2) of
// Lambertian light, over what returns.
TEST(Halation, IsARingAtTheCriticalAngle) {
    constexpr double kLayerMm = 0.13;
    constexpr double kPixelMm = 0.01;
    const HalationOptions options{
        .share = 1, .layer_mm = kLayerMm, .refractive_index = 1.5, .backing = 0};
    const auto psf = halation_psf(options, kEflMm, film_grid(401, kPixelMm));
    int brightest = 1;
    for (int x = 1; x < 200; ++x) {
        if (psf.kernel.at(200 + x, 200, 0) > psf.kernel.at(200 + brightest, 200, 0)) brightest = x;
    }
    const double critical_mm = 2 * kLayerMm / std::sqrt(1.5 * 1.5 - 1);
    EXPECT_NEAR(brightest * kPixelMm, critical_mm, 1.5 * kPixelMm);
    for (const double radius_mm : {0.3, 0.6, 1.5}) {
        const double t = radius_mm / (2 * kLayerMm);
        EXPECT_NEAR(1 - encircled(psf, 0, radius_mm / kPixelMm),
                    1 / (1 + t * t) / diffuse_reflectance(1.5), 2e-3)
            << radius_mm;
    }
}

// On a mirror all light comes back: a share 1 / (1 + t^2) of it beyond t, at any radius.
TEST(Halation, OnAMirrorIsLambertian) {
    constexpr double kLayerMm = 0.13;
    constexpr double kPixelMm = 0.01;
    const HalationOptions options{.share = 1, .layer_mm = kLayerMm, .backing = 1};
    const auto psf = halation_psf(options, kEflMm, film_grid(401, kPixelMm));
    for (const double radius_mm : {0.05, 0.1, 0.2, 0.5, 1.8}) {
        const double t = radius_mm / (2 * kLayerMm);
        EXPECT_NEAR(1 - encircled(psf, 0, radius_mm / kPixelMm), 1 / (1 + t * t), 2e-3)
            << radius_mm;
    }
}

TEST(Halation, IsRoundAndGrey) {
    const auto psf = halation_psf({}, kEflMm, film_grid(101, 0.02));
    for (int y = 0; y <= 50; ++y) {
        for (int x = 0; x <= 50; ++x) {
            const float value = psf.kernel.at(50 + x, 50 + y, 0);
            ASSERT_EQ(psf.kernel.at(50 - x, 50 - y, 1), value);
            ASSERT_FLOAT_EQ(psf.kernel.at(50 + y, 50 - x, 2), value);
        }
    }
}

TEST(Halation, SaysWhatIsWrong) {
    const auto grid = film_grid(11, 0.02);
    EXPECT_THROW(halation_psf({.share = 1.1}, kEflMm, grid), InvalidArgument);
    EXPECT_THROW(halation_psf({.layer_mm = 0}, kEflMm, grid), InvalidArgument);
    EXPECT_THROW(halation_psf({.refractive_index = 1}, kEflMm, grid), InvalidArgument);
    EXPECT_THROW(halation_psf({.backing = -0.1}, kEflMm, grid), InvalidArgument);
    EXPECT_THROW(halation_psf({}, 0, grid), InvalidArgument);
    EXPECT_THROW(halation_psf({}, kEflMm, film_grid(10, 0.02)), InvalidArgument);
    EXPECT_THROW(halation_psf({}, kEflMm, film_grid(11, 0)), InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
