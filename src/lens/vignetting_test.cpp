// What a lens lets through off its axis, held to geometry and to the law of the cosine.
#include "aureole/lens/vignetting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

double disc(double diameter_mm) { return kPi / 4 * diameter_mm * diameter_mm; }

// On the axis the beam has the diameter f / N that the stop was solved for.
TEST(Vignetting, AreaOnTheAxisIsTheEntrancePupil) {
    for (const char* id : {"heliar", "nikon-28-75", "double-gauss", "fisheye"}) {
        for (const double f_number : {4.0, 8.0, 32.0}) {
            const Lens lens(shipped_lens(id), {.f_number = f_number});
            const double angles[] = {0};
            const FieldPoint axis = field_sweep(lens, angles, kLineDNm)[0];
            const double expected = disc(lens.efl_mm() / f_number);
            // 201 rays across: half a ray's distance at the ends of the rows.
            EXPECT_NEAR(axis.open_area_mm2, expected, 1e-3 * expected) << id << f_number;
            EXPECT_NEAR(axis.image_height_mm, 0, 1e-3);
            EXPECT_EQ(axis.distortion, 0);
            EXPECT_EQ(axis.relative_area, 1);
            EXPECT_EQ(axis.relative_illumination, 1);
            const double straight = Tracer(lens, kLineDNm).throughput({}, {});
            EXPECT_NEAR(axis.transmission, straight, 0.02 * straight);
        }
    }
}

// A small stop right before a weak thin lens sees the cosine of the angle, and a sensor without
// distortion its fourth power.
TEST(Vignetting, CosineToTheFourth) {
    const Lens lens(lens_of({{.semi_aperture_mm = 1, .stop = true},
                             {.radius_mm = 1000,
                              .thickness_mm = 0.01,
                              .index = 1.5,
                              .semi_aperture_mm = 40,
                              .coating = "none"},
                             {.radius_mm = -1000, .semi_aperture_mm = 40, .coating = "none"}},
                            500));
    const double angles[] = {0, 5, 10, 20, 30, 40};
    const auto fields = field_sweep(lens, angles, kLineDNm);
    for (const FieldPoint& field : fields) {
        const double cosine = std::cos(rad_from_deg(field.angle_deg));
        EXPECT_NEAR(field.relative_area, cosine, 2e-4);
        EXPECT_NEAR(field.distortion, 0, 1e-4);
        const double passed = field.transmission / fields[0].transmission;
        EXPECT_NEAR(field.relative_illumination, std::pow(cosine, 4) * passed, 2e-3);
    }
}

// Conservation of energy: between two angles the light of a ring of the sky falls onto a ring of
// the sensor.
TEST(Vignetting, IlluminationIsFluxOverArea) {
    for (const char* id : {"nikon-28-75", "biotar", "fisheye"}) {
        const Lens lens(shipped_lens(id), {.f_number = 8});
        const double step = 0.05;
        const double angles[] = {0, 15 - step, 15, 15 + step};
        const auto fields = field_sweep(lens, angles, 550);
        const double ring = fields[3].image_height_mm * fields[3].image_height_mm -
                            fields[1].image_height_mm * fields[1].image_height_mm;  // over pi
        const double sky =
            2 * (std::cos(rad_from_deg(15 - step)) - std::cos(rad_from_deg(15 + step)));
        const double flux = fields[2].open_area_mm2 * fields[2].transmission * sky / ring;
        const double axis =
            fields[0].open_area_mm2 * fields[0].transmission / (lens.efl_mm() * lens.efl_mm());
        // Centroids of the two beams differ by where their rays happen to end: aberrations times
        // that, over a ring 0.1 degree wide.
        EXPECT_NEAR(fields[2].relative_illumination, flux / axis, 5e-3 * flux / axis) << id;
    }
}

// Two round holes one behind the other: what both let through is the overlap of two discs.
TEST(Vignetting, OverlapOfTwoHoles) {
    const double a = 5, b = 6, distance = 20;
    const Lens lens(
        lens_of({{.thickness_mm = distance, .semi_aperture_mm = a, .stop = true},
                 {.thickness_mm = 1, .semi_aperture_mm = b},
                 {.radius_mm = 3000, .thickness_mm = 1, .index = 1.5, .semi_aperture_mm = 90},
                 {.radius_mm = -3000, .semi_aperture_mm = 90}}));
    const double angles[] = {0, 2, 5, 10, 15, 20, 25, 28};
    for (const FieldPoint& field : field_sweep(lens, angles, 550)) {
        const double d = distance * std::tan(rad_from_deg(field.angle_deg));
        double overlap = disc(2 * a);
        if (d > b - a) {
            const double x = (d * d + a * a - b * b) / (2 * d);  // of the common chord
            const double y = std::sqrt(a * a - x * x);
            overlap = a * a * std::acos(x / a) + b * b * std::acos((d - x) / b) - d * y;
        }
        const double expected = overlap * std::cos(rad_from_deg(field.angle_deg));
        EXPECT_NEAR(field.open_area_mm2, expected, 1e-3 * disc(2 * a)) << field.angle_deg;
    }
    const double outside[] = {29};  // 20 tan 28.8 deg = 11
    EXPECT_EQ(field_sweep(lens, outside, 550)[0].open_area_mm2, 0);
}

