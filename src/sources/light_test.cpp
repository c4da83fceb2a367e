#include "aureole/sources/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::sources {
namespace {

const View kWide = View::from_fov(1920, 1080, 60, Projection::kPerspective);
const View kPanorama = View::from_fov(2000, 1000, 360, Projection::kConstantPitch);
constexpr std::array<float, 3> kWhite = {1, 1, 1};

TEST(LightAt, OnTheAxisLooksAlongIt) {
    const Light light = light_at(kWide, 960, 540, {2, 3, 4});
    EXPECT_EQ(light.tan_x, 0);
    EXPECT_EQ(light.tan_y, 0);
    EXPECT_EQ(light.radiance, (std::array<float, 3>{2, 3, 4}));
    const double f = kWide.focal_length_px();
    EXPECT_NEAR(light.solid_angle_sr * f * f, 1, 1e-12);
    EXPECT_EQ(light.moment_xx, 0);
    EXPECT_NEAR(luminous_energy(light),
                light.solid_angle_sr * (0.2126 * 2 + 0.7152 * 3 + 0.0722 * 4), 1e-18);
}

TEST(LightAt, TheEdgeIsHalfTheFieldAway) {
    const Light right = light_at(kWide, 1920, 540, kWhite);
    EXPECT_NEAR(right.tan_x, std::tan(rad_from_deg(30)), 1e-12);
    const Light above = light_at(kWide, 960, 0, kWhite);
    EXPECT_NEAR(above.tan_y, std::tan(rad_from_deg(30)) * 1080 / 1920, 1e-12);
}

// A panorama's pixels are angles: 45 deg are an eighth of its width.
TEST(LightAt, ConstantPitchMeasuresAngles) {
    const Light right = light_at(kPanorama, 1000 + 250, 500, kWhite);
    EXPECT_NEAR(right.tan_x, 1, 1e-12);
    const Light corner = light_at(kPanorama, 1000 + 250, 500 - 250, kWhite);
    EXPECT_NEAR(deg_from_rad(std::atan(std::hypot(corner.tan_x, corner.tan_y))),
                45 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(corner.tan_x, corner.tan_y, 1e-12);
}

TEST(LightAt, MayLieOutsideThePicture) {
    const Light light = light_at(kWide, -500, 2000.25, kWhite);
    EXPECT_LT(light.tan_x, -std::tan(rad_from_deg(30)));
    const PixelPosition position = position_in(kWide, light);
    EXPECT_NEAR(position.x, -500, 1e-9);
    EXPECT_NEAR(position.y, 2000.25, 1e-9);
}

TEST(PositionIn, UndoesLightAt) {
    for (const View& view : {kWide, kPanorama}) {
        for (const double dx : {-310.0, 0.5, 240.75}) {
            for (const double dy : {-220.0, 0.25, 300.0}) {
                const double x = view.axis_x + dx;
                const double y = view.axis_y + dy;
                const PixelPosition position = position_in(view, light_at(view, x, y, kWhite));
                EXPECT_NEAR(position.x, x, 1e-9);
                EXPECT_NEAR(position.y, y, 1e-9);
            }
        }
    }
}

// Half a degree: the sun.
TEST(LightAt, DiscHasItsSolidAngleAnywhere) {
    const double radius = rad_from_deg(0.25);
    for (const double x : {960.0, 1900.0, 5000.0}) {
        const Light sun = light_at(kWide, x, 300, kWhite, 0.5);
        EXPECT_NEAR(sun.solid_angle_sr, 2 * kPi * (1 - std::cos(radius)), 1e-15);
    }
    const Light centred = light_at(kWide, 960, 540, kWhite, 0.5);
    // a^2 / 4; the next term of the series is 5 a^2 / 12 of it.
    EXPECT_NEAR(centred.moment_xx / (radius * radius / 4), 1, radius * radius);
    EXPECT_NEAR(centred.moment_yy, centred.moment_xx, 1e-18);
    EXPECT_EQ(centred.moment_xy, 0);
}

// The moments against a sum over points of the cap itself.
TEST(LightAt, DiscHasTheMomentsOfItsPoints) {
    const double diameter_deg = 1;
    for (const double off_axis_deg : {0.0, 40.0}) {
        const Light light = light_in_direction(off_axis_deg, 0, kWhite, diameter_deg, 1e-6);
        double weight = 0, sx = 0, sxx = 0, syy = 0;
        constexpr int kSteps = 400;
        const double turn = rad_from_deg(off_axis_deg);
        for (int i = 0; i < kSteps; ++i) {
            const double theta = rad_from_deg(diameter_deg / 2) * (i + 0.5) / kSteps;
            for (int j = 0; j < kSteps; ++j) {
                const double phi = 2 * kPi * (j + 0.5) / kSteps;
                const double x = std::sin(theta) * std::cos(phi);
                const double y = std::sin(theta) * std::sin(phi);
                const double z = std::cos(theta);
                const double depth = z * std::cos(turn) - x * std::sin(turn);
                const double u = (x * std::cos(turn) + z * std::sin(turn)) / depth;
                const double v = y / depth;
                weight += std::sin(theta);
                sx += std::sin(theta) * u;
                sxx += std::sin(theta) * u * u;
                syy += std::sin(theta) * v * v;
            }
        }
        const double xx = sxx / weight - sx / weight * (sx / weight);
        EXPECT_NEAR(light.moment_xx / xx, 1, 1e-3) << off_axis_deg;
        EXPECT_NEAR(light.moment_yy / (syy / weight), 1, 1e-3) << off_axis_deg;
    }
}

TEST(LightInDirection, AgreesWithThePicture) {
    const Light by_angle = light_in_direction(30, 0, {1, 2, 3}, 0.5, 1e-6);
    const Light by_pixel = light_at(kWide, 1920, 540, {1, 2, 3}, 0.5);
    EXPECT_NEAR(by_angle.tan_x, by_pixel.tan_x, 1e-12);
    EXPECT_NEAR(by_angle.moment_xx, by_pixel.moment_xx, 1e-15);
    EXPECT_EQ(by_angle.solid_angle_sr, by_pixel.solid_angle_sr);
    EXPECT_EQ(light_in_direction(1, 2, kWhite, 0, 3e-7).solid_angle_sr, 3e-7);
}

template <class Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(LightAt, SaysWhatIsWrong) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto has = [](const std::string& text, const char* part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    has(message_of([] { light_in_direction(90, 0, kWhite, 0, 1e-6); }), "behind the camera");
    has(message_of([] { light_in_direction(0, -120, kWhite, 0, 1e-6); }), "-120");
    has(message_of([] { light_at(kPanorama, 10, 500, kWhite); }), "behind the camera");
    has(message_of([] { light_at(kWide, 1, 1, {1, -2, 1}); }), "-2");
    has(message_of([&] { light_at(kWide, 1, 1, {nan, 1, 1}); }), "radiance");
    has(message_of([] { light_at(kWide, 1, 1, kWhite, 90); }), "90");
    has(message_of([] { light_at(kWide, 1, 1, kWhite, -1); }), "diameter");
    has(message_of([&] { light_at(kWide, nan, 1, kWhite); }), "finite");
    has(message_of([] { light_in_direction(0, 0, kWhite, 0, 0); }), "solid angle");
}

}  // namespace
}  // namespace aureole::sources
