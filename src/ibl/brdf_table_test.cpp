#include "aureole/ibl/brdf_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/roughness.h"

namespace aureole::ibl {
namespace {

constexpr int kPoints = 1024;  // per side of the oracles' grids: 2^20

double smith_lambda(double cosine, double alpha) {
    const double tan2 = (1 - cosine * cosine) / (cosine * cosine);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

// Integral of D V (N.l) and of that times (1 - v.h)^5, as the mean of G2 / G1 over visible normals,
// drawn from a spherical cap (Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): half vectors, no mirror direction, no weight by D.
std::array<double, 2> ggx_by_visible_normals(double n_dot_v, double alpha) {
    const Direction v = {std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
    const Direction stretched = normalized({alpha * v.x, 0, v.z});
    const double masking = 1 + smith_lambda(n_dot_v, alpha);
    double all = 0;
    double fresnel = 0;
    for (int j = 0; j < kPoints; ++j) {
        const double z = 1 - (1 + stretched.z) * (j + .5) / kPoints;
        const double r = std::sqrt(1 - z * z);
        for (int i = 0; i < kPoints; ++i) {
            const double phi = kPi * (i + .5) / kPoints;
            const Direction m = {r * std::cos(phi) + stretched.x, r * std::sin(phi),
                                 z + stretched.z};
            const Direction h = normalized({alpha * m.x, alpha * m.y, m.z});
            const double v_dot_h = dot(v, h);
            const double n_dot_l = 2 * v_dot_h * h.z - v.z;
            if (n_dot_l <= 0) continue;
            const double value = masking / (masking + smith_lambda(n_dot_l, alpha));
            all += value;
            fresnel += value * std::pow(1 - v_dot_h, 5);
        }
    }
    return {all / kPoints / kPoints, fresnel / kPoints / kPoints};
}

// The integral of D V (N.l) 4 (v.h) over half vectors, cos(h) = t^2 for the horizon's sake.
double cloth_by_half_vectors(double n_dot_v, double alpha) {
    const Direction v = {std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
    double sum = 0;
    for (int j = 0; j < kPoints; ++j) {
        const double t = (j + .5) / kPoints;
        const double z = t * t;
        const double r = std::sqrt(1 - z * z);
        const double d = (2 + 1 / alpha) / (2 * kPi) * std::pow(r, 1 / alpha);
        for (int i = 0; i < kPoints; ++i) {
            const Direction h = {r * std::cos(kPi * (i + .5) / kPoints),
                                 r * std::sin(kPi * (i + .5) / kPoints), z};
            const double v_dot_h = dot(v, h);
            const double l = 2 * v_dot_h * h.z - v.z;
            if (v_dot_h <= 0 || l <= 0) continue;
            sum += d * l / (4 * (l + v.z - l * v.z)) * 4 * v_dot_h * 2 * t;
        }
    }
    return sum * 2 * kPi / kPoints / kPoints;
}

struct Entry {
    int x, y;
    double n_dot_v, alpha;
};
// Random texels, and the corners.
Entry entry(int index, Random& random, int size) {
    int x = static_cast<int>(random.uniform() * size);
    int y = static_cast<int>(random.uniform() * size);
    if (index < 4) {
        x = index % 2 * (size - 1);
        y = index / 2 * (size - 1);
    }
    return {x, y, (x + .5) / size, alpha_from_roughness((y + .5) / size)};
}

TEST(BrdfTable, GgxIsTheMeanOverVisibleNormals) {
    const BrdfTable table(BrdfTableKind::kGgx);
    Random random(1);
    for (int i = 0; i < 12; ++i) {
        const Entry e = entry(i, random, table.size());
        const auto [all, fresnel] = ggx_by_visible_normals(e.n_dot_v, e.alpha);
        EXPECT_NEAR(table.image().row(e.y, 0)[e.x], all - fresnel, 3e-4) << e.x << " " << e.y;
        EXPECT_NEAR(table.image().row(e.y, 1)[e.x], fresnel, 3e-4) << e.x << " " << e.y;
    }
}

TEST(BrdfTable, ClothIsTheIntegralOverHalfVectors) {
    const BrdfTable table(BrdfTableKind::kCloth);
    Random random(2);
    for (int i = 0; i < 12; ++i) {
        const Entry e = entry(i, random, table.size());
        const double expected = cloth_by_half_vectors(e.n_dot_v, e.alpha);
        EXPECT_NEAR(table.image().row(e.y, 0)[e.x], expected, 1e-4 * (1 + expected))
            << e.x << " " << e.y;
    }
}

// At alpha = 1, D = 1 / pi and V = 1 / (2 (N.l + N.v)): 1 - N.v ln((1 + N.v) / N.v) in all.
TEST(BrdfTable, RoughestGgxIsKnownInClosedForm) {
    const BrdfTable table(BrdfTableKind::kMultiscatter, 512);
    for (const double v : {.1, .3, .5, .8, .99}) {
        EXPECT_NEAR(table.lookup(v, 1)[1], 1 - v * std::log((1 + v) / v), 1e-3) << v;
    }
}

// A mirror reflects Schlick's term and nothing is lost.
TEST(BrdfTable, SmoothestGgxIsAMirror) {
    const BrdfTable table(BrdfTableKind::kGgx, 256);
    for (const int x : {0, 10, 100, 255}) {
        const double mirror = std::pow(1 - (x + .5) / 256, 5);
        EXPECT_NEAR(table.image().row(0, 1)[x], mirror, 1e-4) << x;
        EXPECT_NEAR(table.image().row(0, 0)[x], 1 - mirror, 1e-4) << x;
    }
}

TEST(BrdfTable, MultiscatterHoldsTheSameIntegrals) {
    const BrdfTable ggx(BrdfTableKind::kGgx, 40);
    const BrdfTable multiscatter(BrdfTableKind::kMultiscatter, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            EXPECT_EQ(multiscatter.image().row(y, 0)[x], ggx.image().row(y, 1)[x]);
            EXPECT_NEAR(multiscatter.image().row(y, 1)[x],
                        ggx.image().row(y, 0)[x] + ggx.image().row(y, 1)[x], 1e-6);
        }
    }
}

// White furnace: what a white surface really reflects once, times the compensation that a renderer
// looks up anywhere in the table, is what came in.
TEST(BrdfTable, CompensatedWhiteSurfaceReflectsEverything) {
    const BrdfTable table(BrdfTableKind::kMultiscatter);
    Random random(3);
    for (int i = 0; i < 10; ++i) {
        const double n_dot_v = random.uniform(.05, 1);
        const double roughness = random.uniform(.1, .996);
        const double once = ggx_by_visible_normals(n_dot_v, alpha_from_roughness(roughness))[0];
        const auto [dfg1, dfg2] = table.lookup(n_dot_v, roughness);
        EXPECT_NEAR(once * (1 + 1 * (1 / dfg2 - 1)), 1, 1e-3) << n_dot_v << " " << roughness;
        EXPECT_LT(dfg1, dfg2);
    }
    EXPECT_LT(table.lookup(1, 1)[1], .33);  // without it two thirds are lost
}

TEST(BrdfTable, EnergyIsNeverGained) {
    const BrdfTable table(BrdfTableKind::kGgx, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float scale = table.image().row(y, 0)[x];
            const float bias = table.image().row(y, 1)[x];
            EXPECT_GE(scale, 0);
            EXPECT_GE(bias, 0);
            EXPECT_LE(scale + bias, 1 + 1e-5F);
        }
    }
}

TEST(BrdfTable, LossGrowsWithRoughness) {
    const BrdfTable table(BrdfTableKind::kMultiscatter, 64);
    for (int y = 1; y < 64; ++y) {
        for (int x = 16; x < 64; ++x) {
            EXPECT_LE(table.image().row(y, 1)[x], table.image().row(y - 1, 1)[x] + 1e-5F);
        }
    }
}

TEST(BrdfTable, LooksUpAsATexture) {
    const BrdfTable table(BrdfTableKind::kGgx, 16);
    const Image& image = table.image();
    EXPECT_EQ(table.lookup(3.5 / 16, 9.5 / 16)[1], image.row(9, 1)[3]);
    EXPECT_FLOAT_EQ(table.lookup(4.0 / 16, 9.5 / 16)[0],
                    (image.row(9, 0)[3] + image.row(9, 0)[4]) / 2);
    EXPECT_FLOAT_EQ(table.lookup(3.5 / 16, 10.0 / 16)[0],
                    (image.row(9, 0)[3] + image.row(10, 0)[3]) / 2);
    EXPECT_EQ(table.lookup(-1, 2)[0], image.row(15, 0)[0]);
    EXPECT_EQ(BrdfTable(BrdfTableKind::kCloth, 4).lookup(.5, .5)[1], 0);
}

TEST(BrdfTable, IsTheSameWithAnyNumberOfThreads) {
    const BrdfTable several(BrdfTableKind::kGgx, 24);
    const ThreadLimit one(1);
    const BrdfTable alone(BrdfTableKind::kGgx, 24);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
            EXPECT_EQ(several.image().row(y, 0)[x], alone.image().row(y, 0)[x]);
        }
    }
}

TEST(BrdfTable, RefusesSizesOutOfRange) {
    EXPECT_THROW(BrdfTable(BrdfTableKind::kGgx, 0), InvalidArgument);
    EXPECT_THROW(BrdfTable(BrdfTableKind::kCloth, 1025), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
