// Laws of the star around a bright point.
#include "aureole/lens/starburst.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/units.h"
#include "lens/starburst_aperture.h"
#include "lens/starburst_test_support.h"

namespace aureole::lens {
namespace {

TEST(Starburst, OfARoundIrisIsAnAiryPattern) {
    constexpr double kDiameterMm = 4;
    // Near the axis, with pixels of a twentieth of lambda / D.
    const auto near = starburst_psf(Iris(), kDiameterMm, grid_of(331, 0.05, kDiameterMm), kOneBand);
    for (const double radius : {1.0, 1.22, 2.0, 2.233, 3.238, 5.0, 8.0}) {
        EXPECT_NEAR(encircled(near, 1, 20 * radius), 1 - airy_outside(radius), 1e-3) << radius;
    }
    // Around and far beyond the end of the raster, which is at 210 lambda / D. The share outside
    // to 1 %, where 2 % per pixel of radius are at stake.
    const auto far = starburst_psf(Iris(), kDiameterMm, grid_of(401, 8, kDiameterMm), kOneBand);
    for (const double radius : {80.0, 150.0, 200.0, 300.0, 600.0, 1500.0}) {
        const double outside = 1 - encircled(far, 1, radius / 8);
        // Between the dark rings J0^2 + J1^2 runs along 2 / (pi v).
        EXPECT_NEAR(outside / (2 / (kPi * kPi * radius)), 1, 0.01) << radius;
    }
}

TEST(Starburst, FirstDarkRingOfARoundIris) {
    constexpr double kDiameterMm = 4;
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid_of(101, 0.05, kDiameterMm), kOneBand);
    int darkest = 1;
    for (int x = 1; x < 40; ++x) {
        if (psf.kernel.at(50 + x, 50, 1) < psf.kernel.at(50 + darkest, 50, 1)) darkest = x;
    }
    // The parabola through the darkest pixel and its neighbours.
    const auto at = [&](int x) { return static_cast<double>(psf.kernel.at(50 + x, 50, 1)); };
    const double left = at(darkest - 1) - at(darkest);
    const double right = at(darkest + 1) - at(darkest);
    const double position = darkest + 0.5 * (left - right) / (left + right);
    EXPECT_NEAR(position * 0.05, 1.2197, 0.01);
}

// Far from the axis a share P lambda / (2 pi^2 A theta) lies outside theta, P being the perimeter
// and A the area of the opening (Clark, Howard & Freniere 1984, Appl. Opt. 23, 353).
TEST(Starburst, ObeysThePerimeterLaw) {
    constexpr double kDiameterMm = 5;
    for (const IrisShape& shape :
         {IrisShape{}, IrisShape{.blades = 6, .rotation_deg = 11}, IrisShape{.blades = 5},
          IrisShape{.blades = 7, .curvature = 0.5}, IrisShape{.blades = 6, .smoothing = 0.1}}) {
        const Iris iris(shape);
        double area = 0;
        double perimeter = 0;
        for (const auto& outline : outline_of(iris, kDiameterMm / 2).outlines) {
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const wave::Point& a = outline[i];
                const wave::Point& b = outline[(i + 1) % outline.size()];
                area += 0.5 * (a.x_mm * b.y_mm - b.x_mm * a.y_mm);
                perimeter += std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm);
            }
        }
        EXPECT_NEAR(area / (kPi * kDiameterMm * kDiameterMm / 4), 1, 1e-4);
        for (const double q : {2.0, 10.0, 60.0}) {
            const auto grid = grid_of(301, q, kDiameterMm);
            const auto psf = starburst_psf(iris, kDiameterMm, grid, kOneBand);
            for (const double radius_px : {30.0, 75.0, 150.0}) {
                const double sine = std::sin(radius_px * rad_from_deg(grid.pitch_deg));
                const double law = perimeter * kOneBandMm / (2 * kPi * kPi * area * sine);
                EXPECT_NEAR((1 - encircled(psf, 1, radius_px)) / law, 1, 0.02)
                    << shape.blades << ' ' << q << ' ' << radius_px;
            }
        }
    }
}

