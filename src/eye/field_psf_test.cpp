// Laws of the streaks over the field of view, on small rasters.
#include "aureole/eye/field_psf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kGrid = {512, 10};

double area_seen(const wave::Mask& pupil, const wave::Mask& lashes) {
    double sum = 0;
    for (std::size_t i = 0; i < pupil.values.size(); ++i) {
        sum += static_cast<double>(pupil.values[i] * lashes.values[i]);
    }
    return sum / wave::area_mm2(pupil) * kGrid.spacing_mm() * kGrid.spacing_mm();
}

double blocked(const Eye& eye, const FieldPosition& field) {
    return area_seen(draw_pupil(eye, kGrid, field), draw_lashes(eye, kGrid, field));
}

// Mean place of what a mask covers.
double mean_mm(const wave::Mask& mask, bool vertical) {
    double sum = 0;
    double moment = 0;
    for (int j = 0; j < kGrid.samples; ++j) {
        for (int i = 0; i < kGrid.samples; ++i) {
            const auto value = static_cast<double>(mask.row(j)[i]);
            sum += value;
            moment += value * (vertical ? kGrid.y_mm(j) : kGrid.x_mm(i));
        }
    }
    return moment / sum;
}

TEST(Field, ForeshortensThePupil) {
    Eye eye;
    const double area = wave::area_mm2(draw_pupil(eye, kGrid));
    for (const FieldPosition field : {FieldPosition{40, 0}, {0, -25}, {20, 10}}) {
        const double slope =
            std::hypot(std::tan(rad_from_deg(field.x_deg)), std::tan(rad_from_deg(field.y_deg)));
        EXPECT_NEAR(wave::area_mm2(draw_pupil(eye, kGrid, field)) / area,
                    std::cos(std::atan(slope)), 1e-4);
    }
}

TEST(Field, MovesTheLidAgainstTheLight) {
    // Light from above passes 12 mm tan(angle) higher: the lid's edge stands lower in the pupil.
    Eye eye;
    eye.eyelid = 0.3;
    const double level_mm = mean_mm(draw_pupil(eye, kGrid), true);
    EXPECT_LT(mean_mm(draw_pupil(eye, kGrid, {0, 6}), true), level_mm - 0.2);
    EXPECT_GT(mean_mm(draw_pupil(eye, kGrid, {0, -6}), true), level_mm + 0.2);
    // From far above it hides the pupil: no light, and no error.
    EXPECT_EQ(wave::area_mm2(draw_pupil(eye, kGrid, {0, 40})), 0);
    const wave::KernelGrid grid = {33, 33, 0.1, Projection::kPerspective};
    const Image streaks = streaks_at(eye, {0, 40}, grid, {kGrid, {}});
    for (std::size_t i = 0; i < 3 * streaks.pixels(); ++i) ASSERT_EQ(streaks.plane(0)[i], 0);
}

TEST(Field, MovesALashByItsDistance) {
    Eye eye;
    eye.eyelashes = 1;
    eye.anatomy.lashes.angle_sd_deg = 0;  // upright, straight: moved sideways it moves as a whole
    eye.anatomy.lashes.curvature_per_mm = 0;
    eye.pupil_diameter_mm = 9;  // the next lash is 7.6 mm away
    const double from_mm = mean_mm(draw_lashes(eye, kGrid), false);
    for (const double angle_deg : {3.0, 6.0}) {
        const double shift_mm = 12 * std::tan(rad_from_deg(angle_deg));
        EXPECT_NEAR(mean_mm(draw_lashes(eye, kGrid, {angle_deg, 0}), false),
                    (from_mm - shift_mm) * std::cos(rad_from_deg(angle_deg)), 0.01);
    }
    eye.anatomy.lashes.distance_mm = 0;
    EXPECT_NEAR(mean_mm(draw_lashes(eye, kGrid, {6, 0}), false),
                from_mm * std::cos(rad_from_deg(6)), 0.01);
}

TEST(Field, TheRowOfLashesGoesOn) {
    // Mean over people: as much before the pupil at 25 deg to the sides as straight ahead, all of
    // the pupil's height from above, next to nothing from below.
    double ahead = 0;
    double aside = 0;
    double above = 0;
    double below = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        Eye eye;
        eye.seed = seed;
        ahead += blocked(eye, {});
        aside += 0.5 * (blocked(eye, {25, 0}) + blocked(eye, {-25, 0}));
        above += blocked(eye, {0, 25});
        below += blocked(eye, {0, -20});
    }
    EXPECT_NEAR(aside / ahead, 1, 0.2);
    EXPECT_GT(above / ahead, 2);
    EXPECT_LT(below / ahead, 0.1);
}

TEST(Field, NextToTheAxisIsTheEyeOnTheAxis) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Eye eye;
        eye.seed = seed;
        EXPECT_NEAR(blocked(eye, {0.001, 0}), blocked(eye, {}), 2e-5) << seed;
    }
}

