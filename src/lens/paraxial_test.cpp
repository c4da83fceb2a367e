// Linear optics, held to the exact tracer near the axis and to what textbooks say of simple lenses.
#include "aureole/lens/paraxial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

// Focal and back focal lengths at the d line that the reference table of lens prescriptions gives,
// computed there by other code.
struct Computed {
    const char* id;
    const char* position;
    double efl_mm;
    double bfd_mm;
};

constexpr Computed kComputed[] = {
    {"heliar", "", 99.236, 81.315},
    {"nikon-28-75", "", 28.900, 39.682},
    {"canon-70-200", "wide", 72.118, 52.446},
    {"canon-70-200", "mid", 134.948, 52.429},
    {"canon-70-200", "tele", 193.910, 52.421},
    {"tessar", "", 99.996, 79.809},
    {"biotar", "", 99.913, 65.329},
    {"ektar", "", 100.355, 82.126},
    {"angenieux-double-gauss", "", 99.940, 55.977},
    {"double-gauss", "", 50.007, 35.722},
    {"fisheye", "", 9.991, 23.161},
    {"cooke-triplet", "", 50.021, 42.436},
    {"nikon-retrofocus", "", 100.059, 130.848},
    {"canon-14", "", 14.279, 36.301},
    {"itoh-zoom", "short", 99.918, 149.458},
    {"itoh-zoom", "long", 145.726, 189.530},
    {"sonnar", "", 49.765, 22.266},
    {"summicron-r", "", 52.016, 37.356},
    {"canon-35-135", "", 36.020, 42.125},
    {"canon-28-80", "", 28.969, 37.724},
    {"biconvex", "", 49.808, 48.064},
};

TEST(ShippedOptics, FocalLengthsOfTheReferenceTable) {
    for (const Computed& expected : kComputed) {
        SCOPED_TRACE(std::string(expected.id) + " " + expected.position);
        const Lens lens(shipped_lens(expected.id), {.position = expected.position});
        const CardinalPoints points = cardinal_points(lens, kLineDNm);
        // The bar is 0.1 %; the table itself is rounded to 0.001 mm, and its Biotar and Nikon to
        // five digits.
        EXPECT_NEAR(points.efl_mm, expected.efl_mm, 1e-3 * expected.efl_mm);
        EXPECT_NEAR(points.bfd_mm, expected.bfd_mm, 1e-3 * expected.bfd_mm);
        EXPECT_DOUBLE_EQ(points.efl_mm, lens.efl_mm());
        EXPECT_NEAR(lens.sensor_z_mm(), lens.faces().back().z_mm + points.bfd_mm, 1e-12);
    }
}

// A ray so near the axis that aberrations, of third order in its height, are below 1e-6 of it.
void compare_with_trace(const Lens& lens, const Bounces& bounces) {
    constexpr double kHeightMm = 1e-5;
    constexpr double kSlope = 1e-7;
    const GhostMatrices linear = ghost_matrices(lens, bounces, kLineDNm);
    const Tracer tracer(lens, kLineDNm);
    for (const bool tilted : {false, true}) {
        // In y the slope comes from a light above; in x from one at the right.
        const double size = tilted ? kSlope : kHeightMm;
        const Ray ray = tilted ? ray_from_light(-kSlope, -kSlope, 0, 0)
                               : ray_from_light(0, 0, kHeightMm, kHeightMm);
        std::vector<Vector> path;
        const TracedRay traced = tracer.trace(bounces, ray, &path);
        ASSERT_EQ(traced.fate, Fate::kArrived);
        const auto expect_near = [&](double exact, const Matrix& m, double scale) {
            const double expected = (tilted ? m.b : m.a) * size;
            EXPECT_NEAR(exact, expected, 1e-5 * std::abs(expected) + 1e-8 * scale);
        };
        ASSERT_EQ(path.size(), linear.crossings.size() + 2);
        double scale = 0;  // the largest height on the way
        for (const Vector& point : path) scale = std::max(scale, std::abs(point[1]));
        for (std::size_t i = 0; i < linear.crossings.size(); ++i) {
            SCOPED_TRACE("crossing " + std::to_string(i));
            expect_near(path[i + 1][0], linear.crossings[i].matrix.x, scale);
            expect_near(path[i + 1][1], linear.crossings[i].matrix.y, scale);
        }
        expect_near(traced.x_mm, linear.to_sensor.x, scale);
        expect_near(traced.y_mm, linear.to_sensor.y, scale);
    }
}

TEST(ShippedOptics, EveryGhostMatchesTheExactTraceNearTheAxis) {
    for (const Computed& expected : kComputed) {
        const Lens lens(shipped_lens(expected.id), {.position = expected.position});
        compare_with_trace(lens, Bounces{});
        for (const Bounces& bounces : enumerate_ghosts(lens, GhostSet::kAll)) {
            SCOPED_TRACE(std::string(expected.id) + " " + expected.position + " (" +
                         std::to_string(bounces.far + 1) + ", " + std::to_string(bounces.near + 1) +
                         ")");
            compare_with_trace(lens, bounces);
            if (HasFailure()) return;
        }
    }
}