// The same with all wavelengths, ring by ring, right through where raster and law meet.
TEST(Starburst, HasNoSeam) {
    constexpr double kDiameterMm = 6;
    const auto grid = grid_of(401, 8, kDiameterMm);
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid, kSmall);
    const auto bands = color::sample_spectrum(64);
    const double pixel = rad_from_deg(grid.pitch_deg);
    for (int c = 0; c < 3; ++c) {
        double mean_mm = 0;
        for (const auto& band : bands) {
            mean_mm += band.rgb[static_cast<std::size_t>(c)] * mm_from_nm(band.wavelength_nm);
        }
        for (double r = 8; r < 190; r *= 1.12) {
            // Density P lambda / (4 pi^3 A theta^3) = 1 / (pi^3 D theta^3) lambda, over the ring.
            const double low = r * pixel;
            const double high = 1.12 * r * pixel;
            const double energy = 2 * mean_mm / (kPi * kPi * kDiameterMm) * (1 / low - 1 / high);
            const double measured = sum(psf, c, [&](int x, int y) {
                return inside_circle(x, y, 1.12 * r) - inside_circle(x, y, r);
            });
            EXPECT_NEAR(measured / energy, 1, 0.015) << "channel " << c << ", " << r << " px";
        }
    }
}

TEST(Starburst, CountsItsSpikes) {
    constexpr double kDiameterMm = 5;
    // Inside the raster, across its end, and beyond.
    for (const double from : {12.0, 22.0, 90.0}) {
        for (const auto& [blades, expected] : {std::pair{6, 6}, {5, 10}, {8, 8}, {7, 14}}) {
            const Iris iris({.blades = blades, .rotation_deg = 10});
            const auto psf = starburst_psf(iris, kDiameterMm, grid_of(401, 8, kDiameterMm), kSmall);
            const auto found = spikes(by_direction(psf, from, 2 * from, 180), 2);
            ASSERT_EQ(found.size(), static_cast<std::size_t>(expected)) << blades << ' ' << from;
            // Across the edges: half a blade from the corners, counter-clockwise from 10 deg. An
            // odd number of blades sends the light of each to both sides.
            const double step = 360.0 / expected;
            const double first = std::fmod(10 + 180.0 / blades, step);
            for (std::size_t i = 0; i < found.size(); ++i) {
                // A pixel at the inner radius subtends 5 deg.
                EXPECT_NEAR(found[i], first + static_cast<double>(i) * step, 1) << blades;
            }
        }
    }
}

TEST(Starburst, TurnsWithTheIris) {
    constexpr double kDiameterMm = 5;
    const auto grid = grid_of(121, 4, kDiameterMm);
    const auto a = starburst_psf(Iris({.blades = 5, .rotation_deg = 7}), kDiameterMm, grid, kSmall);
    const auto b =
        starburst_psf(Iris({.blades = 5, .rotation_deg = 97}), kDiameterMm, grid, kSmall);
    for (int y = -60; y <= 60; ++y) {
        for (int x = -60; x <= 60; ++x) {
            // A quarter turn counter-clockwise takes (x, y) up to (-y, x).
            const double before = static_cast<double>(a.kernel.at(60 + x, 60 - y, 1));
            const double after = static_cast<double>(b.kernel.at(60 - y, 60 - x, 1));
            ASSERT_NEAR(after, before, 1e-3 * before + 1e-10) << x << ' ' << y;
        }
    }
}

TEST(Starburst, RedSpreadsFartherThanBlue) {
    constexpr double kDiameterMm = 4;
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid_of(401, 0.05, kDiameterMm), kSmall);
    const auto half_energy_px = [&](int c) {
        double radius = 1;
        while (encircled(psf, c, radius) < 0.5) radius += 0.25;
        return radius;
    };
    EXPECT_GT(half_energy_px(0), 1.1 * half_energy_px(1));
    EXPECT_GT(half_energy_px(1), 1.1 * half_energy_px(2));
}

