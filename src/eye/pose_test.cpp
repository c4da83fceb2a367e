// What moves in a drawn eye, and what does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kGrid = {1024, 10};

bool same(const Buffer& a, const Buffer& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

wave::Mask particles(const Eye& eye, ParticleLayer layer, const FieldPosition& field = {}) {
    wave::Mask mask(kGrid);
    add_particles(eye, layer, mask, field);
    return mask;
}

// Five discs of 30 um in the whole layer, so that each can be found again.
Eye sparse() {
    Eye eye;
    eye.anatomy.vitreous = {2, 30, 30};
    eye.anatomy.lens_small = {1, 30, 30};
    eye.anatomy.lens_large.count = 0;
    eye.anatomy.cornea = {1, 30, 30};
    return eye;
}

wave::Point centroid(const wave::Mask& mask) {
    double sum = 0;
    double x = 0;
    double y = 0;
    for (int j = 0; j < mask.grid.samples; ++j) {
        for (int i = 0; i < mask.grid.samples; ++i) {
            const auto value = static_cast<double>(mask.row(j)[i]);
            sum += value;
            x += value * mask.grid.x_mm(i);
            y += value * mask.grid.y_mm(j);
        }
    }
    return {x / sum, y / sum};
}

TEST(Pose, MovesLensAndVitreousButNotTheCornea) {
    const Eye rest;
    Eye moved = rest;
    moved.pose.lens_scale = 0.997;
    moved.pose.vitreous_yaw_deg = 2;
    EXPECT_FALSE(same(particles(rest, ParticleLayer::kLens).values,
                      particles(moved, ParticleLayer::kLens).values));
    EXPECT_FALSE(same(particles(rest, ParticleLayer::kVitreous).values,
                      particles(moved, ParticleLayer::kVitreous).values));
    EXPECT_TRUE(same(particles(rest, ParticleLayer::kCornea).values,
                     particles(moved, ParticleLayer::kCornea).values));
    EXPECT_TRUE(same(draw_pupil(rest, kGrid).values, draw_pupil(moved, kGrid).values));
}

TEST(Pose, ScalesTheLensAboutTheAxis) {
    Eye eye = sparse();
    const wave::Point before = centroid(particles(eye, ParticleLayer::kLens));
    eye.pose.lens_scale = 0.95;
    const wave::Point after = centroid(particles(eye, ParticleLayer::kLens));
    EXPECT_NEAR(after.x_mm, 0.95 * before.x_mm, 1e-3);
    EXPECT_NEAR(after.y_mm, 0.95 * before.y_mm, 1e-3);
}

// Depths of 4 and 8 mm, turned about a centre 10.4 mm behind the pupil and seen from 21 mm:
// 6.4 * 21 / 17 = 7.906 and 2.4 * 21 / 13 = 3.877 mm per radian.
TEST(Pose, TurnsTheVitreousInTwoDepths) {
    Eye eye = sparse();
    const wave::Point before = centroid(particles(eye, ParticleLayer::kVitreous));
    eye.pose.vitreous_yaw_deg = 0.5;
    eye.pose.vitreous_pitch_deg = -1;
    const wave::Point after = centroid(particles(eye, ParticleLayer::kVitreous));
    const double mean_mm_per_deg = (7.906 + 3.877) / 2 * std::acos(-1.0) / 180;
    EXPECT_NEAR(after.x_mm - before.x_mm, 0.5 * mean_mm_per_deg, 1e-3);
    EXPECT_NEAR(after.y_mm - before.y_mm, -mean_mm_per_deg, 1e-3);
    eye.pose = {};
    eye.pose.vitreous_roll_deg = 90;
    const wave::Point rolled = centroid(particles(eye, ParticleLayer::kVitreous));
    EXPECT_NEAR(rolled.x_mm, -before.y_mm, 1e-3);
    EXPECT_NEAR(rolled.y_mm, before.x_mm, 1e-3);
}

TEST(Pose, KeepsTheVitreousWhereverItTurns) {
    Eye eye;
    const double area = wave::area_mm2(particles(eye, ParticleLayer::kVitreous));
    for (const double yaw_deg : {-60.0, -3.0, 7.0, 25.0}) {
        eye.pose.vitreous_yaw_deg = yaw_deg;
        const wave::Mask mask = particles(eye, ParticleLayer::kVitreous);
        EXPECT_NEAR(wave::area_mm2(mask) / area, 1, 1e-3);
        // As many on either side: the centroid of a uniform disc stays within .06 mm.
        EXPECT_NEAR(centroid(mask).x_mm, 0, 0.25) << yaw_deg;
        for (int j = 0; j < kGrid.samples; ++j) {
            for (int i = 0; i < kGrid.samples; ++i) {
                if (mask.row(j)[i] == 0) continue;
                ASSERT_LT(std::hypot(kGrid.x_mm(i), kGrid.y_mm(j)), 4.05);
            }
        }
    }
}

TEST(Pose, ScalesTheFibresOfTheLens) {
    Eye eye;
    eye.pupil_diameter_mm = 8;
    eye.pose.lens_scale = 1.1;
    wave::Field field = wave::field_from(draw_pupil(eye, kGrid));
    multiply_gratings(eye, field);
    for (int j = 0; j < kGrid.samples; ++j) {
        for (int i = 0; i < kGrid.samples; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * 1024 + static_cast<std::size_t>(i);
            if (std::hypot(kGrid.x_mm(i), kGrid.y_mm(j)) < 1.96) {
                ASSERT_EQ(field.im[k], 0);
            }
        }
    }
}

TEST(Pose, BentLashesStandOnTheLowerLid) {
    Eye eye;
    eye.anatomy.lashes.angle_sd_deg = 0;
    eye.anatomy.lashes.reach = 0.8;
    eye.anatomy.lashes.reach_sd = 0;
    eye.anatomy.lashes.curvature_per_mm = 0;
    eye.anatomy.lashes.curled_per_mm = 0;
    for (const double closure : {0.15, 0.3, 0.5, 0.7}) {
        eye.eyelid = closure;
        const double upper = 2.5 - 4.5 * closure;
        const double lower = -2.5 + 0.5 * closure;
        const wave::Mask mask = draw_lashes(eye, kGrid);
        double lowest_mm = 99;
        for (int j = 0; j < kGrid.samples && lowest_mm == 99; ++j) {
            const float* row = mask.row(j);
            if (*std::max_element(row, row + kGrid.samples) > 0.05F) lowest_mm = kGrid.y_mm(j);
        }
        EXPECT_NEAR(lowest_mm, std::max(upper - 4, lower), 0.12) << closure;
    }
}

TEST(Pose, BringsLashesDownWithoutTheLid) {
    Eye eye;
    eye.eyelid = 0.4;
    const wave::Mask with_lid = draw_lashes(eye, kGrid);
    eye.eyelid = 0;
    const wave::Mask pupil = draw_pupil(eye, kGrid);
    eye.pose.lash_closure = 0.4;
    EXPECT_TRUE(same(with_lid.values, draw_lashes(eye, kGrid).values));
    EXPECT_TRUE(same(pupil.values, draw_pupil(eye, kGrid).values));
}

// A light that stands aside sees what lies before the pupil moved away from it, and what lies
// behind it moved towards it, by depth times slope; all of it foreshortened.
TEST(Parallax, MovesLayersByTheirDepth) {
    const double angle_deg = 5;
    const double slope = std::tan(rad_from_deg(angle_deg));
    const double cosine = std::cos(rad_from_deg(angle_deg));
    const auto shift_mm = [&](const Eye& eye, ParticleLayer layer) {
        return centroid(particles(eye, layer, {angle_deg, 0})).x_mm / cosine -
               centroid(particles(eye, layer)).x_mm;
    };
    EXPECT_NEAR(shift_mm(sparse(), ParticleLayer::kCornea), -3.05 * slope, 0.005);
    // Two particles, 4 and 8 mm deep, before a retina at 21 mm; rays inside are less oblique.
    const double mean_mm = 0.82 * (4 * 21.0 / 17 + 8 * 21.0 / 13) / 2;
    EXPECT_NEAR(shift_mm(sparse(), ParticleLayer::kVitreous), mean_mm * slope, 0.005);
    const double lens_mm = shift_mm(sparse(), ParticleLayer::kLens) / slope;
    EXPECT_GT(lens_mm, 0);
    EXPECT_LT(lens_mm, 0.82 * 3.6 * 21 / 17.4);
}

TEST(Parallax, KeepsParticlesWithinTheirDisc) {
    const Eye eye;
    for (const ParticleLayer layer :
         {ParticleLayer::kLens, ParticleLayer::kVitreous, ParticleLayer::kCornea}) {
        const wave::Mask seen = particles(eye, layer, {0, 30});
        EXPECT_NEAR(wave::area_mm2(seen), wave::area_mm2(particles(eye, layer)),
                    0.01 * wave::area_mm2(seen));
        for (int j = 0; j < kGrid.samples; ++j) {
            for (int i = 0; i < kGrid.samples; ++i) {
                if (seen.row(j)[i] == 0) continue;
                ASSERT_LT(std::hypot(kGrid.x_mm(i), kGrid.y_mm(j)),
                          eye.anatomy.particle_disc_radius_mm + 0.05);
            }
        }
    }
}

}  // namespace
}  // namespace aureole::eye
