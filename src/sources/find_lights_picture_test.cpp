// Lights of a real picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "aureole/sources/light.h"

namespace aureole::sources {
namespace {

// The run-length coded Radiance format (Ward 1991), enough of it for this file.
Image read_radiance(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    while (std::getline(file, line) && !line.empty()) continue;
    std::string axis;
    int height = 0;
    int width = 0;
    file >> axis >> height >> axis >> width;
    file.get();
    Image picture(width, height, 3);
    std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        char marks[4];
        file.read(marks, 4);
        for (int part = 0; part < 4; ++part) {
            std::uint8_t* out = row.data() + part * width;
            for (int x = 0; x < width;) {
                const int count = file.get();
                if (!file) return {};
                if (count > 128) {
                    std::fill_n(out + x, count - 128, static_cast<std::uint8_t>(file.get()));
                    x += count - 128;
                } else {
                    file.read(reinterpret_cast<char*>(out + x), count);
                    x += count;
                }
            }
        }
        for (int x = 0; x < width; ++x) {
            const int exponent = row[static_cast<std::size_t>(3 * width + x)];
            for (int c = 0; c < 3; ++c) {
                const int mantissa = row[static_cast<std::size_t>(c * width + x)];
                picture.at(x, y, c) =
                    exponent == 0 ? 0 : std::ldexp(static_cast<float>(mantissa), exponent - 136);
            }
        }
    }
    return picture;
}

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
