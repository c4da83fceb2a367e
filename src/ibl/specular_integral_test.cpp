#include "ibl/specular_integral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/units.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

constexpr Direction kUp = {0, 0, 1};

Direction view_at(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

// The integral by the midpoint rule over `points` x `points` places of every texel.
SpecularRadiance direct_sum(const CubeMap& environment, const Direction& normal,
                            const Direction& view, double alpha, int points) {
    const double a2 = alpha * alpha;
    const double nv = dot(normal, view);
    const int n = environment.size() * points;
    SpecularRadiance result;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                const Direction light = texel_direction(face, x, y, n);
                const double nl = dot(normal, light);
                if (nl <= 0) continue;
                const Direction half =
                    normalized({light.x + view.x, light.y + view.y, light.z + view.z});
                // D and G2 as Heitz 2014 writes them, with tangents and Lambda.
                const double nh = dot(normal, half);
                const double tan2 = 1 / (nh * nh) - 1;
                const double d = 1 / (kPi * a2 * std::pow(nh, 4) * std::pow(1 + tan2 / a2, 2));
                const auto lambda = [&](double cosine) {
                    return (std::sqrt(1 + a2 * (1 / (cosine * cosine) - 1)) - 1) / 2;
                };
                const double g = 1 / (1 + lambda(nl) + lambda(nv));
                const double weight = d * g / (4 * nv) * texel_solid_angle_sr(x, y, n);
                const double fresnel = std::pow(1 - dot(view, half), 5);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double radiance =
                        environment.at(face, x / points, y / points, static_cast<int>(c));
                    result.scale[c] += weight * (1 - fresnel) * radiance;
                    result.bias[c] += weight * fresnel * radiance;
                }
            }
        }
    }
    return result;
}

void expect_near(const SpecularRadiance& value, const SpecularRadiance& expected, double share) {
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(value.scale[c], expected.scale[c], share * expected.scale[c]) << c;
        EXPECT_NEAR(value.bias[c], expected.bias[c],
                    share * (expected.bias[c] + 0.1 * expected.scale[c]))
            << c;
    }
}

TEST(SpecularIntegral, IsTheSumOverTheSphere) {
    const Direction normal = normalized({0.3, 0.5, 0.8});
    for (const CubeMap& environment :
         {overcast_environment(16), studio_environment(16), sun_environment(16)}) {
        const SpecularIntegral integral(environment);
        for (const double alpha : {0.3, 1.0}) {
            for (const Direction& view :
                 {normalized({0.2, 0.4, 0.9}), normalized({-1, 0.4, 0.3})}) {
                SCOPED_TRACE(alpha);
                expect_near(integral.estimate(normal, view, alpha, 0, 16384, 5),
                            direct_sum(environment, normal, view, alpha, 4), 0.01);
            }
        }
    }
}

// Narrow lobes, far narrower than a texel or not, lose nothing of white light.
TEST(SpecularIntegral, NarrowLobesReflectAllLight) {
    const SpecularIntegral integral(constant_environment(8));
    for (const double alpha : {0.0, 1e-3, 0.01}) {
        for (const double cosine : {0.3, 0.7, 1.0}) {
            const SpecularRadiance whole =
                integral.estimate(kUp, view_at(cosine), alpha, 0, 4096, 1);
            EXPECT_NEAR(whole.scale[1] + whole.bias[1], 1, 0.002) << alpha << ' ' << cosine;
            EXPECT_NEAR(whole.bias[1], std::pow(1 - cosine, 5), 0.002) << alpha << ' ' << cosine;
        }
    }
}

// alpha = 1 and V = N: f (N.L) = (N.L) / (2 pi (1 + N.L)), whose integral is 1 - ln 2.
TEST(SpecularIntegral, RoughestSurfaceSeenFromAboveIsKnown) {
    const SpecularIntegral integral(constant_environment(8));
    const SpecularRadiance whole = integral.estimate(kUp, kUp, 1, 0, 65536, 1);
    EXPECT_NEAR(whole.scale[0] + whole.bias[0], 1 - std::log(2.0), 5e-4);
}

TEST(SpecularIntegral, MirrorIsTheEnvironment) {
    const CubeMap environment = studio_environment(32);
    const CubeSampler sampler(CubeChain{environment});
    const SpecularIntegral integral(environment);
    const Direction view = view_at(0.6);
    const auto expected = sampler.sample({-view.x, 0, view.z}, 0);
    const SpecularRadiance whole = integral.estimate(kUp, view, 0, 0, 2, 1);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(whole.scale[c] + whole.bias[c], expected[c], 1e-5);
    }
}

// Few samples see a sun that covers one texel of 24,576.
TEST(SpecularIntegral, SmallSunsAreNotMissed) {
    const CubeMap environment = sun_environment(64);
    const SpecularIntegral integral(environment);
    const Direction normal = normalized({0.3, 0.5, -0.2});
    const Direction view = normalized({0, 0.5, 0.5});
    const SpecularRadiance many = integral.estimate(normal, view, 0.25, 0, 262144, 1);
    for (std::uint32_t seed = 2; seed < 12; ++seed) {
        expect_near(integral.estimate(normal, view, 0.25, 0, 256, seed), many, 0.05);
    }
}

TEST(SpecularIntegral, StretchesOfTheSequenceMakeTheWhole) {
    const SpecularIntegral integral(studio_environment(16));
    const Direction view = view_at(0.4);
    const SpecularRadiance whole = integral.estimate(kUp, view, 0.2, 0, 64, 9);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        sum += integral.estimate(kUp, view, 0.2, 16 * i, 16, 9).scale[0] / 4;
    }
    EXPECT_NEAR(sum, whole.scale[0], 1e-9 * whole.scale[0]);
}

TEST(SpecularIntegral, BlackIsBlack) {
    const SpecularIntegral integral{CubeMap(4)};
    const SpecularRadiance whole = integral.estimate(kUp, view_at(0.5), 0.2, 0, 64, 1);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(whole.scale[c] + whole.bias[c], 0);
}

}  // namespace
}  // namespace aureole::ibl