// lambda / D: half the pupil, twice the angle.
TEST(Starburst, FSixteenSpreadsTwiceAsFarAsFEight) {
    const Iris iris({.blades = 6, .rotation_deg = 5});
    wave::KernelGrid grid = grid_of(201, 3, 6.25);
    const auto f8 = starburst_psf(iris, 6.25, grid, kSmall);
    grid.pitch_deg *= 2;
    const auto f16 = starburst_psf(iris, 3.125, grid, kSmall);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < f8.kernel.pixels(); ++i) {
            const double wide = static_cast<double>(f8.kernel.plane(c)[i]);
            ASSERT_NEAR(static_cast<double>(f16.kernel.plane(c)[i]), wide,
                        2e-3 * std::abs(wide) + 1e-9);
        }
    }
}

TEST(Starburst, HasUnitEnergyOfAnySize) {
    const Iris iris({.blades = 6, .curvature = 0.3, .smoothing = 0.1});
    auto projection = Projection::kPerspective;
    for (const double diameter_mm : {0.02, 2.0, 400.0}) {
        for (const double pitch_deg : {1e-4, 0.02, 3.0}) {
            const wave::KernelGrid grid{41, 23, pitch_deg, projection};
            const auto psf = starburst_psf(iris, diameter_mm, grid, {.samples = 256});
            EXPECT_LT(energy_error(psf), 1e-6) << diameter_mm << " mm, " << pitch_deg << " deg";
            // By turns, nine times: each size and each pitch meets both.
            projection = projection == Projection::kPerspective ? Projection::kConstantPitch
                                                                : Projection::kPerspective;
        }
    }
}

// Pixels so large that nearly all is in one: white in, white out.
TEST(Starburst, WhiteStaysWhite) {
    const auto psf = starburst_psf(Iris({.blades = 6}), 20, grid_of(41, 100, 20), kSmall);
    EXPECT_LT(energy_error(psf), 1e-6);
    std::array<double, 3> near = {};
    for (int c = 0; c < 3; ++c) near[static_cast<std::size_t>(c)] = encircled(psf, c, 5);
    EXPECT_GT(near[1], 0.999);
    EXPECT_NEAR(near[0], near[1], 1e-4);
    EXPECT_NEAR(near[2], near[1], 1e-4);
}

// What lies beyond a kernel is what the perimeter law says (here: around a square, by the integral
// of 1 / r^3 outside it, 2 sqrt(2) times the inverse half side over pi times that of a disc).
TEST(Starburst, KnowsWhatLiesBeyondTheKernel) {
    constexpr double kDiameterMm = 3;
    const auto grid = grid_of(101, 6, kDiameterMm);
    const auto psf = starburst_psf(Iris(), kDiameterMm, grid, kOneBand);
    const double half_side = 50.5 * 6;  // lambda / D
    const double law = 2 / (kPi * kPi * half_side) * (2 * std::sqrt(2.0) / kPi);
    EXPECT_NEAR(psf.off_kernel_energy[1] / law, 1, 0.01);
}

// The raster is as small as pixels allow (docs/starburst.md). Against one four times as fine.
TEST(Starburst, DoesNotDependOnTheRaster) {
    constexpr double kDiameterMm = 5;
    for (const double q : {0.3, 1.0, 4.0, 8.0}) {
        const auto grid = grid_of(101, q, kDiameterMm);
        const auto coarse = starburst_psf(Iris(), kDiameterMm, grid, {.samples = 512});
        const auto fine = starburst_psf(Iris(), kDiameterMm, grid, {.samples = 2048});
        for (int c = 0; c < 3; ++c) {
            for (double r = 1; r < 30; r *= 1.5) {
                const double mean = ring_mean(fine, c, r, 1.5 * r);
                EXPECT_NEAR(ring_mean(coarse, c, r, 1.5 * r) / mean, 1, 0.01)
                    << "pixels of " << q << ", channel " << c << ", " << r << " px";
            }
        }
    }
}

}  // namespace
}  // namespace aureole::lens
