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

}  // namespace
}  // namespace aureole::lens
