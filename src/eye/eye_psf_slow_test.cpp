// The bars of the eye's PSF at full size: 4096 samples, pictures of 1080p at 60 deg.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "eye/ring_statistics.h"

namespace aureole::eye {
namespace {

View view_1080p() { return View::from_fov(1920, 1080, 60, Projection::kPerspective); }

Eye without_halo_and_streaks() {
    Eye eye;
    eye.halo = 0;
    eye.streaks = 0;
    return eye;
}

double value(const wave::Psf& psf, int x, int y, int c) {
    return static_cast<double>(psf.kernel.at(x, y, c));
}

TEST(EyePsfSlow, AzimuthalMeanFollowsTheScatterModelTo30Deg) {
    const struct {
        double age_years;
        double pupil_mm;
        Pigmentation pigmentation;
    } eyes[] = {{25, 2.5, Pigmentation::kBlue},
                {50, 5, Pigmentation::kBrown},
                {75, 7, Pigmentation::kDarkBrown}};
    const auto grid = wave::KernelGrid::full_reach(view_1080p());
    const View view = grid.view();
    for (const auto model : {ScatterModel::kCie, ScatterModel::kIjspeert}) {
        for (const auto& row : eyes) {
            Eye eye = without_halo_and_streaks();
            eye.scatter = model;
            eye.age_years = row.age_years;
            eye.pupil_diameter_mm = row.pupil_mm;
            eye.pigmentation = row.pigmentation;
            const wave::Psf psf = eye_psf(eye, grid);
            const ScatterPsf scatter(model, row.age_years, row.pigmentation, row.pupil_mm);
            constexpr int kRings = 24;
            const double ratio = std::pow(30 / 0.15, 1.0 / kRings);
            std::vector<double> sums(3 * kRings);
            std::vector<double> counts(kRings);
            for (int y = 0; y < grid.height; ++y) {
                for (int x = 0; x < grid.width; ++x) {
                    const double angle = view.angle_from_axis_deg(x + 0.5, y + 0.5);
                    const int ring =
                        static_cast<int>(std::floor(std::log(angle / 0.15) / std::log(ratio)));
                    if (angle < 0.15 || ring >= kRings) continue;
                    const double expected = scatter.per_sr(angle) * view.pixel_solid_angle_sr(x, y);
                    for (int c = 0; c < 3; ++c) {
                        sums[static_cast<std::size_t>(c * kRings + ring)] +=
                            value(psf, x, y, c) / expected;
                    }
                    ++counts[static_cast<std::size_t>(ring)];
                }
            }
            for (std::size_t i = 0; i < sums.size(); ++i) {
                EXPECT_NEAR(sums[i] / counts[i % kRings], 1, 0.05)
                    << name_of(model) << ", " << row.age_years << " years, " << row.pupil_mm
                    << " mm, channel " << i / kRings << ", ring at "
                    << 0.15 * std::pow(ratio, static_cast<double>(i % kRings)) << " deg";
            }
            for (std::size_t c = 0; c < 3; ++c) {
                double total = psf.off_kernel_energy[c];
                for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                    total += static_cast<double>(psf.kernel.plane(static_cast<int>(c))[i]);
                }
                EXPECT_NEAR(total, 1, 1e-4);
            }
        }
    }
}

// Root mean square difference over the deviation of the texture: .05 / .20 / .25 at 1 / 2 / 3 deg.
TEST(EyePsfSlow, TextureMatches320Wavelengths) {
    const auto grid = wave::KernelGrid::square(view_1080p(), 257);
    const Eye eye = without_halo_and_streaks();
    const wave::Psf psf = eye_psf(eye, grid);
    EyePsfOptions fine;
    fine.spectral.bands = 320;
    const wave::Psf reference = eye_psf(eye, grid, fine);
    Eye plain = eye;
    plain.corona_contrast = 0;
    const wave::Psf smooth = eye_psf(plain, grid);
    const struct {
        double angle_deg;
        double bar;
    } rows[] = {{1, 0.05}, {2, 0.20}, {3, 0.25}};
    for (const auto& row : rows) {
        for (int c = 0; c < 3; ++c) {
            const auto texture = [&](int x, int y) {
                return value(reference, x, y, c) / value(smooth, x, y, c);
            };
            const auto error = [&](int x, int y) {
                return (value(psf, x, y, c) - value(reference, x, y, c)) / value(smooth, x, y, c);
            };
            const double from = row.angle_deg - 0.05;
            const double to = row.angle_deg + 0.05;
            const double deviation = ring_statistics(grid, from, to, texture).deviation;
            const double rms = ring_statistics(grid, from, to, error).deviation;
            EXPECT_GT(deviation, 0.03);
            EXPECT_LT(rms / deviation, row.bar) << row.angle_deg << " deg, channel " << c;
        }
    }
}

// Radius of the brightest ring between 1.8 and 5 deg, relative to the kernel without halo.
double halo_radius_deg(const wave::Psf& psf, int channel) {
    double brightest = 0;
    double radius = 0;
    for (double angle = 1.8; angle < 5; angle += 0.05) {
        const double mean = ring_statistics(psf.grid, angle, angle + 0.1, [&](int x, int y) {
                                return value(psf, x, y, channel);
                            }).mean;
        if (mean > brightest) {
            brightest = mean;
            radius = angle + 0.05;
        }
    }
    return radius;
}

TEST(EyePsfSlow, HaloIsARingAt3DegBlueInsideRedOutside) {
    const auto grid = wave::KernelGrid::square(view_1080p(), 401);
    Eye eye;
    eye.pupil_diameter_mm = 6;
    EyePsfOptions mono;
    mono.spectral.single_wavelength_nm = 568;
    const wave::Psf halo_568 = eye_component(Component::kHalo, eye, grid, mono);
    const double at_568 = halo_radius_deg(halo_568, 1);
    EXPECT_GE(at_568, 3.0);
    EXPECT_LE(at_568, 3.3);
    // Nothing of it lies where the scatter model holds all light already.
    const auto mean_568 = [&](double from_deg, double to_deg) {
        return ring_statistics(grid, from_deg, to_deg,
                               [&](int x, int y) { return value(halo_568, x, y, 1); })
            .mean;
    };
    EXPECT_LT(std::abs(mean_568(0, 1.35)), 1e-6 * mean_568(3.1, 3.3));
    const wave::Psf colours = eye_component(Component::kHalo, eye, grid);
    EXPECT_LT(halo_radius_deg(colours, 2) + 0.2, halo_radius_deg(colours, 1));
    EXPECT_LT(halo_radius_deg(colours, 1) + 0.2, halo_radius_deg(colours, 0));

    // In the whole PSF: a bump on the falling veil at 6 mm, nothing at 3 mm.
    const auto bump = [&](double pupil_mm) {
        Eye with;
        with.pupil_diameter_mm = pupil_mm;
        with.streaks = 0;
        Eye without = with;
        without.halo = 0;
        const wave::Psf a = eye_psf(with, grid, mono);
        const wave::Psf b = eye_psf(without, grid, mono);
        return ring_statistics(grid, 3.1, 3.3,
                               [&](int x, int y) { return value(a, x, y, 1) / value(b, x, y, 1); })
            .mean;
    };
    EXPECT_GT(bump(6), 1.3);
    EXPECT_NEAR(bump(3), 1, 1e-6);
}

// Normalised over the band, not over the kernel: nearly all, and never more, lies within 7 deg.
TEST(EyePsfSlow, ComponentsHoldTheirEnergyWithinTheirBand) {
    const auto grid = wave::KernelGrid::square(view_1080p(), 401);
    Eye eye;
    eye.pupil_diameter_mm = 6;
    for (const auto component : {Component::kBloom, Component::kHalo, Component::kStreaks}) {
        const wave::Psf psf = eye_component(component, eye, grid);
        for (const double off : psf.off_kernel_energy) {
            EXPECT_GT(off, -1e-5);  // the boxes of add_spectral() tile the band to a few 1e-6
            EXPECT_LT(off, 0.05);
        }
    }
}

// Energy in streaks lies close to the horizontal, across the lashes.
TEST(EyePsfSlow, StreaksLieAcrossTheLashes) {
    const auto grid = wave::KernelGrid::square(view_1080p(), 257);
    const wave::Psf streaks = eye_component(Component::kStreaks, {}, grid);
    double across = 0;
    double along = 0;
    for (int y = 0; y < 257; ++y) {
        for (int x = 0; x < 257; ++x) {
            const double dx = x - 128;
            const double dy = y - 128;
            if (std::hypot(dx, dy) < 20) continue;
            (std::abs(dy) < std::abs(dx) ? across : along) += value(streaks, x, y, 1);
        }
    }
    EXPECT_GT(across, 10 * along);
}

// All light beside the source, whatever the colours of its rings and rays.
TEST(EyePsfSlow, WholeGlareIsWhite) {
    for (const double pupil_mm : {3.0, 7.0}) {
        Eye eye;
        eye.pupil_diameter_mm = pupil_mm;
        eye.corona_contrast = 4;
        const wave::Psf psf = eye_psf(eye, wave::KernelGrid::square(view_1080p(), 1025));
        color::Rgb glare = {};
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < 1025; ++y) {
                for (int x = 0; x < 1025; ++x) {
                    if (x == 512 && y == 512) continue;
                    glare[static_cast<std::size_t>(c)] += value(psf, x, y, c);
                }
            }
        }
        const auto xy = color::chromaticity(glare);
        EXPECT_NEAR(xy[0], 0.3127, 0.002) << pupil_mm;
        EXPECT_NEAR(xy[1], 0.3290, 0.002) << pupil_mm;
    }
}

}  // namespace
}  // namespace aureole::eye
