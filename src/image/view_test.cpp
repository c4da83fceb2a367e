#include "aureole/image/view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole {
namespace {

// Solid angle of a w x h rectangle at distance d, seen from above its centre.
double rectangle_solid_angle_sr(double w, double h, double d) {
    return 4 * std::atan(w * h / (2 * d * std::sqrt(4 * d * d + w * w + h * h)));
}

double sum_of_solid_angles_sr(const View& view) {
    double sum = 0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) sum += view.pixel_solid_angle_sr(x, y);
    }
    return sum;
}

TEST(View, PixelsOfAPerspectivePictureFillItsSolidAngle) {
    for (const double fov_deg : {5.0, 60.0, 120.0}) {
        for (const auto& [width, height] : {std::pair{640, 360}, std::pair{301, 500}}) {
            const View view = View::from_fov(width, height, fov_deg, Projection::kPerspective);
            const double f = view.focal_length_px();
            const double exact = rectangle_solid_angle_sr(width, height, f);
            // The midpoint error promised by the header.
            EXPECT_NEAR(sum_of_solid_angles_sr(view) / exact, 1, 1 / (4 * f * f)) << fov_deg;
        }
    }
}

TEST(View, CubeFaceIsASixthOfTheSphere) {
    const View view = View::from_fov(256, 256, 90, Projection::kPerspective);
    EXPECT_NEAR(sum_of_solid_angles_sr(view), 4 * kPi / 6, 1e-5);
}

TEST(View, PixelsOfAConstantPitchPictureAreEqual) {
    const View view = View::from_fov(200, 100, 20, Projection::kConstantPitch);
    EXPECT_NEAR(view.pitch_deg, 0.1, 1e-12);
    EXPECT_NEAR(view.pixel_solid_angle_sr(0, 0), std::pow(rad_from_deg(0.1), 2), 1e-15);
    EXPECT_EQ(view.pixel_solid_angle_sr(0, 0), view.pixel_solid_angle_sr(150, 50));
}

TEST(View, FieldOfViewIsRecovered) {
    for (const auto projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        for (const double fov_deg : {0.5, 20.0, 60.0, 170.0}) {
            const View view = View::from_fov(1921, 1080, fov_deg, projection);
            EXPECT_NEAR(view.angle_from_axis_deg(0, view.axis_y), fov_deg / 2, 1e-9);
            EXPECT_NEAR(view.angle_from_axis_deg(1921, view.axis_y), fov_deg / 2, 1e-9);
        }
    }
    EXPECT_NEAR(View::from_fov(8, 8, 300, Projection::kConstantPitch).angle_from_axis_deg(0, 4),
                150, 1e-9);
}

TEST(View, IsSymmetricAboutItsAxis) {
    for (const auto& [width, height] : {std::pair{64, 36}, std::pair{63, 37}}) {
        const View view = View::from_fov(width, height, 90, Projection::kPerspective);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double solid_angle = view.pixel_solid_angle_sr(x, y);
                EXPECT_NEAR(view.pixel_solid_angle_sr(width - 1 - x, y) / solid_angle, 1, 1e-12);
                EXPECT_NEAR(view.pixel_solid_angle_sr(x, height - 1 - y) / solid_angle, 1, 1e-12);
            }
        }
        EXPECT_EQ(view.angle_from_axis_deg(width / 2.0, height / 2.0), 0);
    }
}

// Angles and solid angles are one geometry: around the axis, the solid angle of a pixel is
// d(theta) in radius times sin(theta) d(phi) across.
TEST(View, SolidAnglesFollowFromAngles) {
    const View view = View::from_fov(1000, 10, 100, Projection::kPerspective);
    for (int x = 520; x < 1000; x += 60) {
        const double y = view.axis_y;
        const double radial =
            rad_from_deg(view.angle_from_axis_deg(x + 1, y) - view.angle_from_axis_deg(x, y));
        const double theta = rad_from_deg(view.angle_from_axis_deg(x + 0.5, y));
        const double across = std::sin(theta) / (x + 0.5 - view.axis_x);
        const double at_axis_row = view.pixel_solid_angle_sr(x, 5);  // centre half a pixel below
        EXPECT_NEAR(at_axis_row / (radial * across), 1, 1e-5);
    }
}

TEST(RelativeSolidAngles, AreOneOnTheAxisAndFallAsCosineCubed) {
    const View view = View::from_fov(101, 51, 60, Projection::kPerspective);
    const Image plane = relative_solid_angles(view);
    EXPECT_NEAR(plane.at(50, 25), 1, 1e-6);
    const double cosine = std::cos(rad_from_deg(view.angle_from_axis_deg(100.5, 25.5)));
    EXPECT_NEAR(plane.at(100, 25), cosine * cosine * cosine, 1e-6);
    const Image flat = relative_solid_angles(View::from_fov(8, 4, 60, Projection::kConstantPitch));
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(flat.at(x, 3), 1, 1e-6);
}

TEST(View, RefusesWhatIsNoPicture) {
    const auto make = [](int width, int height, double fov_deg, Projection projection) {
        return View::from_fov(width, height, fov_deg, projection);
    };
    EXPECT_THROW(make(0, 4, 60, Projection::kPerspective), InvalidArgument);
    EXPECT_THROW(make(4, -1, 60, Projection::kPerspective), InvalidArgument);
    EXPECT_THROW(make(4, 4, 0, Projection::kPerspective), InvalidArgument);
    EXPECT_THROW(make(4, 4, 180, Projection::kPerspective), InvalidArgument);
    EXPECT_THROW(make(4, 4, NAN, Projection::kPerspective), InvalidArgument);
    EXPECT_THROW(make(4, 4, 361, Projection::kConstantPitch), InvalidArgument);
    EXPECT_NO_THROW(make(4, 4, 360, Projection::kConstantPitch));
}

}  // namespace
}  // namespace aureole
