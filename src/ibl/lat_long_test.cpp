#include "aureole/ibl/lat_long.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "ibl/labelled_cube.h"

namespace aureole::ibl {
namespace {

template <class Value>
Image picture_of(int width, const Value& value) {
    Image picture(width, width / 2, 3);
    for (int y = 0; y < width / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            const double v = value(direction_of({x + 0.5, y + 0.5}, width, width / 2));
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = static_cast<float>(v);
        }
    }
    return picture;
}

// Largest difference from a function over all texels farther than `from_pole_rad` from both poles.
template <class Value>
double error_of(const CubeMap& map, const Value& value, double from_pole_rad = 0) {
    double worst = 0;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < map.size(); ++y) {
            for (int x = 0; x < map.size(); ++x) {
                const Direction d = texel_direction(face, x, y, map.size());
                if (std::acos(std::abs(d.y)) < from_pole_rad) continue;
                const double expected = value(d);
                worst = std::max(worst, std::abs(map.at(face, x, y, 0) - expected));
            }
        }
    }
    return worst;
}

double smooth(const Direction& d) { return 2 + 0.5 * d.x - 0.8 * d.y + 0.3 * d.z + d.x * d.z; }

TEST(LatLong, AxesLieWhereOpenExrPutsThem) {
    const std::pair<Direction, LatLongPoint> places[] = {{{0, 0, 1}, {100, 50}},
                                                         {{1, 0, 0}, {50, 50}},
                                                         {{-1, 0, 0}, {150, 50}},
                                                         {{0, 1, 0}, {100, 0}},
                                                         {{0, -1, 1e-9}, {100, 100}}};
    for (const auto& [d, p] : places) {
        const LatLongPoint found = lat_long_point_of(d, 200, 100);
        EXPECT_NEAR(found.u, p.u, 1e-6);
        EXPECT_NEAR(found.v, p.v, 1e-6);
        EXPECT_NEAR(dot(direction_of(p, 200, 100), normalized(d)), 1, 1e-12);
    }
    EXPECT_NEAR(std::abs(lat_long_point_of({0, 0, -1}, 200, 100).u - 100), 100, 1e-9) << "the seam";
}

TEST(LatLong, PlacesAndDirectionsAreInverse) {
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        const Direction d = normalized({random.normal(), random.normal(), random.normal()});
        EXPECT_NEAR(dot(direction_of(lat_long_point_of(d, 64, 32), 64, 32), d), 1, 1e-14);
    }
}

TEST(LatLong, SolidAnglesSumToTheSphere) {
    for (const int height : {1, 2, 7, 1024}) {
        double sum = 0;
        for (int y = 0; y < height; ++y) sum += lat_long_solid_angle_sr(y, 3, height) * 3;
        EXPECT_NEAR(sum, 4 * kPi, 1e-12) << height;
    }
}

TEST(LatLongToCube, ConstantsStayConstant) {
    for (const auto& [width, height] : {std::pair{128, 64}, {2, 1}, {50, 33}, {1, 1}}) {
        Image picture(width, height, 3);
        std::fill_n(picture.plane(0), 3 * picture.pixels(), 1234.5F);
        for (const int size : {1, 2, 5, 33, 48}) {
            for (const double pitch_deg : {0.0, 45.0, 12.3}) {
                const CubeMap map =
                    cube_from_lat_long(picture, size, {.pitch_deg = pitch_deg, .yaw_deg = 20});
                for (std::size_t i = 0; i < 3 * map.stacked().pixels(); ++i) {
                    ASSERT_NEAR(map.stacked().plane(0)[i] / 1234.5F, 1, 1e-6)
                        << width << " to " << size << ", " << i;
                }
            }
        }
    }
}

// A single bright pixel anywhere: poles, seam, what becomes edges and corners of the cube; also
// when the poles of the picture come to lie on edges or in texels of the cube.
TEST(LatLongToCube, KeepsTheEnergyOfEveryPixel) {
    constexpr int kWidth = 96;
    constexpr int kHeight = 48;
    const EnvironmentTransform turns[] = {
        {}, {.pitch_deg = 45}, {.pitch_deg = 45, .yaw_deg = 20}, {.roll_deg = 54.7356}};
    Random random(6);
    for (const EnvironmentTransform& turn : turns) {
        for (const int size : {1, 4, 9, 32}) {
            for (int i = 0; i < 30; ++i) {
                const int x = i % 3 == 0 ? 0 : static_cast<int>(random.uniform(0, kWidth));
                const int y =
                    i < 8 ? i % 2 * (kHeight - 1) : static_cast<int>(random.uniform(0, kHeight));
                Image picture(kWidth, kHeight, 3);
                picture.at(x, y, 1) = 1e6F;
                const double energy =
                    4 * kPi * mean_radiance(cube_from_lat_long(picture, size, turn))[1];
                const double expected = 1e6 * lat_long_solid_angle_sr(y, kWidth, kHeight);
                ASSERT_NEAR(energy / expected, 1, 5e-5) << x << ", " << y << " to " << size;
            }
        }
    }
}

