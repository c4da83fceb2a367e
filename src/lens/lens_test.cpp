// A prescription made ready for light: stop, sensor, focus, coatings, and what is refused.
#include "aureole/lens/lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/trace.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Prescription singlet(double f_number = 4) {
    return lens_of({{.thickness_mm = 1, .stop = true},
                    {.radius_mm = 50, .thickness_mm = 4, .index = 1.5, .abbe = 60},
                    {.radius_mm = -50, .thickness_mm = 45}},
                   f_number);
}

// The blog: "for the Nikon lens we found D ~ 10 mm", that is 28 mm / 2.8, and the
// stop "~22 mm diameter". The table's own focal length is 28.9 mm.
TEST(Lens, StopOfTheBlog) {
    const Lens lens(shipped_lens("nikon-28-75"), {.f_number = 2.8});
    EXPECT_NEAR(2 * lens.stop_radius_mm(), 22, 0.7);
    EXPECT_NEAR(lens.efl_mm() / lens.f_number(), 10, 0.4);
    // With the nominal focal length, as the document has it.
    const Lens nominal(shipped_lens("nikon-28-75"), {.f_number = lens.efl_mm() / 10});
    EXPECT_NEAR(2 * nominal.stop_radius_mm(), 22, 0.2);
    // The printed stop of 9 mm is that of f/3.44.
    EXPECT_THAT(lens.warnings(), Contains(HasSubstr("surface 15: the stop's radius for f/2.8")));
}

TEST(Lens, MarginalRayMeetsTheStopsEdge) {
    for (const char* id : {"heliar", "nikon-28-75", "biotar", "fisheye", "cooke-triplet"}) {
        for (const double f_number : {2.8, 8.0, 22.0}) {
            const Lens lens(shipped_lens(id), {.f_number = f_number});
            const double height = lens.efl_mm() / (2 * f_number);
            const TracedRay ray = Tracer(lens, kLineDNm).trace({}, ray_from_light(0, 0, 0, height));
            EXPECT_NEAR(ray.stop_clip, 1, 1e-12) << id << " f/" << f_number;
            EXPECT_EQ(lens.f_number(), f_number);
        }
    }
}

TEST(Lens, FNumberFromThePrintedStop) {
    Prescription table = shipped_lens("nikon-28-75");
    table.f_number = 0;
    const Lens printed(table);
    EXPECT_EQ(printed.stop_radius_mm(), 9);
    // And back again; spherical aberration of the pupil has either sign.
    for (const ShippedLens& shipped : shipped_lenses()) {
        Prescription any = shipped_lens(shipped.id);
        any.f_number = 0;
        for (Position& position : any.positions) position.f_number = 0;
        const Lens found(any);
        const double radius = found.stop_radius_mm();
        EXPECT_EQ(radius, any.surfaces[static_cast<std::size_t>(found.stop())].semi_aperture_mm);
        EXPECT_NEAR(Lens(any, {.f_number = found.f_number()}).stop_radius_mm(), radius, 1e-9)
            << shipped.id;
    }
    // It does not depend on what is stated or asked for.
    const Lens slow(shipped_lens("nikon-28-75"), {.f_number = 11});
    EXPECT_NEAR(printed_f_number(slow).value(), printed.f_number(), 1e-9);
    EXPECT_NEAR(paraxial_printed_f_number(slow), cardinal_points(printed, kLineDNm).f_number, 1e-9);
    // A stop so wide that rays at its edge meet no glass has a paraxial one only.
    Prescription wide = table;
    wide.surfaces[static_cast<std::size_t>(printed.stop())].semi_aperture_mm = 90;
    EXPECT_FALSE(printed_f_number(Lens(wide, {.f_number = 8})).has_value());
    EXPECT_NEAR(paraxial_printed_f_number(Lens(wide, {.f_number = 8})),
                0.1 * cardinal_points(printed, kLineDNm).f_number, 1e-9);
    // A table that states one is believed, and the user more.
    EXPECT_EQ(Lens(shipped_lens("nikon-28-75")).f_number(), 2.8);
    EXPECT_EQ(Lens(shipped_lens("nikon-28-75"), {.f_number = 11}).f_number(), 11);
    // A printed stop that nothing narrows: f / 2 radius, and all of it.
    Prescription front = singlet(0);
    const Lens stopped(front);
    EXPECT_NEAR(stopped.f_number(), stopped.efl_mm() / 20, 1e-12);
}

TEST(Lens, SemiApertureIsClippedToTheRadius) {
    Prescription table = singlet();
    table.surfaces[1].semi_aperture_mm = 60;
    const Lens lens(table);
    EXPECT_EQ(lens.faces()[1].semi_aperture_mm, 50);
    EXPECT_THAT(lens.warnings(), Contains(HasSubstr("surface 2: semi-aperture 60 mm clipped")));
    // An ellipsoid ends at |R| / sqrt(1 + conic), a paraboloid never.
    table.surfaces[1].conic = 3;
    EXPECT_EQ(Lens(table).faces()[1].semi_aperture_mm, 25);
    table.surfaces[1].conic = -1;
    EXPECT_EQ(Lens(table).faces()[1].semi_aperture_mm, 60);
    EXPECT_THAT(Lens(table).warnings(), IsEmpty());
}

