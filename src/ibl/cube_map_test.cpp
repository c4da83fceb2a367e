#include "aureole/ibl/cube_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

TEST(CubeMap, MiddlesOfFacesLookAlongTheirAxes) {
    const Direction axes[kFaces] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                    {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (int face = 0; face < kFaces; ++face) {
        EXPECT_NEAR(dot(direction_of({face, 0, 0}), axes[face]), 1, 1e-15) << kFaceNames[face];
    }
}

// Table 8.19 of the OpenGL 4.6 specification, which gives s and t from a direction: major axis,
// sc, tc per face; s = (sc / |ma| + 1) / 2.
TEST(CubeMap, PlacesAreThoseOfTheSpecification) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const Direction d = random_direction(random);
        const CubePoint point = cube_point_of(d);
        const double sc[kFaces] = {-d.z, d.z, d.x, d.x, d.x, -d.x};
        const double tc[kFaces] = {-d.y, -d.y, d.z, -d.z, -d.y, -d.y};
        const double major[kFaces] = {d.x, -d.x, d.y, -d.y, d.z, -d.z};
        const auto face = static_cast<std::size_t>(point.face);
        for (const double other : major) EXPECT_GE(major[face], other);
        EXPECT_NEAR(point.s, sc[face] / major[face], 1e-14);
        EXPECT_NEAR(point.t, tc[face] / major[face], 1e-14);
    }
}

TEST(CubeMap, DirectionsAndPlacesAreInverse) {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Direction d = random_direction(random);
        const Direction back = direction_of(cube_point_of(d));
        EXPECT_NEAR(dot(d, back), 1, 1e-14);
    }
}

// Neighbouring texels of an edge, one on each face, are closer than two texels of one face.
TEST(CubeMap, FacesMeetAtTheirEdges) {
    constexpr int kSize = 16;
    const double apart = std::cos(1.5 * 2.0 / kSize);
    for (int face = 0; face < kFaces; ++face) {
        for (int i = 0; i < kSize; ++i) {
            const double t = (2.0 * i + 1) / kSize - 1;
            for (const auto& [s_out, t_out] : {std::pair{1 + 1.0 / kSize, t},
                                               {-1 - 1.0 / kSize, t},
                                               {t, 1 + 1.0 / kSize},
                                               {t, -1 - 1.0 / kSize}}) {
                const CubePoint beyond = cube_point_of(direction_of({face, s_out, t_out}));
                EXPECT_NE(beyond.face, face);
                const Direction inside =
                    direction_of({face, std::clamp(s_out, -1 + 1.0 / kSize, 1 - 1.0 / kSize),
                                  std::clamp(t_out, -1 + 1.0 / kSize, 1 - 1.0 / kSize)});
                EXPECT_GT(dot(inside, direction_of(beyond)), apart);
            }
        }
    }
}

TEST(CubeMap, SolidAnglesSumToTheSphere) {
    for (const int size : {1, 2, 3, 16, 255}) {
        double face = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) face += texel_solid_angle_sr(x, y, size);
        }
        EXPECT_NEAR(kFaces * face, 4 * kPi, 1e-11) << size;
    }
}

// Against the midpoint rule over 64 x 64 points of the density (1 + s^2 + t^2)^(-3/2).
TEST(CubeMap, SolidAngleIsTheIntegralOverTheTexel) {
    constexpr int kSize = 5;
    constexpr int kPoints = 64;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            double sum = 0;
            for (int j = 0; j < kPoints; ++j) {
                for (int i = 0; i < kPoints; ++i) {
                    const double s = 2 * (x + (i + .5) / kPoints) / kSize - 1;
                    const double t = 2 * (y + (j + .5) / kPoints) / kSize - 1;
                    sum += std::pow(1 + s * s + t * t, -1.5);
                }
            }
            const double step = 2.0 / kSize / kPoints;
            EXPECT_NEAR(texel_solid_angle_sr(x, y, kSize), sum * step * step, 2e-6);
        }
    }
}

TEST(CubeMap, MeanIsWeightedBySolidAngle) {
    constexpr int kSize = 8;
    CubeMap map(kSize);
    map.at(3, 0, 0, 1) = 5;  // a corner
    map.at(3, 3, 4, 2) = 5;  // near the middle, five times as large
    const auto mean = mean_radiance(map);
    EXPECT_EQ(mean[0], 0);
    EXPECT_NEAR(mean[1], 5 * texel_solid_angle_sr(0, 0, kSize) / (4 * kPi), 1e-12);
    EXPECT_NEAR(mean[2], 5 * texel_solid_angle_sr(3, 4, kSize) / (4 * kPi), 1e-12);
    EXPECT_GT(mean[2], 3 * mean[1]);
}

TEST(CubeMap, FacesAreThePartsOfTheStack) {
    CubeMap map(3);
    map.face(4).at(1, 2, 2) = 7;
    EXPECT_EQ(map.at(4, 1, 2, 2), 7);
    EXPECT_EQ(map.stacked().at(1, 4 * 3 + 2, 2), 7);
    EXPECT_EQ(map.face(4).height, 3);
}

TEST(CubeMap, RefusesSizesOutOfRange) {
    EXPECT_THROW(CubeMap(0), InvalidArgument);
    EXPECT_THROW(CubeMap(-4), InvalidArgument);
    EXPECT_THROW(CubeMap(16385), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
