// Three ways to meter a picture.
#include "aureole/eye/metering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aureole::eye {
namespace {

TEST(Metering, OfAFlatPictureIsItsLuminance) {
    Image picture(40, 30, 3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < picture.pixels(); ++i) picture.plane(c)[i] = 0.25F;
    }
    const View view = View::from_fov(40, 30, 60, Projection::kPerspective);
    const MeteredLuminance metered = meter(picture, view, 80);
    EXPECT_NEAR(metered.mean, 20, 1e-5);
    EXPECT_NEAR(metered.log_mean, 20, 1e-5);
    EXPECT_NEAR(metered.central, 20, 1e-5);
}

TEST(Metering, SeparatesLampsFromTheRoomAndTheCentreFromTheRest) {
    // 20 deg over 200 pixels: a dark disc of 5 deg, 49.6 pixels, in a grey field with one lamp.
    const View view = View::from_fov(200, 200, 20, Projection::kPerspective);
    Image picture(200, 200, 1);
    int dark = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 200; ++x) {
            const bool inside = view.angle_from_axis_deg(x + 0.5, y + 0.5) < kCentralRadiusDeg;
            dark += inside ? 1 : 0;
            picture.at(x, y, 0) = inside ? 0.01F : 1.0F;
        }
    }
    picture.at(3, 4, 0) = 4e6F;
    const MeteredLuminance metered = meter(picture, view, 100);
    EXPECT_NEAR(metered.central, 1, 1e-4);
    EXPECT_NEAR(metered.mean, 100.0 * (4e6 + 40000 - 1 - dark * 0.99) / 40000, 1);
    EXPECT_NEAR(std::log(metered.log_mean),
                std::log(100) + (std::log(4e6) + dark * std::log(0.01)) / 40000, 1e-4);
    EXPECT_DOUBLE_EQ(metered.mean, 100 * mean_luminance(picture));
}

TEST(Metering, TakesNegativeLightAsNoneAndDarknessAsItsFloor) {
    Image picture(2, 1, 1);
    picture.at(0, 0, 0) = -5;
    const View view = View::from_fov(2, 1, 60, Projection::kPerspective);
    const MeteredLuminance metered = meter(picture, view, 100);
    EXPECT_EQ(metered.mean, 0);
    EXPECT_NEAR(metered.log_mean, 1e-6, 1e-12);
    EXPECT_EQ(metered.central, 0);  // pixels of 30 deg: none in the centre
}

}  // namespace
}  // namespace aureole::eye
