#include "aureole/wave/diffraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/huygens_fresnel.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

Pattern diffract(const Mask& mask) {
    Field field = field_from(mask);
    fourier::Fft2d fft(mask.grid.samples, mask.grid.samples);
    return fraunhofer(field, fft);
}

double energy_at(const Pattern& pattern, int k, int l) {
    const int n = pattern.grid.samples;
    return static_cast<double>(
        pattern.energy[static_cast<std::size_t>(l + n / 2) * static_cast<std::size_t>(n) +
                       static_cast<std::size_t>(k + n / 2)]);
}

// An aperture without any symmetry.
Mask odd_mask(const ApertureGrid& grid) {
    Mask mask(grid);
    draw(mask, regular_polygon(5, grid.extent_mm * 0.2, 13, 0.3, {0.02 * grid.extent_mm, 0}));
    draw(mask,
         lash({{0.03 * grid.extent_mm, -0.05 * grid.extent_mm},
               70,
               0.02 * grid.extent_mm,
               0.1 * grid.extent_mm,
               grid.extent_mm}),
         Blend::kMultiply, 0);
    return mask;
}

TEST(Fraunhofer, UnitEnergyOverAllDirections) {
    const Mask mask = odd_mask({256, 0.05});  // 50 um: a wide pattern, cos(theta) matters
    const Pattern pattern = diffract(mask);
    double energy = 0;
    double radiated = 0;
    const double wavelength = 550;
    const double step = pattern.step(wavelength);
    for (int l = -128; l < 128; ++l) {
        for (int k = -128; k < 128; ++k) {
            energy += energy_at(pattern, k, l);
            const double sine2 = (k * k + l * l) * step * step;
            if (sine2 >= 1) {
                EXPECT_EQ(pattern.intensity_per_sr(k, l, wavelength), 0);
                continue;
            }
            radiated +=
                pattern.intensity_per_sr(k, l, wavelength) * step * step / std::sqrt(1 - sine2);
        }
    }
    EXPECT_NEAR(energy, 1, 1e-5);
    EXPECT_GT(step * 128, 1);        // the band reaches beyond 90 deg: some samples are evanescent
    EXPECT_NEAR(radiated, 1, 5e-3);  // the evanescent corners hold the rest
}

// Independent oracle: the definition, in doubles, about the axis, for a mask of uniform squares.
TEST(Fraunhofer, IsTheFourierIntegralOfTheMask) {
    const Mask mask = odd_mask({48, 3});
    const Pattern pattern = diffract(mask);
    const auto integral = [&](int k, int l) {
        std::complex<double> sum = 0;
        for (int j = 0; j < 48; ++j) {
            for (int i = 0; i < 48; ++i) {
                const double turns = (k * mask.grid.x_mm(i) + l * mask.grid.y_mm(j)) / 3;
                sum += static_cast<double>(mask.row(j)[i]) * std::polar(1.0, -2 * kPi * turns);
            }
        }
        const auto swallowed = [](int m) {
            const double x = kPi * m / 48;
            return m == 0 ? 1 : std::sin(x) / x;
        };
        return std::norm(sum / (swallowed(k) * swallowed(l)));
    };
    const double scale = energy_at(pattern, 0, 0) / integral(0, 0);
    for (int l = -24; l < 24; l += 5) {
        for (int k = -24; k < 24; k += 3) {
            EXPECT_NEAR(energy_at(pattern, k, l), scale * integral(k, l), 1e-7) << k << ", " << l;
        }
    }
}

TEST(Fraunhofer, ComplementaryScreensMatchOffTheAxis) {
    const ApertureGrid grid{128, 4};
    Mask opening(grid);
    draw(opening, disc(0.6, {0.3, 0.1}));
    Mask screen(grid, 1);
    draw(screen, disc(0.6, {0.3, 0.1}), Blend::kMultiply, 0);
    Field a = field_from(opening);
    Field b = field_from(screen);
    fourier::Fft2d fft(128, 128);
    transform(a, fft);
    transform(b, fft);
    for (std::size_t s = 1; s < grid.size(); ++s) {
        ASSERT_NEAR(a.re[s], -b.re[s], 2e-3) << s;
        ASSERT_NEAR(a.im[s], -b.im[s], 2e-3) << s;
    }
    EXPECT_GT(std::abs(a.re[0] + b.re[0]), 1000);
}