// What stands at the focus distance is imaged onto the sensor, by matrices and by an exact ray.
TEST(Lens, FocusDistance) {
    for (const char* id : {"heliar", "nikon-28-75", "biconvex", "fisheye"}) {
        const Lens far(shipped_lens(id), {.f_number = 8});
        for (const double distance_m : {1.0, 3.0, 50.0}) {
            const Lens lens(shipped_lens(id), {.f_number = 8, .focus_distance_m = distance_m});
            const double object_z = lens.sensor_z_mm() - 1000 * distance_m;
            const Matrix m = ghost_matrices(lens, {}, kLineDNm).to_sensor.y;
            EXPECT_NEAR(m.b - m.a * object_z, 0, 1e-8) << id;
            EXPECT_GT(lens.sensor_z_mm(), far.sensor_z_mm());
            // So narrow a beam that aberrations are below 1e-8 of its width at the lens.
            const double width_mm = 1e-4;
            const double slope = width_mm / (1000 * distance_m);
            const Ray ray{{0, 0, object_z}, {0, slope, std::sqrt(1 - slope * slope)}};
            EXPECT_NEAR(Tracer(lens, kLineDNm).trace({}, ray).y_mm, 0, 1e-7 * width_mm) << id;
            // The stop stays as it is.
            EXPECT_EQ(lens.stop_radius_mm(), far.stop_radius_mm());
        }
        // Newton: the extension is f^2 / (distance to the front focus).
        const Lens lens(shipped_lens(id), {.focus_distance_m = 1000});
        EXPECT_NEAR(lens.sensor_z_mm() - far.sensor_z_mm(), far.efl_mm() * far.efl_mm() / 1e6,
                    1e-3 * far.efl_mm() * far.efl_mm() / 1e6);
    }
}

TEST(Lens, FocusNearerThanLifeSizeIsRefused) {
    // Of a thin lens: 4 f.
    const Lens far(singlet());
    const CardinalPoints points = cardinal_points(far, kLineDNm);
    const double nearest_mm =
        4 * far.efl_mm() + points.rear_principal_z_mm - points.front_principal_z_mm;
    const Lens nearest(singlet(), {.focus_distance_m = nearest_mm / 1000 + 1e-9});
    EXPECT_NEAR(nearest.sensor_z_mm() - far.sensor_z_mm(), far.efl_mm(), 0.1);
    EXPECT_THROW(Lens(singlet(), {.focus_distance_m = nearest_mm / 1000 - 1e-9}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.focus_distance_m = 0.01}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.focus_distance_m = -1}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.focus_distance_m = NAN}), InvalidArgument);
}

TEST(Lens, CoatsWhatTouchesAir) {
    const Lens lens(shipped_lens("heliar"), {.coating = "1.38/90,2.05/130"});
    const std::vector<double> index = lens.indices(kLineDNm);
    for (std::size_t k = 0; k < lens.faces().size(); ++k) {
        const Coating& coating = lens.faces()[k].coating;
        const bool air_before = index[k] == 1;
        const bool air_behind = index[k + 1] == 1;
        ASSERT_EQ(coating.size(), air_before == air_behind ? 0u : 2u) << k;
        if (coating.empty()) continue;
        EXPECT_EQ(coating[air_before ? 0 : 1].index, 1.38);
    }
    Prescription own = singlet();
    own.surfaces[2].coating = "none";
    EXPECT_EQ(Lens(own).faces()[1].coating.size(), 1u);
    EXPECT_TRUE(Lens(own).faces()[2].coating.empty());
    EXPECT_THROW(Lens(singlet(), {.coating = "nano"}), InvalidArgument);
}

TEST(Lens, Indices) {
    Prescription table = singlet();
    const Lens cauchy(table);
    EXPECT_EQ(cauchy.indices(kLineDNm), (std::vector<double>{1, 1, 1.5, 1}));
    EXPECT_NEAR(0.5 / (cauchy.index(2, kLineFNm) - cauchy.index(2, kLineCNm)), 60, 1e-9);
    table.surfaces[1].abbe = 0;
    EXPECT_EQ(Lens(table).index(2, 400), 1.5);
    // A glass of the catalogue keeps its curve and takes the index of the table at d.
    const Glass* bk7 = find_glass("N-BK7");
    ASSERT_NE(bk7, nullptr);
    table.surfaces[1].glass = "N-BK7";
    table.surfaces[1].index = 1.517;
    const Lens melt(table);
    EXPECT_DOUBLE_EQ(melt.index(2, kLineDNm), 1.517);
    EXPECT_NEAR(melt.index(2, 450) - melt.index(2, 650), bk7->index(450) - bk7->index(650), 1e-15);
    EXPECT_THROW(melt.index(2, 60), InvalidArgument);  // between the poles of the curve
    EXPECT_THROW(melt.indices(60), InvalidArgument);
}

TEST(Lens, RefusesWhatIsNoLens) {
    EXPECT_THROW(Lens(singlet(), {.f_number = -1}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.f_number = NAN}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.f_number = HUGE_VAL}), InvalidArgument);
    EXPECT_THROW(Lens(singlet(), {.position = "tele"}), InvalidArgument);
    // The ray at EFL / 2N misses the front of the Biotar, whose radius is 83.6 mm.
    EXPECT_THROW(Lens(shipped_lens("biotar"), {.f_number = 0.5}), InvalidArgument);
    Prescription diverging = singlet();
    diverging.surfaces[1].radius_mm = -50;
    diverging.surfaces[2].radius_mm = 50;
    EXPECT_THROW(Lens{diverging}, InvalidArgument);
    Prescription window = singlet();
    window.surfaces[1].radius_mm = window.surfaces[2].radius_mm = 0;
    EXPECT_THROW(Lens{window}, InvalidArgument);
    Prescription two_stops = singlet();
    two_stops.surfaces[2].stop = true;
    EXPECT_THROW(Lens{two_stops}, InvalidArgument);
}

}  // namespace
}  // namespace aureole::lens
