#include "ibl/radiance_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

CubeMap random_environment(int size, double lowest) {
    CubeMap map(size);
    Random random(5);
    for (int i = 0; i < kFaces * size; ++i) {
        for (int x = 0; x < size; ++x) {
            for (int c = 0; c < 3; ++c) {
                map.stacked().at(x, i, c) = static_cast<float>(random.uniform(lowest, 4));
            }
        }
    }
    return map;
}

struct Totals {
    double solid_angle = 0;
    std::array<double, 3> light = {};
    Direction first_moment;  // of luminance
    double luminance = 0;
};

Totals totals_of(const RadianceLevel& level) {
    Totals totals;
    const auto count = static_cast<std::size_t>(kFaces * level.per_side * level.per_side);
    for (std::size_t i = 0; i < count; ++i) {
        const RadianceBlock& block = level.blocks[i];
        for (int j = 0; j < 4; ++j) {
            totals.solid_angle += block.solid_angle_sr[j];
            totals.light[0] += block.r[j];
            totals.light[1] += block.g[j];
            totals.light[2] += block.b[j];
            const double luminance =
                0.2126 * block.r[j] + 0.7152 * block.g[j] + 0.0722 * block.b[j];
            totals.luminance += luminance;
            totals.first_moment.x += luminance * block.x[j];
            totals.first_moment.y += luminance * block.y[j];
            totals.first_moment.z += luminance * block.z[j];
        }
    }
    return totals;
}

TEST(RadianceTree, EveryLevelHasAllOfTheLight) {
    for (const int size : {1, 2, 7, 33, 64, 65, 100}) {
        const CubeMap map = random_environment(size, 0);
        RadianceTree tree(size);
        tree.build(map);
        const auto mean = mean_radiance(map);
        const Totals texels = totals_of(tree.levels()[0]);
        for (const RadianceLevel& level : tree.levels()) {
            const Totals totals = totals_of(level);
            EXPECT_NEAR(totals.solid_angle / (4 * kPi), 1, 1e-6) << size;
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(totals.light[c] / (4 * kPi * mean[c]), 1, 2e-6) << size;
            }
            EXPECT_NEAR(totals.first_moment.x, texels.first_moment.x, 1e-4) << size;
            EXPECT_NEAR(totals.first_moment.y, texels.first_moment.y, 1e-4) << size;
            EXPECT_NEAR(totals.first_moment.z, texels.first_moment.z, 1e-4) << size;
        }
        EXPECT_LE(tree.levels().back().nodes_per_side, 4);
        EXPECT_NEAR(tree.mean_luminance() * 4 * kPi / texels.luminance, 1, 1e-6);
    }
}

// Unit vectors: the mean and the spread around it always make 1.
TEST(RadianceTree, MeanAndMomentBelongTogether) {
    const CubeMap map = random_environment(70, -1);
    RadianceTree tree(70);
    tree.build(map);
    for (const RadianceLevel& level : tree.levels()) {
        const auto count = static_cast<std::size_t>(kFaces * level.per_side * level.per_side);
        for (std::size_t i = 0; i < count; ++i) {
            const RadianceBlock& block = level.blocks[i];
            for (int j = 0; j < 4; ++j) {
                if (block.solid_angle_sr[j] == 0) continue;
                const double square =
                    block.x[j] * block.x[j] + block.y[j] * block.y[j] + block.z[j] * block.z[j];
                EXPECT_NEAR(square + block.moment[j], 1, 2e-6);
                EXPECT_GE(block.moment[j], 0);
            }
        }
    }
}

// Solid angle and mean direction of a texel against a fine sum over it.
TEST(RadianceTree, TexelsAreIntegrated) {
    constexpr int kSize = 64;
    constexpr int kParts = 40;
    RadianceTree tree(kSize);
    tree.build(constant_environment(kSize));
    for (const auto& [face, x, y] : {std::array{0, 0, 0}, {3, 31, 32}, {4, 63, 20}, {1, 50, 63}}) {
        Direction sum;
        double total = 0;
        for (int i = 0; i < kParts * kParts; ++i) {
            const double s = 2 * (x + (i % kParts + 0.5) / kParts) / kSize - 1;
            const double t = 2 * (y + (i / kParts + 0.5) / kParts) / kSize - 1;
            const double weight = std::pow(1 + s * s + t * t, -1.5);
            const Direction d = direction_of({face, s, t});
            total += weight;
            sum = {sum.x + weight * d.x, sum.y + weight * d.y, sum.z + weight * d.z};
        }
        const RadianceBlock& block = tree.levels()[0].row(face, y / 2)[x / 2];
        const int j = x % 2 + 2 * (y % 2);
        EXPECT_NEAR(block.x[j], sum.x / total, 2e-7);
        EXPECT_NEAR(block.y[j], sum.y / total, 2e-7);
        EXPECT_NEAR(block.z[j], sum.z / total, 2e-7);
        const double moment = 1 - dot(sum, sum) / (total * total);
        EXPECT_NEAR(block.moment[j] / moment, 1, 1e-3);
        EXPECT_NEAR(block.solid_angle_sr[j] / texel_solid_angle_sr(x, y, kSize), 1, 1e-6);
    }
}