TEST(Vignetting, StoppingDownRemovesIt) {
    const double angles[] = {15};
    const auto area = [&](double f_number) {
        const Lens lens(shipped_lens("biotar"), {.f_number = f_number});
        return field_sweep(lens, angles, 550)[0].relative_area;
    };
    EXPECT_LT(area(1.4), 0.7);
    EXPECT_GT(area(8), 0.9);
    EXPECT_LT(area(1.4), area(2));
    EXPECT_LT(area(2), area(2.8));
}

// Stopped down so far that the beam is narrower than the first rays lie apart: the ratio stays.
TEST(Vignetting, NarrowBeamsAreFound) {
    const double angles[] = {7, 13, 21};
    const auto at = [&](double f_number) {
        return field_sweep(Lens(shipped_lens("nikon-28-75"), {.f_number = f_number}), angles, 550);
    };
    const auto wide = at(22);
    const auto narrow = at(350);
    for (std::size_t i = 0; i < std::size(angles); ++i) {
        EXPECT_NEAR(narrow[i].relative_area, wide[i].relative_area, 0.01);
        EXPECT_NEAR(narrow[i].relative_illumination, wide[i].relative_illumination, 0.02);
    }
}

TEST(Vignetting, WhatNoLightReachesIsDark) {
    const Lens lens(shipped_lens("heliar"));
    const double angles[] = {70, 89.9};
    for (const FieldPoint& field : field_sweep(lens, angles, 550)) {
        EXPECT_EQ(field.open_area_mm2, 0);
        EXPECT_EQ(field.relative_area, 0);
        EXPECT_EQ(field.transmission, 0);
        EXPECT_EQ(field.relative_illumination, 0);
        EXPECT_EQ(field.image_height_mm, 0);
    }
}

// The fisheye draws f sin or f theta rather than f tan: barrel distortion, and the light of 70
// degrees still arrives.
TEST(Vignetting, Fisheye) {
    const Lens lens(shipped_lens("fisheye"), {.f_number = 8});
    const double angles[] = {10, 40, 70};
    const auto fields = field_sweep(lens, angles, 550);
    EXPECT_LT(fields[1].distortion, -0.05);
    EXPECT_LT(fields[2].distortion, fields[1].distortion);
    EXPECT_GT(fields[2].relative_illumination, 0.1);
    EXPECT_GT(fields[2].image_height_mm, fields[1].image_height_mm);
}

TEST(Vignetting, MeasuresInThePlaneOfTheAngle) {
    // Cylinders across the width do nothing to light from above.
    const Lens lens(lens_of({{.thickness_mm = 1, .semi_aperture_mm = 2, .stop = true},
                             {.radius_mm = 60,
                              .thickness_mm = 1,
                              .index = 1.5,
                              .semi_aperture_mm = 40,
                              .profile = Profile::kCylinderX},
                             {.radius_mm = -300, .semi_aperture_mm = 40}},
                            20));
    const double angles[] = {5};
    EXPECT_NEAR(field_sweep(lens, angles, kLineDNm)[0].distortion, lens.sensor_z_mm() / 600 - 1,
                0.02);
}

TEST(Vignetting, RefusesAnglesAndCounts) {
    const Lens lens(shipped_lens("biconvex"));
    for (const double angle : {-1.0, 90.0, double(NAN)}) {
        const double angles[] = {0, angle};
        EXPECT_THROW(field_sweep(lens, angles, 550), InvalidArgument);
    }
    const double angles[] = {0};
    EXPECT_THROW(field_sweep(lens, angles, 550, 7), InvalidArgument);
    EXPECT_GT(field_sweep(lens, angles, 550, 8)[0].transmission, 0.9);
    EXPECT_TRUE(field_sweep(lens, {}, 550).empty());
}

}  // namespace
}  // namespace aureole::lens
