#include "aureole/ibl/environment_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/ibl/lat_long.h"
#include "aureole/ibl/resize.h"

namespace aureole::ibl {
namespace {

void expect_direction(const Direction& d, const Direction& expected) {
    EXPECT_NEAR(d.x, expected.x, 1e-12);
    EXPECT_NEAR(d.y, expected.y, 1e-12);
    EXPECT_NEAR(d.z, expected.z, 1e-12);
}

constexpr Direction kX = {1, 0, 0};
constexpr Direction kY = {0, 1, 0};
constexpr Direction kZ = {0, 0, 1};

TEST(EnvironmentTransform, TurnsAsTheHeaderSays) {
    expect_direction(transformed(kZ, {.yaw_deg = 90}), kX);
    expect_direction(transformed(kY, {.yaw_deg = 90}), kY);
    expect_direction(transformed(kZ, {.pitch_deg = 90}), {0, -1, 0});
    expect_direction(transformed(kX, {.roll_deg = 90}), kY);
    expect_direction(transformed(kX, {.mirror = Mirror::kX}), {-1, 0, 0});
    expect_direction(transformed(kY, {.mirror = Mirror::kX}), kY);
    const double half = std::sqrt(0.5);
    expect_direction(transformed(kZ, {.yaw_deg = -45}), {-half, 0, half});
}

TEST(EnvironmentTransform, MirrorsThenRollsPitchesAndYaws) {
    const EnvironmentTransform all = {
        .mirror = Mirror::kZ, .roll_deg = 20, .pitch_deg = -35, .yaw_deg = 110};
    Random random(1);
    for (int i = 0; i < 10; ++i) {
        const Direction d = {random.normal(), random.normal(), random.normal()};
        Direction step = transformed(d, {.mirror = Mirror::kZ});
        step = transformed(step, {.roll_deg = 20});
        step = transformed(step, {.pitch_deg = -35});
        step = transformed(step, {.yaw_deg = 110});
        expect_direction(transformed(d, all), step);
    }
}

// A sun in a picture is where the transform says afterwards, through both kinds of input.
TEST(EnvironmentTransform, MovesASunToTheDirectionStated) {
    const LatLongPoint sun = {200.5, 70.5};
    Image picture(512, 256, 3);
    picture.at(200, 70, 0) = 1;
    const Direction before = direction_of(sun, 512, 256);
    const CubeMap still = cube_from_lat_long(picture, 64);
    for (const EnvironmentTransform& transform :
         {EnvironmentTransform{.yaw_deg = 90}, EnvironmentTransform{.yaw_deg = 33},
          EnvironmentTransform{.mirror = Mirror::kY, .roll_deg = 70, .pitch_deg = 12}}) {
        for (const CubeMap& map :
             {cube_from_lat_long(picture, 64, transform), transformed(still, 64, transform)}) {
            Direction sum;
            for (int face = 0; face < kFaces; ++face) {
                for (int y = 0; y < 64; ++y) {
                    for (int x = 0; x < 64; ++x) {
                        const Direction d = texel_direction(face, x, y, 64);
                        const double v = map.at(face, x, y, 0);
                        sum = {sum.x + v * d.x, sum.y + v * d.y, sum.z + v * d.z};
                    }
                }
            }
            EXPECT_GT(dot(normalized(sum), transformed(before, transform)), std::cos(0.01));
        }
    }
}

template <class Environment>
void expect_clean(const Environment& make) {
    EnvironmentReport report;
    const CubeMap map = make(report);
    EXPECT_EQ(report.nonfinite_texels, 2U);
    for (std::size_t i = 0; i < 3 * map.stacked().pixels(); ++i) {
        EXPECT_TRUE(std::isfinite(map.stacked().plane(0)[i]));
    }
}

TEST(EnvironmentTransform, ReplacesAndCountsWhatIsNotFinite) {
    Image picture(32, 16, 3);
    picture.at(3, 5, 0) = std::numeric_limits<float>::infinity();
    picture.at(3, 5, 1) = std::numeric_limits<float>::quiet_NaN();
    picture.at(31, 15, 2) = std::numeric_limits<float>::quiet_NaN();
    expect_clean(
        [&](EnvironmentReport& report) { return cube_from_lat_long(picture, 8, {}, &report); });
    CubeMap cube(4);
    cube.at(2, 1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    cube.at(5, 3, 0, 2) = -std::numeric_limits<float>::infinity();
    expect_clean([&](EnvironmentReport& report) { return transformed(cube, 4, {}, &report); });
}

TEST(EnvironmentTransform, ExposureIsAFactor) {
    CubeMap cube(2);
    cube.at(1, 0, 1, 2) = 3;
    EXPECT_EQ(transformed(cube, 2, {.exposure_ev = 3}).at(1, 0, 1, 2), 24);
    cube.at(1, 0, 1, 2) = 1e30F;
    EXPECT_EQ(transformed(cube, 2, {.exposure_ev = 60}).at(1, 0, 1, 2),
              std::numeric_limits<float>::max());
}

TEST(EnvironmentTransform, ClampKeepsHueAndReportsWhatItTook) {
    Image picture(64, 32, 3);
    for (std::size_t i = 0; i < 3 * picture.pixels(); ++i) picture.plane(0)[i] = 1;
    const float bright[] = {4000, 2000, 500};
    for (int c = 0; c < 3; ++c) picture.at(40, 9, c) = bright[c];
    const double luminance = 0.2126 * 4000 + 0.7152 * 2000 + 0.0722 * 500;
    const double sun = lat_long_solid_angle_sr(9, 64, 32);
    const double energy = 4 * 3.14159265358979 + (luminance - 1) * sun;
    EnvironmentReport report;
    cube_from_lat_long(picture, 8, {.max_luminance = 10}, &report);
    EXPECT_EQ(report.clamped_texels, 1U);
    EXPECT_NEAR(report.clamped_share, (luminance - 10) * sun / energy, 1e-6);

    CubeMap cube(1);
    for (int c = 0; c < 3; ++c) cube.at(0, 0, 0, c) = bright[c];
    const CubeMap clamped = transformed(cube, 1, {.max_luminance = 10}, &report);
    EXPECT_NEAR(report.clamped_share, 1 - 10 / luminance, 1e-6);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(clamped.at(0, 0, 0, c), bright[c] * 10 / luminance, 1e-5);
    }
    // The limit is one of the picture after exposure.
    cube_from_lat_long(picture, 8, {.exposure_ev = -20, .max_luminance = 10}, &report);
    EXPECT_EQ(report.clamped_texels, 0U);
}

TEST(EnvironmentTransform, RefusesWhatIsOutOfRange) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(transformed(kX, {.yaw_deg = kNaN}), InvalidArgument);
    EXPECT_THROW(transformed(kX, {.exposure_ev = 65}), InvalidArgument);
    EXPECT_THROW(transformed(kX, {.max_luminance = 0}), InvalidArgument);
    EXPECT_THROW(LatLongToCube(8, 4, 4, {.max_luminance = kNaN}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
