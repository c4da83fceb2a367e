// Lights of a real picture.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "aureole/sources/light.h"
#include "radiance_file.h"

namespace aureole::sources {
namespace {

// A sunset over water. The sun is by far the brightest thing, and a light is found where its pixels
// are.
TEST(FindLights, TheSunOfARealPicture) {
    const char* const folder = std::getenv("AUREOLE_TEST_IMAGES");
    if (folder == nullptr) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    const Image picture = read_radiance(std::string(folder) + "/venice_sunset_1k.hdr");
    if (picture.empty()) GTEST_SKIP() << "venice_sunset_1k.hdr is not in AUREOLE_TEST_IMAGES";
    const View view =
        View::from_fov(picture.width(), picture.height(), 60, Projection::kPerspective);
    float brightest = 0;
    int sun_x = 0;
    int sun_y = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (picture.at(x, y, 1) <= brightest) continue;
            brightest = picture.at(x, y, 1);
            sun_x = x;
            sun_y = y;
        }
    }
    const FoundLights found = find_lights(picture, view);
    ASSERT_FALSE(found.lights.empty());
    const PixelPosition position = position_in(view, found.lights[0]);
    EXPECT_NEAR(position.x, sun_x, 5);
    EXPECT_NEAR(position.y, sun_y, 5);
    // A sunset: more red than blue.
    EXPECT_GT(found.lights[0].radiance[0], found.lights[0].radiance[2]);
}

}  // namespace
}  // namespace aureole::sources