// What sees a raster that is centred between samples (thesis figs. 3.10-3.11): how far the
// centre of gravity of the defocused pattern is from the axis, in samples, and the largest
// difference between opposite samples relative to the peak.
struct Centring {
    double offset = 0;
    double asymmetry = 0;
};
Centring centring(const Mask& mask, double defocus_dioptres) {
    Field field = field_from(mask);
    add_defocus(field, defocus_dioptres, 550);
    fourier::Fft2d fft(mask.grid.samples, mask.grid.samples);
    const Pattern pattern = fraunhofer(field, fft);
    const int half = mask.grid.samples / 2;
    double x = 0;
    double y = 0;
    double peak = 0;
    Centring result;
    for (int l = -half + 1; l < half; ++l) {
        for (int k = -half + 1; k < half; ++k) {
            const double e = energy_at(pattern, k, l);
            x += k * e;
            y += l * e;
            peak = std::max(peak, e);
            result.asymmetry = std::max(result.asymmetry, std::abs(e - energy_at(pattern, -k, -l)));
        }
    }
    result.asymmetry /= peak;
    result.offset = std::hypot(x, y);
    return result;
}

TEST(Fraunhofer, HalfATexelOfSlipIsCaught) {
    const ApertureGrid grid{256, 10};
    const double slip = grid.spacing_mm() / 2;
    Mask centred(grid);
    draw(centred, disc(2));
    Mask slipped(grid);
    draw(slipped, disc(2, {slip, slip}));

    const Centring good = centring(centred, 2);
    EXPECT_LT(good.offset, 0.01);
    EXPECT_LT(good.asymmetry, 1e-5);

    // The same check fails for the slipped mask. Defocus D moves the light by D * slip in angle.
    const Centring bad = centring(slipped, 2);
    const double expected = std::sqrt(2.0) * 2e-3 * slip / (550e-6 / grid.extent_mm);
    EXPECT_NEAR(bad.offset, expected, 0.2);
    EXPECT_GT(bad.offset, 0.5);
    EXPECT_GT(bad.asymmetry, 0.01);
}

TEST(Fraunhofer, WingsAtThousandSamplesFollowTheAiryPattern) {
    // Energy from 100 to 200 lambda/D. Beyond rho lambda/D an Airy pattern has J0^2 + J1^2 of
    // pi rho, on average 2 / (pi^2 rho).
    const ApertureGrid grid{1024, 2};
    const auto wings = [&](const Mask& mask) {
        const Pattern pattern = diffract(mask);
        double energy = 0;
        for (int l = -512; l < 512; ++l) {
            for (int k = -512; k < 512; ++k) {
                const double rho = std::hypot(k, l) / 2;
                if (rho >= 100 && rho < 200) energy += energy_at(pattern, k, l);
            }
        }
        return energy / (2 / (kPi * kPi) * (1.0 / 100 - 1.0 / 200));
    };
    Mask smooth(grid);
    draw(smooth, disc(0.5));
    Mask hard(grid);
    for (int j = 0; j < 1024; ++j) {
        for (int i = 0; i < 1024; ++i) {
            hard.row(j)[i] = std::hypot(grid.x_mm(i), grid.y_mm(j)) < 0.5 ? 1.0F : 0.0F;
        }
    }
    const double antialiased = wings(smooth);
    EXPECT_NEAR(antialiased, 1, 0.02);
    EXPECT_GT(wings(hard), 1.5 * antialiased);
}

TEST(Fraunhofer, ClosedMasksAndWrongSizesAreNamed) {
    fourier::Fft2d fft(64, 64);
    Field closed({64, 1});
    try {
        fraunhofer(closed, fft);
        FAIL();
    } catch (const InvalidArgument& error) {
        EXPECT_NE(std::string(error.what()).find("no opening"), std::string::npos);
    }
    Field other({32, 1});
    EXPECT_THROW(fraunhofer(other, fft), InvalidArgument);
    EXPECT_THROW(add_defocus(closed, 1, 0), InvalidArgument);
    EXPECT_THROW(add_fresnel_term(closed, 0, 550), InvalidArgument);
    const Point axis{};
    EXPECT_THROW(huygens_fresnel(closed, 550, 10, {&axis, 1}), InvalidArgument);
    Field large({32, 1});
    EXPECT_THROW(multiply(large, Mask({64, 1})), InvalidArgument);
}

TEST(Defocus, ChromaticAberrationVanishesAtItsReferenceAndGrowsToTheBlue) {
    EXPECT_NEAR(chromatic_defocus_dioptres(580), 0, 2e-3);
    // Thibos et al. 1992: about -1.7 D at 400 nm and +.4 D at 700 nm.
    EXPECT_NEAR(chromatic_defocus_dioptres(400), -1.68, 0.05);
    EXPECT_NEAR(chromatic_defocus_dioptres(700), 0.43, 0.05);
}

