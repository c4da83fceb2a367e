#include "aureole/ibl/cube_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/random.h"

namespace aureole::ibl {
namespace {

CubeMap random_map(int size, std::uint64_t seed) {
    CubeMap map(size);
    Random random(seed);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                for (int c = 0; c < 3; ++c) {
                    map.at(face, x, y, c) = static_cast<float>(random.uniform());
                }
            }
        }
    }
    return map;
}

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

TEST(CubeSampler, ReproducesTexelsAtTheirCentres) {
    const CubeMap map = random_map(9, 1);
    const CubeSampler sampler({map});
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < 9; ++y) {
            for (int x = 0; x < 9; ++x) {
                const auto value = sampler.sample(texel_direction(face, x, y, 9), 0);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(value[static_cast<std::size_t>(c)], map.at(face, x, y, c), 1e-6);
                }
            }
        }
    }
}

// The half texel: a function linear in s and t is itself between the outermost centres.
TEST(CubeSampler, ReproducesLinearFunctionsOfAFace) {
    constexpr int kSize = 8;
    CubeMap map(kSize);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                map.at(face, x, y, 0) = (2 * static_cast<float>(x) + 1) / kSize - 1;
                map.at(face, x, y, 1) = (2 * static_cast<float>(y) + 1) / kSize - 1;
                map.at(face, x, y, 2) = static_cast<float>(face);
            }
        }
    }
    const CubeSampler sampler({map});
    Random random(2);
    constexpr double kInside = 1 - 1.0 / kSize;
    for (int i = 0; i < 1000; ++i) {
        const CubePoint point{i % kFaces, random.uniform(-kInside, kInside),
                              random.uniform(-kInside, kInside)};
        // Any length.
        Direction d = direction_of(point);
        const double length = random.log_uniform(1e-3, 1e3);
        d = {d.x * length, d.y * length, d.z * length};
        const auto value = sampler.sample(d, 0);
        EXPECT_NEAR(value[0], point.s, 1e-6);
        EXPECT_NEAR(value[1], point.t, 1e-6);
        EXPECT_NEAR(value[2], point.face, 1e-5);
    }
}

// Levels of 1 x 1 and 2 x 2 texels have corners everywhere.
TEST(CubeSampler, IsContinuousAcrossEdgesAndCorners) {
    constexpr double kStep = 1e-6;
    Random random(3);
    for (const int size : {1, 2, 3, 16}) {
        const CubeSampler sampler({random_map(size, 4)});
        for (int i = 0; i < 3000; ++i) {
            // On an edge, near a corner every third time.
            CubePoint point{i % kFaces, 1, random.uniform(-1, 1)};
            if (i % 2 == 1) point.s = -1;
            if (i % 3 == 0) point.t = random.uniform() < 0.5 ? 1 : -1;
            if (random.uniform() < 0.5) std::swap(point.s, point.t);
            const Direction on = direction_of(point);
            const auto here = sampler.sample(on, 0);
            for (int k = 0; k < 4; ++k) {
                const auto there =
                    sampler.sample({on.x + kStep * random.normal(), on.y + kStep * random.normal(),
                                    on.z + kStep * random.normal()},
                                   0);
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(here[c], there[c], 10 * kStep * size) << size;
                }
            }
        }
    }
}

// Across an edge the mean of both texels, at a corner that of all three.
TEST(CubeSampler, TakesNeighboursFromTheAdjacentFaces) {
    CubeMap map(4);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 4; ++x) map.at(face, x, y, 0) = static_cast<float>(1 << face);
        }
    }
    const CubeSampler sampler({map});
    EXPECT_NEAR(sampler.sample({1, 1, 0.1}, 0)[0], (1 + 4) / 2.0, 1e-6);
    EXPECT_NEAR(sampler.sample({-1, 0, -1}, 0)[0], (2 + 32) / 2.0, 1e-6);
    EXPECT_NEAR(sampler.sample({1, 1, 1}, 0)[0], (1 + 4 + 16) / 3.0, 1e-5);
    EXPECT_NEAR(sampler.sample({-1, -1, -1}, 0)[0], (2 + 8 + 32) / 3.0, 1e-5);
}

TEST(CubeSampler, IsLinearBetweenLevelsAndClampsBeyond) {
    const CubeChain chain = {random_map(12, 5), random_map(5, 6), random_map(2, 7)};
    const CubeSampler sampler(chain);
    EXPECT_EQ(sampler.levels(), 3);
    Random random(8);
    for (int i = 0; i < 100; ++i) {
        const Direction d = random_direction(random);
        const double level = random.uniform(0, 2);
        const double floor = std::floor(level);
        const auto value = sampler.sample(d, level);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c],
                        sampler.sample(d, floor)[c] * (1 - (level - floor)) +
                            sampler.sample(d, floor + 1)[c] * (level - floor),
                        1e-6);
        }
        EXPECT_EQ(sampler.sample(d, -3), sampler.sample(d, 0));
        EXPECT_EQ(sampler.sample(d, 17), sampler.sample(d, 2));
        EXPECT_EQ(sampler.sample(d, 2), CubeSampler({chain[2]}).sample(d, 0));
    }
}

TEST(CubeSampler, RefusesEmptyChains) {
    EXPECT_THROW(CubeSampler({}), InvalidArgument);
    EXPECT_THROW(CubeSampler({CubeMap(4), CubeMap()}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