// A lens with one of everything: conic, even asphere, both cylinders, cement, a stop in between.
Prescription mixed_lens() {
    return lens_of(
        {
            {.radius_mm = 60, .thickness_mm = 5, .index = 1.6, .conic = -0.7},
            {.radius_mm = -90, .thickness_mm = 2, .index = 1.75},
            {.thickness_mm = 3, .index = 1, .asphere = {1e-5, -2e-8}},
            {.thickness_mm = 2, .stop = true},
            {.radius_mm = 80, .thickness_mm = 4, .index = 1.5, .profile = Profile::kCylinderX},
            {.radius_mm = -120, .thickness_mm = 60, .profile = Profile::kCylinderY},
        },
        8);
}

TEST(Paraxial, CylindersAndAspheresMatchTheExactTrace) {
    const Lens lens(mixed_lens());
    compare_with_trace(lens, Bounces{});
    for (const Bounces& bounces : enumerate_ghosts(lens, GhostSet::kAll)) {
        compare_with_trace(lens, bounces);
    }
    // No power where a cylinder is flat: behind the last row only the x meridian sees row 5.
    const GhostMatrices m = ghost_matrices(lens, Bounces{}, kLineDNm);
    const Matrix x = m.to_sensor.x;
    const Matrix y = m.to_sensor.y;
    EXPECT_GT(std::abs(x.c - y.c), 1e-3);
    // Light ends where it began, in air: nothing but geometry changes the determinant.
    EXPECT_NEAR(x.determinant(), 1, 1e-12);
    EXPECT_NEAR(y.determinant(), 1, 1e-12);
}

// The reference names this ghost of faces 1 and 8, from 0, to tell the conventions apart: mixing an
// unfolded reflection with true inverses gives +2.06. Its sensor is at the printed last gap.
TEST(Paraxial, HeliarGhostOfTheReference) {
    const Lens lens(shipped_lens("heliar"));
    const Matrix to_sensor = ghost_matrices(lens, {8, 1}, kLineDNm).to_sensor.y;
    const double printed_z = lens.faces().back().z_mm + 82.857;
    EXPECT_NEAR((translation(printed_z - lens.sensor_z_mm()) * to_sensor).a, -5.29, 0.005);
    EXPECT_NEAR(to_sensor.determinant(), 1, 1e-12);
}

TEST(Paraxial, LensmakersFormula) {
    const double n = 1.517, r = 50.6, d = 5.2;
    const Lens lens(shipped_lens("biconvex"));
    const CardinalPoints points = cardinal_points(lens, kLineDNm);
    const double f = 1 / ((n - 1) * (2 / r - (n - 1) * d / (n * r * r)));
    EXPECT_NEAR(points.efl_mm, f, 1e-10);
    EXPECT_NEAR(points.bfd_mm, f * (1 - (n - 1) * d / (n * r)), 1e-10);
    // The principal planes of a symmetric lens lie symmetric.
    EXPECT_NEAR(points.front_principal_z_mm - 3, 3 + d - points.rear_principal_z_mm, 1e-10);
    EXPECT_NEAR(points.rear_principal_z_mm + f, lens.sensor_z_mm(), 1e-10);
    // Nothing stands before the stop: it is the entrance pupil itself.
    EXPECT_NEAR(points.entrance_pupil_z_mm, 0, 1e-12);
    EXPECT_NEAR(points.entrance_pupil_diameter_mm, 2 * lens.stop_radius_mm(), 1e-12);
    EXPECT_NEAR(points.f_number, f / (2 * lens.stop_radius_mm()), 1e-12);
    // Its image by the lens: the thin lens equation between principal planes.
    const double object = points.front_principal_z_mm;
    const double image = 1 / (1 / f - 1 / object);
    EXPECT_NEAR(points.exit_pupil_z_mm, points.rear_principal_z_mm + image, 1e-9);
    EXPECT_NEAR(points.exit_pupil_diameter_mm,
                std::abs(image / object) * points.entrance_pupil_diameter_mm, 1e-9);
}

TEST(Paraxial, BallLens) {
    // EFL of a ball of radius r: n r / (2 (n - 1)), measured from its centre.
    const double n = 1.6, r = 20;
    const Lens lens(lens_of({{.radius_mm = r, .thickness_mm = r, .index = n},
                             {.thickness_mm = r, .index = n, .stop = true},
                             {.radius_mm = -r}}));
    const CardinalPoints points = cardinal_points(lens, kLineDNm);
    EXPECT_NEAR(points.efl_mm, n * r / (2 * (n - 1)), 1e-11);
    EXPECT_NEAR(points.front_principal_z_mm, r, 1e-11);
    EXPECT_NEAR(points.rear_principal_z_mm, r, 1e-11);
}

TEST(Paraxial, FocalLengthFollowsDispersion) {
    const double r = 50, d = 4;
    const Lens lens(lens_of({{.stop = true},
                             {.radius_mm = r, .thickness_mm = d, .index = 1.5, .abbe = 40},
                             {.radius_mm = -r}}));
    const auto lensmaker = [&](double n) {
        return 1 / ((n - 1) * (2 / r - (n - 1) * d / (n * r * r)));
    };
    for (const double wavelength : {400.0, kLineFNm, kLineDNm, kLineCNm, 750.0}) {
        const CardinalPoints points = cardinal_points(lens, wavelength);
        EXPECT_NEAR(points.efl_mm, lensmaker(lens.index(2, wavelength)), 1e-10);
    }
    // Chromatic aberration of a thin lens is f / V.
    const double spread =
        cardinal_points(lens, kLineCNm).efl_mm - cardinal_points(lens, kLineFNm).efl_mm;
    EXPECT_NEAR(spread, lens.efl_mm() / 40, 0.03 * spread);
}

}  // namespace
}  // namespace aureole::lens