TEST(HuygensFresnel, FarAwayIsFraunhofer) {
    // A 60 um opening at 100 mm: Fresnel number .016.
    const Mask mask = odd_mask({192, 0.15});
    const Field field = field_from(mask);
    const double wavelength = 550;
    const double z = 100;
    const Pattern pattern = diffract(mask);
    const double peak = pattern.intensity_per_sr(0, 0, wavelength);
    const Point centre{};
    const double axis = huygens_fresnel_per_sr(field, wavelength, z, {&centre, 1}).front();
    EXPECT_NEAR(axis / peak, 1, 0.01);  // edge samples: the energy is uncertain by 1 %
    for (int l = -8; l <= 8; l += 4) {
        for (int k = -10; k <= 10; k += 5) {
            const double alpha = k * pattern.step(wavelength);
            const double beta = l * pattern.step(wavelength);
            const double cosine = std::sqrt(1 - alpha * alpha - beta * beta);
            const Point point{z * alpha / cosine, z * beta / cosine};
            const double per_sr = huygens_fresnel_per_sr(field, wavelength, z, {&point, 1}).front();
            EXPECT_NEAR(per_sr / axis, pattern.intensity_per_sr(k, l, wavelength) / peak, 1e-3)
                << k << ", " << l;
        }
    }
}

TEST(HuygensFresnel, NearbyIsFresnel) {
    // A 1 mm opening at 100 mm: Fresnel number 4.5. One transform of the aperture times the
    // quadratic phase gives the plane at distance z in steps of lambda z / L.
    const Mask mask = odd_mask({256, 2.5});
    const double wavelength = 550;
    const double z = 100;
    const Field opening = field_from(mask);
    Field field = field_from(mask);
    add_fresnel_term(field, z, wavelength);
    fourier::Fft2d fft(256, 256);
    transform(field, fft);
    const double step = mm_from_nm(wavelength) * z / mask.grid.extent_mm;
    const double scale = std::pow(mask.grid.spacing_mm(), 2) / (mm_from_nm(wavelength) * z);
    for (int l = -24; l <= 24; l += 6) {
        for (int k = -24; k <= 24; k += 8) {
            const Point point{k * step, l * step};
            const auto e = huygens_fresnel(opening, wavelength, z, {&point, 1}).front();
            const std::size_t s = static_cast<std::size_t>((l + 256) % 256 * 256 + (k + 256) % 256);
            const std::complex<double> transformed(static_cast<double>(field.re[s]),
                                                   static_cast<double>(field.im[s]));
            EXPECT_NEAR(std::norm(e), std::norm(transformed * scale), 5e-3) << k << ", " << l;
        }
    }
}

TEST(HuygensFresnel, ObliqueWaveletsAreWeaker) {
    // On the axis of a hole as wide as it is far away, the integral is elementary up to 1/(k z):
    // E = exp(i k z) - z/rho exp(i k rho), rho the distance of the rim.
    const double radius = 0.02;
    Mask mask({640, 0.044});
    draw(mask, disc(radius));
    const Field field = field_from(mask);
    const Point axis{};
    const double k = 2 * kPi / 500e-6;
    for (const double z : {0.0200, 0.0201, 0.0300, 0.0303}) {
        const double rho = std::hypot(radius, z);
        const auto want = std::polar(1.0, k * z) - std::polar(z / rho, k * rho);
        const auto found = huygens_fresnel(field, 500, z, {&axis, 1}).front();
        EXPECT_NEAR(std::abs(found - want), 0, 0.02) << z;
    }
}

TEST(Defocus, OfAnInvertedLensUndoesTheFresnelTerm) {
    Field field = field_from(odd_mask({64, 2}));
    const Field before = field_from(odd_mask({64, 2}));
    add_fresnel_term(field, 24, 575);
    add_defocus(field, -1000.0 / 24, 575);
    for (std::size_t s = 0; s < field.grid.size(); ++s) {
        ASSERT_NEAR(field.re[s], before.re[s], 1e-5);
        ASSERT_NEAR(field.im[s], before.im[s], 1e-5);
    }
}

TEST(Rings, MeansAreThoseOfRoundedDistances) {
    Field field = field_from(odd_mask({60, 2}));
    fourier::Fft2d fft(60, 60);
    transform(field, fft);
    std::vector<double> sum(static_cast<std::size_t>(ring_count(60)), 0);
    std::vector<double> count(sum.size(), 0);
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 60; ++i) {
            const double k = i < 30 ? i : i - 60;
            const double l = j < 30 ? j : j - 60;
            const auto r = static_cast<std::size_t>(std::lround(std::hypot(k, l)));
            const auto s = static_cast<std::size_t>(j * 60 + i);
            const auto swallowed = [](double m) {
                return m == 0 ? 1 : std::sin(kPi * m / 60) / (kPi * m / 60);
            };
            sum.at(r) += std::norm(std::complex<double>(static_cast<double>(field.re[s]),
                                                        static_cast<double>(field.im[s])) /
                                   (swallowed(k) * swallowed(l)));
            count.at(r) += 1;
        }
    }
    const std::vector<double> means = ring_means(field);
    ASSERT_EQ(means.size(), sum.size());
    for (std::size_t r = 0; r < means.size(); ++r) {
        EXPECT_NEAR(means[r], sum[r] / count[r], 1e-6 * means[0]) << r;
    }
    const ThreadLimit one(1);
    EXPECT_EQ(ring_means(field), means);
}

}  // namespace
}  // namespace aureole::wave