// Every texel is the mean over its own solid angle, and nothing leaks: a pixel 1e6 times as bright
// as the rest changes only texels that it, interpolated, reaches.
TEST(LatLongToCube, ABrightPixelStaysWhereItIs) {
    Image picture(256, 128, 3);
    std::fill_n(picture.plane(0), 3 * picture.pixels(), 1.0F);
    picture.at(77, 30, 0) = 1e6F;
    const Direction sun = direction_of({77.5, 30.5}, 256, 128);
    for (const int size : {16, 64, 200}) {
        const CubeMap map = cube_from_lat_long(picture, size);
        // A texel and a pixel, half their diagonals.
        const double reach = 1.5 / size + 2 * kPi / 256 * 1.5;
        for (int face = 0; face < kFaces; ++face) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    if (dot(texel_direction(face, x, y, size), sun) > std::cos(reach)) continue;
                    ASSERT_NEAR(map.at(face, x, y, 0), 1, 1e-5) << face << x << " " << y;
                }
            }
        }
    }
}

TEST(LatLongToCube, FindsAFunctionOfTheDirection) {
    const CubeMap shrunk = cube_from_lat_long(picture_of(512, smooth), 32);
    EXPECT_LT(error_of(shrunk, smooth), 2e-3) << "the mean of a texel is not its middle";
    const CubeMap same = cube_from_lat_long(picture_of(512, smooth), 128);
    EXPECT_LT(error_of(same, smooth), 2e-3) << "half a pixel is 6e-3";
    EXPECT_LT(error_of(same, smooth, 0.05), 3e-4);
}

// Interpolated: much closer to the function than the steps of its pixels, which are .04 here.
TEST(LatLongToCube, EnlargingIsSmoothAtPolesAndSeam) {
    const CubeMap map = cube_from_lat_long(picture_of(128, smooth), 256);
    EXPECT_LT(error_of(map, smooth), 0.012) << "linear in mu, by a pole: half a pixel";
    EXPECT_LT(error_of(map, smooth, 0.1), 2e-3);
    // A step across the seam would show there.
    for (int y = 0; y < 256; ++y) {
        EXPECT_NEAR(map.at(5, 127, y, 0), map.at(5, 128, y, 0), 0.012);
    }
}

// Stripes of one pixel, 32 of them to a texel.
TEST(LatLongToCube, ShrinkingDoesNotAlias) {
    Image picture(1024, 512, 3);
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 1024; ++x) {
            picture.at(x, y, 0) = static_cast<float>(x % 2);
            picture.at(x, y, 1) = static_cast<float>(y % 2);
            picture.at(x, y, 2) = static_cast<float>((x + y) % 2);
        }
    }
    const CubeMap map = cube_from_lat_long(picture, 8, {.pitch_deg = 10, .yaw_deg = 3});
    for (std::size_t i = 0; i < 3 * map.stacked().pixels(); ++i) {
        ASSERT_NEAR(map.stacked().plane(0)[i], 0.5F, 0.005F) << i;
    }
}

TEST(LatLongToCube, IsTheSameInPiecesAndWithOneThread) {
    Image picture(300, 150, 3);
    Random random(2);
    for (std::size_t i = 0; i < 3 * picture.pixels(); ++i) {
        picture.plane(0)[i] = static_cast<float>(random.log_uniform(1e-3, 1e5));
    }
    const EnvironmentTransform transform = {.yaw_deg = 5, .max_luminance = 5e4};
    EnvironmentReport whole_report;
    const CubeMap whole = cube_from_lat_long(picture, 40, transform, &whole_report);
    const ThreadLimit limit(1);
    LatLongToCube resampler(300, 150, 40, transform);
    std::vector<float> interleaved;
    for (int y = 0; y < 150;) {
        const int count = std::min(1 + y % 7, 150 - y);
        interleaved.clear();
        for (int i = 0; i < 300 * count; ++i) {
            for (int c = 0; c < 3; ++c) {
                interleaved.push_back(picture.at(i % 300, y + i / 300, c));
            }
        }
        resampler.add_rows(y, interleaved_view(interleaved.data(), 300, count, 3));
        y += count;
    }
    EXPECT_EQ(resampler.report().clamped_share, whole_report.clamped_share);
    const CubeMap pieces = resampler.finish();
    for (std::size_t i = 0; i < 3 * whole.stacked().pixels(); ++i) {
        ASSERT_EQ(whole.stacked().plane(0)[i], pieces.stacked().plane(0)[i]);
    }
}