// Against sums over the texels of every node, in shares of each channel's light. A node of level 1
// knows its dipole; others bound it.
TEST(RadianceTree, DipolesBoundWhereColorsAre) {
    constexpr int kSize = 68;
    const CubeMap map = random_environment(kSize, 0);
    RadianceTree tree(kSize);
    tree.build(map);
    const auto mean = mean_radiance(map);
    const RadianceLevel& texels = tree.levels()[0];
    for (std::size_t k = 1; k < tree.levels().size(); ++k) {
        const RadianceLevel& level = tree.levels()[k];
        for (int i = 0; i < kFaces * level.nodes_per_side * level.nodes_per_side; ++i) {
            const int x = i % level.nodes_per_side;
            const int y = i / level.nodes_per_side % level.nodes_per_side;
            const int face = i / (level.nodes_per_side * level.nodes_per_side);
            const RadianceBlock& block = level.row(face, y / 2)[x / 2];
            const int node = x % 2 + 2 * (y % 2);
            std::array<Direction, 3> dipoles;
            const int side = 1 << k;
            for (int v = y * side; v < std::min((y + 1) * side, kSize); ++v) {
                for (int u = x * side; u < std::min((x + 1) * side, kSize); ++u) {
                    const RadianceBlock& texel = texels.row(face, v / 2)[u / 2];
                    const int j = u % 2 + 2 * (v % 2);
                    const std::array light = {texel.r[j], texel.g[j], texel.b[j]};
                    for (std::size_t c = 0; c < 3; ++c) {
                        const double share = light[c] / (4 * kPi * mean[c]);
                        dipoles[c].x += share * (texel.x[j] - block.x[node]);
                        dipoles[c].y += share * (texel.y[j] - block.y[node]);
                        dipoles[c].z += share * (texel.z[j] - block.z[node]);
                    }
                }
            }
            double largest = 0;
            for (const Direction& d : dipoles) largest = std::max(largest, std::sqrt(dot(d, d)));
            const double bound = level.dipole_row(face, y / 2)[4 * (x / 2) + node];
            EXPECT_GE(bound, largest * (1 - 1e-3) - 1e-10);
            if (k == 1) {
                EXPECT_LE(bound, largest * (1 + 1e-3) + 1e-10);
            }
        }
    }
}

// One color: rounding.
TEST(RadianceTree, GreyHasNoDipole) {
    RadianceTree tree(64);
    tree.build(interior_environment(64));
    const double colored = tree.levels().back().dipole_row(4, 0)[0];
    CubeMap grey = interior_environment(64);
    for (int i = 0; i < kFaces * 64; ++i) {
        for (int x = 0; x < 64; ++x) {
            for (const int c : {0, 2}) grey.stacked().at(x, i, c) = grey.stacked().at(x, i, 1);
        }
    }
    tree.build(grey);
    EXPECT_LT(tree.levels().back().dipole_row(4, 0)[0], 1e-2 * colored);
}

// All light of a node in one of its texels: it is where the texel is, and as small.
TEST(RadianceTree, NodesKnowWhereTheirLightIs) {
    constexpr int kSize = 128;
    RadianceTree tree(kSize);
    tree.build(one_texel_environment(kSize, 2, 77, 18, {3, 4, 5}));
    const RadianceBlock& texel = tree.levels()[0].row(2, 9)[38];
    const RadianceBlock& root = tree.levels().back().row(2, 0)[1];  // node (2, 0) of 4 x 4
    EXPECT_NEAR(root.x[0], texel.x[1], 1e-6);
    EXPECT_NEAR(root.y[0], texel.y[1], 1e-6);
    EXPECT_NEAR(root.z[0], texel.z[1], 1e-6);
    EXPECT_NEAR(root.moment[0] / texel.moment[1], 1, 1e-3);
}

}  // namespace
}  // namespace aureole::ibl
