#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/ibl/exact.h"
#include "ibl/ggx_lobe.h"
#include "ibl/level_filter.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

constexpr double kAlphas[] = {1e-6, 1e-3, .018, .086, .25, .7, .999, 1};

CubeMap noise(int size, std::uint64_t seed) {
    CubeMap map(size);
    Random random(seed);
    for (int row = 0; row < kFaces * size; ++row) {
        for (int c = 0; c < 3; ++c) {
            for (int x = 0; x < size; ++x) {
                map.stacked().row(row, c)[x] = static_cast<float>(random.log_uniform(.01, 100));
            }
        }
    }
    return map;
}

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

CubeMap filtered(const CubeMap& environment, double alpha, int size) {
    const auto filter = make_exact_filter(environment.size(), {{size, alpha, 0}});
    filter->prepare(environment);
    CubeMap out(size);
    parallel_for(static_cast<std::size_t>(tile_count(size)), [&](std::size_t i, int worker) {
        filter->filter(0, tile_at(static_cast<int>(i), size), worker, out);
    });
    return out;
}

// The definition by brute force: every texel in `cells` x `cells` parts of 2 x 2 Gauss-Legendre
// points, whatever the lobe.
std::array<double, 3> direct_sum(const CubeMap& map, const Direction& n, double alpha, int cells) {
    const GgxLobe lobe(alpha);
    const int points = 2 * map.size() * cells;
    const auto place = [&](int i) {
        return 2.0 * ((i | 1) + (i % 2 == 0 ? -1 : 1) / std::sqrt(3.0)) / points - 1;
    };
    std::array<double, 3> sum = {};
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < points; ++y) {
            const double t = place(y);
            for (int x = 0; x < points; ++x) {
                const double s = place(x);
                const double mu = dot(n, direction_of({face, s, t}));
                if (mu <= 0) continue;
                const double h = 1 + s * s + t * t;
                const double weight = lobe.weight(mu) * 4 / (points * points * h * std::sqrt(h));
                for (int c = 0; c < 3; ++c) {
                    sum[static_cast<std::size_t>(c)] +=
                        weight * map.at(face, x / cells / 2, y / cells / 2, c);
                }
            }
        }
    }
    for (double& channel : sum) channel /= lobe.integral();
    return sum;
}

TEST(GgxLobe, IntegralIsThatOfTheWeight) {
    for (const double alpha : {1e-3, .018, .3, .99, .9996, 1.0}) {
        const GgxLobe lobe(alpha);
        // Midpoints in ln(q) of mu from 1 to 0.
        constexpr int kSteps = 100000;
        double sum = 0;
        const double span = std::log((lobe.a2 + lobe.b) / lobe.a2);
        for (int i = 0; i < kSteps; ++i) {
            if (alpha == 1) {
                sum += 2 * kPi * lobe.weight((i + .5) / kSteps) / kSteps;
                continue;
            }
            const double q = lobe.a2 * std::exp(span * (i + .5) / kSteps);
            const double mu = 1 - (q - lobe.a2) / lobe.b;
            sum += 2 * kPi * lobe.weight(mu) * q / lobe.b * span / kSteps;
        }
        EXPECT_NEAR(lobe.integral() / sum, 1, 1e-8) << alpha;
    }
}

TEST(ExactFilter, KeepsAConstant) {
    for (const int size : {1, 5, 16, 64, 100}) {
        const ExactFilter exact(constant_environment(size, {2.5F, 2.5F, 2.5F}));
        Random random(7);
        for (const double alpha : kAlphas) {
            for (int i = 0; i < 6; ++i) {
                const auto rgb = exact.at(random_direction(random), alpha);
                EXPECT_NEAR(rgb[1] / 2.5, 1, 1e-5) << size << " alpha " << alpha;
            }
        }
    }
}

// One bright texel, where no errors average out: in the lobe, on its flank, on the horizon.
TEST(ExactFilter, IsTheDirectSum) {
    Random random(11);
    for (const int size : {3, 16, 64}) {
        for (const double alpha : {.05, .25, 1.0}) {
            CubeMap map = noise(size, 5);
            map.at(2, size / 2, size / 3, 1) = 1e5F;
            const Direction sun = texel_direction(2, size / 2, size / 3, size);
            const ExactFilter exact(map);
            for (int i = 0; i < 2; ++i) {
                const Direction n = normalized(
                    {sun.x + .5 * i * random.normal(), sun.y, sun.z + .5 * i * random.normal()});
                const auto expected = direct_sum(map, n, alpha, 192 / size);
                const auto actual = exact.at(n, alpha);
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(actual[c] / expected[c], 1, 2e-5)
                        << size << " alpha " << alpha << " output " << i;
                }
            }
        }
    }
}

// Tiles share decisions among 64 outputs; one direction makes its own.
TEST(ExactFilter, LevelsAreTheSameAsSingleDirections) {
    const CubeMap map = sun_environment(64);
    const ExactFilter exact(map);
    for (const double alpha : {.05, .3, 1.0}) {
        for (const int size : {3, 12}) {
            const CubeMap level = filtered(map, alpha, size);
            const double mean = mean_radiance(level)[2];
            for (int i = 0; i < 60; ++i) {
                const int face = i % kFaces;
                const int x = i * 7 % size;
                const int y = i * 11 % size;
                const double expected = exact.at(texel_direction(face, x, y, size), alpha)[2];
                EXPECT_NEAR(level.at(face, x, y, 2), expected, 1e-6 * mean + 1e-5 * expected)
                    << alpha << " " << size;
            }
        }
    }
}

TEST(ExactFilter, NarrowLobesShowTheTexel) {
    const CubeMap map = noise(16, 8);
    const ExactFilter exact(map);
    for (int i = 0; i < 16; ++i) {
        const auto rgb = exact.at(texel_direction(i % 6, i, 5, 16), 1e-12);
        EXPECT_NEAR(rgb[0] / map.at(i % 6, i, 5, 0), 1, 1e-3);
    }
}

TEST(ExactFilter, RefusesNoEnvironment) { EXPECT_THROW(ExactFilter{CubeMap()}, InvalidArgument); }

}  // namespace
}  // namespace aureole::ibl