FieldPsfOptions small() {
    FieldPsfOptions options;
    options.psf.aperture = kGrid;
    options.spacing_deg = 6;
    options.centre_deg = 0.5;
    return options;
}

// Nodes on the central pixel, and on the corners, whatever the spacing.
View view_of() { return View::from_fov(97, 49, 12, Projection::kPerspective); }

TEST(FieldPsf, OnTheAxisIsTheEyesOwn) {
    Eye eye;
    eye.pupil_diameter_mm = 6;  // with a halo
    const View view = view_of();
    const wave::VaryingPsf varying = eye_field_psf(eye, view, small());
    const wave::Psf here = wave::psf_at(varying, 48, 24);
    const wave::Psf own = eye_psf(eye, wave::KernelGrid::full_reach(view), small().psf);
    double difference = 0;
    for (std::size_t i = 0; i < 3 * own.kernel.pixels(); ++i) {
        difference +=
            std::abs(static_cast<double>(here.kernel.plane(0)[i] - own.kernel.plane(0)[i]));
    }
    // The field's rays come from a blend of corners on this grid, its centre from a node.
    EXPECT_LT(difference / (3 * blocked(eye, {})), 0.05);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(here.off_kernel_energy[c] / own.off_kernel_energy[c], 1, 1e-3);
    }
}

TEST(FieldPsf, HasUnitEnergyEverywhere) {
    const wave::VaryingPsf varying = eye_field_psf(Eye(), view_of(), small());
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(31, 11), std::pair(96, 48)}) {
        const wave::Psf psf = wave::psf_at(varying, x, y);
        for (int c = 0; c < 3; ++c) {
            double sum = psf.off_kernel_energy[static_cast<std::size_t>(c)];
            for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                sum += static_cast<double>(psf.kernel.plane(c)[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-4);
        }
    }
}

TEST(FieldPsf, IsExactAtItsNodesAndCloseBetween) {
    const View view = view_of();
    const wave::KernelGrid grid = wave::KernelGrid::square(view, 51);
    const auto error = [&](const wave::VaryingPsf& varying, int x, int y) {
        const Image truth =
            streaks_at(Eye(), field_position(view, x + 0.5, y + 0.5), grid, small().psf);
        const Image blend = fourier::kernel_at(varying.parts, view.width, view.height, x, y);
        double difference = 0;
        double energy = 0;
        for (int c = 0; c < 3; ++c) {
            for (int ky = 0; ky < grid.height; ++ky) {
                for (int kx = 0; kx < grid.width; ++kx) {
                    const int bx = kx + (blend.width() - grid.width) / 2;
                    const int by = ky + (blend.height() - grid.height) / 2;
                    const auto value = static_cast<double>(truth.at(kx, ky, c));
                    difference += std::abs(static_cast<double>(blend.at(bx, by, c)) - value);
                    energy += value;
                }
            }
        }
        return difference / energy;
    };
    const wave::VaryingPsf coarse = eye_field_psf(Eye(), view, small());
    EXPECT_LT(error(coarse, 0, 0), 0.01);
    EXPECT_LT(error(coarse, 96, 0), 0.01);
    FieldPsfOptions options = small();
    options.spacing_deg = 1;
    EXPECT_LT(error(eye_field_psf(Eye(), view, options), 37, 10), 0.5 * error(coarse, 37, 10));
}

TEST(FieldPsf, RaysFadeBeforeTheyEnd) {
    // A cut across rays is an edge in the picture.
    FieldPsfOptions options = small();
    options.reach_deg = 1.2;
    const View view = View::from_fov(193, 97, 12, Projection::kPerspective);
    const wave::VaryingPsf psf = eye_field_psf(Eye(), view, options);
    const fourier::KernelNodes& rays = psf.parts[1];
    const auto level = [&](int column) {
        double sum = 0;
        for (const Image& half : rays.halves) {
            for (int y = 0; y < half.height(); ++y) {
                sum += static_cast<double>(half.at(column, y, 1));
            }
        }
        return sum;
    };
    const int end = rays.reach_x();
    EXPECT_GT(level(2 * end / 3), 0);
    EXPECT_LT(level(end), 1e-3 * level(2 * end / 3));
    EXPECT_LT(level(end - 1), 0.1 * level(2 * end / 3));
}

TEST(FieldPsf, RefusesWhatNoEyeSees) {
    FieldPsfOptions options = small();
    options.spacing_deg = 0;
    EXPECT_THROW(eye_field_psf(Eye(), view_of(), options), InvalidArgument);
    EXPECT_THROW(
        eye_field_psf(Eye(), View::from_fov(97, 49, 170, Projection::kPerspective), small()),
        InvalidArgument);
    EXPECT_THROW(draw_lashes(Eye(), kGrid, {81, 0}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
