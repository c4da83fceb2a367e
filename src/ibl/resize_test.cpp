#include "aureole/ibl/resize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "ibl/labelled_cube.h"

namespace aureole::ibl {
namespace {

std::vector<float> values(const CubeMap& map) {
    return {map.stacked().plane(0), map.stacked().plane(0) + 3 * map.stacked().pixels()};
}

CubeMap noise(int size) {
    CubeMap map(size);
    Random random(9);
    for (std::size_t i = 0; i < 3 * map.stacked().pixels(); ++i) {
        map.stacked().plane(0)[i] = static_cast<float>(random.log_uniform(1e-2, 1e3));
    }
    return map;
}

// Of mirrors and quarter turns there are 48, and the labelled cube tells them all apart.
TEST(Resize, QuarterTurnsMoveTexelsUnchanged) {
    const CubeMap map = labelled_cube(4);
    std::set<std::vector<float>> seen;
    for (const Mirror mirror : {Mirror::kNone, Mirror::kX}) {
        for (int pitch = 0; pitch < 4; ++pitch) {
            for (int roll = 0; roll < 4; ++roll) {
                for (int yaw = 0; yaw < 4; ++yaw) {
                    const EnvironmentTransform turn = {.mirror = mirror,
                                                       .roll_deg = 90.0 * roll,
                                                       .pitch_deg = 90.0 * pitch,
                                                       .yaw_deg = 90.0 * yaw - 720};
                    const CubeMap turned = transformed(map, 4, turn);
                    seen.insert(values(turned));
                    for (int i = 0; i < 24; ++i) {
                        const int face = i / 4;
                        const int x = i % 4;
                        const CubePoint to =
                            cube_point_of(transformed(texel_direction(face, x, 1, 4), turn));
                        const int u = static_cast<int>((to.s + 1) * 2);
                        const int v = static_cast<int>((to.t + 1) * 2);
                        for (int c = 0; c < 3; ++c) {
                            ASSERT_EQ(turned.at(to.face, u, v, c), map.at(face, x, 1, c));
                        }
                    }
                }
            }
        }
    }
    EXPECT_EQ(seen.size(), 48U);
}

TEST(Resize, SameSizeIsACopy) {
    const CubeMap map = noise(7);
    EXPECT_EQ(values(transformed(map, 7)), values(map));
}

TEST(Resize, ConstantsStayConstant) {
    CubeMap map(12);
    for (std::size_t i = 0; i < 3 * map.stacked().pixels(); ++i) map.stacked().plane(0)[i] = 0.7F;
    for (const int size : {1, 5, 12, 31}) {
        for (const double yaw_deg : {0.0, 90.0, 17.0}) {
            for (const float v : values(transformed(map, size, {.yaw_deg = yaw_deg}))) {
                ASSERT_NEAR(v, 0.7F, 1e-6F);
            }
        }
    }
}

// One bright texel: in a corner, at an edge, in the middle of a face.
TEST(Resize, KeepsEnergy) {
    const int places[][3] = {{0, 0, 0}, {3, 15, 8}, {4, 7, 7}, {2, 3, 12}};
    for (const auto& [face, x, y] : places) {
        CubeMap map(16);
        map.at(face, x, y, 1) = 1e5F;
        const double before = mean_radiance(map)[1];
        const auto change = [&](int size, const EnvironmentTransform& transform) {
            return mean_radiance(transformed(map, size, transform))[1] / before - 1;
        };
        for (const int size : {4, 16, 41}) {
            const EnvironmentTransform turn = {.roll_deg = 7, .pitch_deg = 31, .yaw_deg = 50};
            EXPECT_LT(std::abs(change(size, turn)), 0.03) << face << x << y << " " << size;
        }
        EXPECT_LT(std::abs(change(4, {})), 1e-6) << face << x << y;
        EXPECT_LT(std::abs(change(32, {})), 0.015) << face << x << y;
    }
}

// A linear function of the direction is nearly linear on faces: enlarging finds it between texels,
// across edges too.
TEST(Resize, EnlargingIsSmoothAndSeamless) {
    const auto value = [](const Direction& d) { return 2 + 0.5 * d.x - 0.8 * d.y + 0.3 * d.z; };
    CubeMap map(32);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                map.at(face, x, y, 0) = static_cast<float>(value(texel_direction(face, x, y, 32)));
            }
        }
    }
    const CubeMap large = transformed(map, 128);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 128; ++x) {
                ASSERT_NEAR(large.at(face, x, y, 0), value(texel_direction(face, x, y, 128)), 0.012)
                    << face << " " << x << " " << y;
            }
        }
    }
}

TEST(Resize, DoesNotDependOnThreads) {
    const CubeMap map = noise(20);
    const auto many = values(transformed(map, 13, {.pitch_deg = 40}));
    const ThreadLimit limit(1);
    EXPECT_EQ(values(transformed(map, 13, {.pitch_deg = 40})), many);
}

TEST(Resize, RefusesEmptyMapsAndSizes) {
    EXPECT_THROW(transformed(CubeMap(), 4), InvalidArgument);
    EXPECT_THROW(transformed(CubeMap(2), 0), InvalidArgument);
    EXPECT_THROW(transformed(CubeMap(2), 20000), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
