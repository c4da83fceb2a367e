#include "aureole/ibl/irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/ibl/exact.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

Irradiance prepared(const CubeMap& map) {
    Irradiance irradiance(map.size());
    irradiance.prepare(map);
    return irradiance;
}

TEST(Irradiance, OfAConstantIsPiTimesIt) {
    Random random(1);
    for (const int size : {1, 3, 8, 64, 100, 256}) {
        const CubeMap map = constant_environment(size, {1, 2, 3});
        const Irradiance irradiance = prepared(map);
        for (int i = 0; i < 50; ++i) {
            const auto e = irradiance.at(random_direction(random));
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(e[c] / (kPi * static_cast<double>(c + 1)), 1, 1e-5) << size;
            }
        }
    }
}

// A lit upper hemisphere, whose edge is an edge of texels: E = pi (1 + cos theta) / 2.
TEST(Irradiance, OfAHemisphereIsItsViewFactor) {
    const CubeMap map =
        make_environment(64, [](const Direction& d) { return Radiance{d.y > 0 ? 1.0F : 0.0F}; });
    const Irradiance irradiance = prepared(map);
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const Direction n = random_direction(random);
        EXPECT_NEAR(irradiance.at(n)[0], kPi * (1 + n.y) / 2, 3e-5);
    }
    EXPECT_NEAR(irradiance.at({0, -1, 0})[0], 0, 3e-6);
}

// L = 1 + A.w has E = pi + 2 pi / 3 A.N: Ramamoorthi & Hanrahan 2001, "An Efficient Representation
// for Irradiance Environment Maps", eq. 8.
TEST(Irradiance, OfAGradientKeepsTwoThirds) {
    const Direction a = {.3, -.5, .2};
    const CubeMap map = make_environment(
        128, [&](const Direction& d) { return Radiance{static_cast<float>(1 + dot(a, d))}; });
    const Irradiance irradiance = prepared(map);
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const Direction n = random_direction(random);
        EXPECT_NEAR(irradiance.at(n)[0] / (kPi + 2 * kPi / 3 * dot(a, n)), 1, 5e-5);
    }
}

// Two clamped cosines under each other, which is also the phase function of a Lambertian sphere:
// 2 / 3 ((pi - t) cos t + sin t) at an angle t.
TEST(Irradiance, OfACosineLobeIsItsAutocorrelation) {
    const CubeMap map = make_environment(
        128, [](const Direction& d) { return Radiance{static_cast<float>(std::max(0.0, d.y))}; });
    const Irradiance irradiance = prepared(map);
    for (const double t : {0.0, .3, 1.0, 2.0, 3.0}) {
        const double expected = 2.0 / 3 * ((kPi - t) * std::cos(t) + std::sin(t));
        EXPECT_NEAR(irradiance.at({std::sin(t), std::cos(t), 0})[0], expected, 2e-4) << t;
    }
}

// P(N, 1) = E / pi, summed texel by texel by other code; with a sun in one texel.
TEST(Irradiance, IsTheExactFilterOfAlphaOne) {
    Random random(4);
    for (const int size : {5, 64, 200}) {
        const CubeMap map = sun_environment(size);
        const Irradiance irradiance = prepared(map);
        const ExactFilter exact(map);
        for (int i = 0; i < 30; ++i) {
            const Direction n = random_direction(random);
            const auto e = irradiance.at(n);
            const auto expected = exact.at(n, 1);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(e[c] / (kPi * expected[c]), 1, 3e-5) << size;
            }
        }
    }
}

// A lone bright texel against 400 x 400 points, as the horizon passes over it.
TEST(Irradiance, SetsASunTexelByTexel) {
    constexpr int kSize = 64;
    constexpr int kPoints = 400;
    CubeMap map(kSize);
    map.at(4, 50, 9, 1) = 1;
    const Irradiance irradiance = prepared(map);
    const Direction sun = texel_direction(4, 50, 9, kSize);
    const Direction side = normalized({sun.z, 0, -sun.x});
    const double largest = texel_solid_angle_sr(50, 9, kSize);
    for (int step = -6; step <= 6; ++step) {
        const double height = .004 * step;
        const Direction n =
            normalized({side.x + height * sun.x, side.y + height * sun.y, side.z + height * sun.z});
        double sum = 0;
        double weights = 0;
        for (int j = 0; j < kPoints; ++j) {
            for (int i = 0; i < kPoints; ++i) {
                const double s = 2 * (50 + (i + .5) / kPoints) / kSize - 1;
                const double t = 2 * (9 + (j + .5) / kPoints) / kSize - 1;
                const double weight = std::pow(1 + s * s + t * t, -1.5);
                sum += weight * std::max(0.0, dot(n, direction_of({4, s, t})));
                weights += weight;
            }
        }
        EXPECT_NEAR(irradiance.at(n)[1] / largest, sum / weights, 1.5e-5) << step;
    }
}

TEST(Irradiance, MapsAreTheSameWithAnyNumberOfThreads) {
    const CubeMap map = interior_environment(40);
    const CubeMap several = irradiance_map(map, 12);
    const ThreadLimit one(1);
    const CubeMap alone = irradiance_map(map, 12);
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 12; ++x) EXPECT_EQ(several.at(3, x, y, 1), alone.at(3, x, y, 1));
    }
    const auto e = prepared(map).at(texel_direction(3, 4, 7, 12));
    EXPECT_EQ(several.at(3, 4, 7, 2), static_cast<float>(e[2]));
}

TEST(Irradiance, RefusesWhatIsNoMap) {
    EXPECT_THROW(irradiance_map(CubeMap(), 32), InvalidArgument);
    EXPECT_THROW(irradiance_map(CubeMap(4), 0), InvalidArgument);
    EXPECT_THROW(Irradiance(20000), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