// More rows than are integrated at once.
TEST(LatLongToCube, LongPicturesAreCutIntoBands) {
    Image picture(4, 400, 3);
    Image wide(30000, 100, 3);
    for (Image* image : {&picture, &wide}) {
        std::fill_n(image->plane(1), image->pixels(), 3.0F);
        const CubeMap map = cube_from_lat_long(*image, 20);
        for (std::size_t i = 0; i < map.stacked().pixels(); ++i) {
            ASSERT_NEAR(map.stacked().plane(1)[i], 3, 1e-5);
        }
    }
}

TEST(LatLongToCube, LabelsComeBackToTheirPlaces) {
    const CubeMap map = labelled_cube(64);
    const Image picture = lat_long_from_cube(map, 512);
    EXPECT_TRUE(has_labels_in_place(cube_from_lat_long(picture, 64), 1e-3F));
    EXPECT_FALSE(
        has_labels_in_place(cube_from_lat_long(picture, 64, {.mirror = Mirror::kX}), 0.5F));
}

// The same turn before and after.
TEST(LatLongToCube, TurnsLikeACube) {
    const Image picture = picture_of(256, smooth);
    const EnvironmentTransform turn = {
        .mirror = Mirror::kZ, .roll_deg = 10, .pitch_deg = 80, .yaw_deg = 200};
    const CubeMap map = cube_from_lat_long(picture, 32, turn);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                const Direction d = texel_direction(face, x, y, 32);
                const Direction before = {dot(d, transformed({1, 0, 0}, turn)),
                                          dot(d, transformed({0, 1, 0}, turn)),
                                          dot(d, transformed({0, 0, 1}, turn))};
                ASSERT_NEAR(map.at(face, x, y, 0), smooth(before), 3e-3);
            }
        }
    }
}

TEST(LatLongToCube, RefusesRowsOutOfOrder) {
    LatLongToCube resampler(8, 4, 2);
    const Image rows(8, 2, 3);
    const Image narrow(7, 2, 3);
    const Image grey(8, 2, 1);
    EXPECT_THROW(resampler.add_rows(1, rows), InvalidArgument);
    EXPECT_THROW(resampler.add_rows(0, narrow), InvalidArgument);
    EXPECT_THROW(resampler.add_rows(0, grey), InvalidArgument);
    resampler.add_rows(0, rows);
    EXPECT_THROW(resampler.add_rows(0, rows), InvalidArgument);
    EXPECT_THROW(resampler.finish(), InvalidArgument);
    resampler.add_rows(2, rows);
    EXPECT_THROW(resampler.add_rows(4, rows), InvalidArgument);
    EXPECT_EQ(resampler.finish().size(), 2);
    EXPECT_THROW(resampler.finish(), InvalidArgument);
    EXPECT_THROW(LatLongToCube(0, 4, 2), InvalidArgument);
    EXPECT_THROW(LatLongToCube(8, 70000, 2), InvalidArgument);
    EXPECT_THROW(LatLongToCube(8, 4, 0), InvalidArgument);
}

TEST(LatLongFromCube, KeepsEnergyAndConstants) {
    Random random(8);
    for (const int width : {64, 200}) {
        for (int i = 0; i < 12; ++i) {
            CubeMap map(24);
            const int face = i % kFaces;
            const int x = i < 6 ? 0 : static_cast<int>(random.uniform(0, 24));
            const int y = i < 3 ? 23 : static_cast<int>(random.uniform(0, 24));
            map.at(face, x, y, 0) = 1e5F;
            std::fill_n(map.stacked().plane(2), map.stacked().pixels(), 2.0F);
            const Image picture = lat_long_from_cube(map, width);
            double energy = 0;
            for (int v = 0; v < width / 2; ++v) {
                for (int u = 0; u < width; ++u) {
                    energy +=
                        lat_long_solid_angle_sr(v, width, width / 2) * double{picture.at(u, v, 0)};
                    ASSERT_NEAR(picture.at(u, v, 2), 2, 1e-6);
                }
            }
            EXPECT_NEAR(energy / (4 * kPi * mean_radiance(map)[0]), 1, 0.02)
                << face << " " << x << " " << y << " " << width;
        }
    }
}

TEST(LatLongFromCube, RefusesOddWidths) {
    EXPECT_THROW(lat_long_from_cube(CubeMap(4), 63), InvalidArgument);
    EXPECT_THROW(lat_long_from_cube(CubeMap(4), 0), InvalidArgument);
    EXPECT_THROW(lat_long_from_cube(CubeMap(), 64), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
