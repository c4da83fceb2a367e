// The drawn layers of an eye: areas, independence, the moving lid.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kGrid = {1024, 10};

bool same(const Buffer& a, const Buffer& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

wave::Mask particles(const Eye& eye, ParticleLayer layer) {
    wave::Mask mask(kGrid);
    add_particles(eye, layer, mask);
    return mask;
}

// Mean of pi r^2 over a log-uniform radius.
double expected_area_mm2(const Particles& p) {
    const double low = mm_from_um(p.min_radius_um);
    const double high = mm_from_um(p.max_radius_um);
    return p.count * kPi * (high * high - low * low) / (2 * std::log(high / low));
}

TEST(Pupil, HasTheAreaOfItsDiameter) {
    for (const double diameter_mm : {2.0, 4.5, 8.0}) {
        Eye eye;
        eye.pupil_diameter_mm = diameter_mm;
        const double disc = kPi * diameter_mm * diameter_mm / 4;
        EXPECT_NEAR(wave::area_mm2(draw_pupil(eye, kGrid)) / disc, 1, 1e-3);
    }
}

TEST(Pupil, IsNotQuiteRound) {
    Eye eye;
    const wave::Mask irregular = draw_pupil(eye, kGrid);
    eye.seed = 2;
    EXPECT_FALSE(same(irregular.values, draw_pupil(eye, kGrid).values));
    eye.anatomy.pupil_irregularity = 0;
    const wave::Mask round = draw_pupil(eye, kGrid);
    for (int j = 1; j < kGrid.samples; ++j) {
        for (int i = 1; i < kGrid.samples; ++i) {
            ASSERT_NEAR(round.row(j)[i], round.row(kGrid.samples - j)[kGrid.samples - i], 1e-4);
        }
    }
}

TEST(Eyelid, DescendsFromAboveUntilNothingIsOpen) {
    Eye eye;
    double wider = wave::area_mm2(draw_pupil(eye, kGrid));
    const double full = wider;
    for (const double closure : {0.1, 0.3, 0.5, 0.8, 0.95}) {
        eye.eyelid = closure;
        const wave::Mask pupil = draw_pupil(eye, kGrid);
        const double area = wave::area_mm2(pupil);
        EXPECT_LT(area, wider) << closure;
        EXPECT_GT(area, 0) << closure;
        wider = area;
        // y points up: both lids on the vertical through the centre.
        const auto open_at = [&](double y_mm) {
            const int row =
                kGrid.samples / 2 + static_cast<int>(std::lround(y_mm / kGrid.spacing_mm()));
            return pupil.row(row)[kGrid.samples / 2];
        };
        const double upper_mm = 2.5 - 5 * 0.9 * closure;
        const double lower_mm = -2.5 + 5 * 0.1 * closure;
        EXPECT_EQ(open_at(upper_mm + 0.05), 0) << closure;
        EXPECT_EQ(open_at(lower_mm - 0.05), 0) << closure;
        EXPECT_EQ(open_at((upper_mm + lower_mm) / 2), 1) << closure;
    }
    eye.eyelid = 0.5;
    // The disc below y = .25 mm is .563 of it; the lids' curvature takes .022 of that, the lower
    // lid .021.
    EXPECT_NEAR(wave::area_mm2(draw_pupil(eye, kGrid)) / full, 0.520, 0.005);
    eye.eyelid = 1;
    EXPECT_THROW(draw_pupil(eye, kGrid), InvalidArgument);
}

TEST(Particles, CoverTheAreaOfTheirDistribution) {
    Eye eye;
    const double lens = wave::area_mm2(particles(eye, ParticleLayer::kLens));
    EXPECT_NEAR(lens / (expected_area_mm2(eye.anatomy.lens_small) +
                        expected_area_mm2(eye.anatomy.lens_large)),
                1, 0.06);
    EXPECT_NEAR(wave::area_mm2(particles(eye, ParticleLayer::kVitreous)) /
                    expected_area_mm2(eye.anatomy.vitreous),
                1, 0.06);
    EXPECT_NEAR(wave::area_mm2(particles(eye, ParticleLayer::kCornea)) /
                    expected_area_mm2(eye.anatomy.cornea),
                1, 0.25);
}

TEST(Particles, StayWithinTheirDisc) {
    Eye eye;
    eye.anatomy.particle_disc_radius_mm = 2;
    const wave::Mask mask = particles(eye, ParticleLayer::kLens);
    for (int j = 0; j < kGrid.samples; ++j) {
        for (int i = 0; i < kGrid.samples; ++i) {
            if (mask.row(j)[i] == 0) continue;
            ASSERT_LT(std::hypot(kGrid.x_mm(i), kGrid.y_mm(j)), 2.05);
        }
    }
}

TEST(Layers, DependOnTheirOwnStreamOnly) {
    Eye eye;
    const wave::Mask vitreous = particles(eye, ParticleLayer::kVitreous);
    const wave::Mask lashes = draw_lashes(eye, kGrid);
    Eye other = eye;
    other.anatomy.lens_large.count = 10;
    other.anatomy.cornea.count = 0;
    other.eyelid = 0.01;
    EXPECT_TRUE(same(vitreous.values, particles(other, ParticleLayer::kVitreous).values));
    other.eyelid = 0;
    EXPECT_TRUE(same(lashes.values, draw_lashes(other, kGrid).values));
    other.seed = 99;
    EXPECT_FALSE(same(vitreous.values, particles(other, ParticleLayer::kVitreous).values));
    EXPECT_FALSE(same(lashes.values, draw_lashes(other, kGrid).values));
}

// The shares of the pupil that default lashes cover: .055 / .040 / .035 / .031 at 3 / 5 / 6 / 7 mm.
TEST(Lashes, CoverTheSharesTheyWereCalibratedFor) {
    const struct {
        double pupil_mm;
        double share;
    } expected[] = {{3, 0.055}, {5, 0.040}, {6, 0.035}, {7, 0.031}};
    constexpr wave::ApertureGrid coarse = {256, 10};
    for (const auto& row : expected) {
        double sum = 0;
        const int seeds = 24;
        for (int seed = 0; seed < seeds; ++seed) {
            Eye eye;
            eye.seed = static_cast<std::uint64_t>(seed);
            eye.pupil_diameter_mm = row.pupil_mm;
            const wave::Mask pupil = draw_pupil(eye, coarse);
            wave::Mask lashes = draw_lashes(eye, coarse);
            for (std::size_t i = 0; i < coarse.size(); ++i) lashes.values[i] *= pupil.values[i];
            sum += wave::area_mm2(lashes) / wave::area_mm2(pupil);
        }
        EXPECT_NEAR(sum / seeds / row.share, 1, 0.3) << row.pupil_mm << " mm";
    }
}

TEST(Lashes, MoveDownWithTheLid) {
    Eye eye;
    eye.pupil_diameter_mm = 5;
    const auto blocked = [&](double closure) {
        eye.eyelid = closure;
        const wave::Mask pupil = draw_pupil(eye, kGrid);
        wave::Mask lashes = draw_lashes(eye, kGrid);
        for (std::size_t i = 0; i < kGrid.size(); ++i) lashes.values[i] *= pupil.values[i];
        return wave::area_mm2(lashes) / wave::area_mm2(pupil);
    };
    eye.anatomy.lashes.curled_per_mm = 0;
    EXPECT_GT(blocked(0.4), 1.15 * blocked(0));
}

TEST(Gratings, DelayLightOutsideTheInnerRadiusOnly) {
    Eye eye;
    eye.pupil_diameter_mm = 8;
    constexpr wave::ApertureGrid fine = {4096, 10};
    const wave::Mask pupil = draw_pupil(eye, fine);
    wave::Field field = wave::field_from(pupil);
    multiply_gratings(eye, field);
    double square = 0;
    double count = 0;
    for (int j = 0; j < fine.samples; j += 3) {
        for (int i = 0; i < fine.samples; i += 3) {
            const std::size_t k = static_cast<std::size_t>(j) * 4096 + static_cast<std::size_t>(i);
            const double r = std::hypot(fine.x_mm(i), fine.y_mm(j));
            if (r < 1.79) {
                ASSERT_EQ(field.re[k], 1);
                ASSERT_EQ(field.im[k], 0);
            } else if (r > 3.3 && r < 3.9) {
                square += std::pow(std::atan2(field.im[k], field.re[k]), 2);
                ++count;
            }
        }
    }
    // A sine of amplitude .175, averaged over samples of a fifth of its period.
    EXPECT_NEAR(std::sqrt(square / count), 0.175 / std::sqrt(2), 0.01);
}

TEST(Gratings, SayWhenTheRasterDoesNotResolveThem) {
    Eye eye;
    EXPECT_EQ(grating_resolution_note(eye, {4096, 10}), "");
    EXPECT_NE(grating_resolution_note(eye, {2048, 10}), "");
    eye.anatomy.gratings.fibres = 200;
    EXPECT_EQ(grating_resolution_note(eye, {2048, 10}), "");
}

TEST(Eye, RefusesAbsurdValues) {
    const auto refuses = [](auto change) {
        Eye eye;
        change(eye);
        EXPECT_THROW(check(eye), InvalidArgument);
    };
    EXPECT_NO_THROW(check(Eye{}));
    refuses([](Eye& e) { e.pupil_diameter_mm = 0; });
    refuses([](Eye& e) { e.pupil_diameter_mm = std::nan(""); });
    refuses([](Eye& e) { e.pupil_diameter_mm = 9.5; });
    refuses([](Eye& e) { e.age_years = -3; });
    refuses([](Eye& e) { e.age_years = 300; });
    refuses([](Eye& e) { e.eyelid = 1; });
    refuses([](Eye& e) { e.eyelid = -0.1; });
    refuses([](Eye& e) { e.eyelashes = -1; });
    refuses([](Eye& e) { e.corona_contrast = -1; });
    refuses([](Eye& e) { e.halo = -1; });
    refuses([](Eye& e) { e.streaks = 1e6; });
    refuses([](Eye& e) { e.anatomy.lens_small.count = -1; });
    refuses([](Eye& e) { e.anatomy.cornea = {10, 30, 20}; });
    refuses([](Eye& e) { e.anatomy.gratings.fibres = 0; });
    refuses([](Eye& e) { e.anatomy.gratings.full_radius_mm = 1; });
}

TEST(Look, VividFollowsTheLogarithmOfTheField) {
    Eye eye;
    apply_look(eye, Look::kVivid, 60);
    EXPECT_NEAR(eye.corona_contrast, 4, 1e-12);
    EXPECT_EQ(eye.streaks, 1.5);
    EXPECT_EQ(eye.halo, 1);
    apply_look(eye, Look::kVivid, 20);
    EXPECT_NEAR(eye.corona_contrast, 2.5, 1e-12);
    apply_look(eye, Look::kVivid, std::sqrt(20.0 * 60.0));
    EXPECT_NEAR(eye.corona_contrast, 3.25, 1e-12);
    apply_look(eye, Look::kVivid, 120);
    EXPECT_NEAR(eye.corona_contrast, 4, 1e-12);
    apply_look(eye, Look::kPhysical, 60);
    EXPECT_EQ(eye.corona_contrast, 1);
    EXPECT_EQ(eye.streaks, 1);
    EXPECT_EQ(look_from_name("vivid"), Look::kVivid);
    EXPECT_THROW(look_from_name("nice"), InvalidArgument);
    EXPECT_THROW(apply_look(eye, Look::kVivid, 0), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
