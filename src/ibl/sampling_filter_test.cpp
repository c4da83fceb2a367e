#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cmath>
#include <functional>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/ibl/cube_sampler.h"
#include "aureole/ibl/roughness.h"
#include "ibl/level_filter.h"
#include "ibl/shrink.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

constexpr FilterMethod kMethods[] = {FilterMethod::kReference, FilterMethod::kFis,
                                     FilterMethod::kPrecomputed, FilterMethod::kNlWeighted};

const char* name(FilterMethod method) {
    return kFilterMethodNames[static_cast<std::size_t>(method)].data();
}

PrefilterOptions with(FilterMethod method, double overlap = 1, double bias = 0) {
    PrefilterOptions options;
    options.method = method;
    options.fis_overlap = overlap;
    options.fis_bias = bias;
    return options;
}

CubeMap filtered(const CubeMap& environment, const FilteredLevel& level,
                 const PrefilterOptions& options) {
    const auto filter = make_sampling_filter(environment.size(), {level}, options);
    filter->prepare(environment);
    CubeMap out(level.size);
    parallel_for(static_cast<std::size_t>(tile_count(level.size)), [&](std::size_t i, int worker) {
        filter->filter(0, tile_at(static_cast<int>(i), level.size), worker, out);
    });
    return out;
}

void for_each_texel(int size, const std::function<void(int face, int x, int y)>& visit) {
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) visit(face, x, y);
        }
    }
}

using Color = std::array<double, 3>;

Direction cross(const Direction& a, const Direction& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Direction mix(double a, const Direction& u, double b, const Direction& v, double c,
              const Direction& w) {
    return {a * u.x + b * v.x + c * w.x, a * u.y + b * v.y + c * w.y, a * u.z + b * v.z + c * w.z};
}

// ImportanceSampleGGX as the document prints it.
Direction document_half_vector(double xi_x, double xi_y, double alpha, const Direction& n) {
    const double phi = 2 * kPi * xi_x;
    const double cosine = std::sqrt((1 - xi_y) / (1 + (alpha * alpha - 1) * xi_y));
    const double sine = std::sqrt(1 - cosine * cosine);
    const Direction up = std::abs(n.z) < 0.999 ? Direction{0, 0, 1} : Direction{1, 0, 0};
    const Direction tangent = normalized(cross(up, n));
    return mix(sine * std::cos(phi), tangent, sine * std::sin(phi), cross(n, tangent), cosine, n);
}

double digits_mirrored(int index) {
    double value = 0;
    for (double digit = 0.5; index > 0; index /= 2, digit /= 2) value += index % 2 * digit;
    return value;
}

struct DocumentLoop {
    double alpha = 1;
    int samples = 32;
    int environment_size = 0;
    bool filtered = true;
    double overlap = 1;
    double bias = 0;
};

// The document's loops, plainly.
Color document_texel(const CubeSampler& sampler, const DocumentLoop& loop, const Direction& n) {
    Color sum = {};
    double weights = 0;
    for (int i = 0; i < loop.samples; ++i) {
        const Direction h = document_half_vector(static_cast<double>(i) / loop.samples,
                                                 digits_mirrored(i), loop.alpha, n);
        const double n_h = dot(n, h);
        const Direction l = mix(2 * n_h, h, -1, n, 0, n);
        const double n_l = dot(n, l);
        if (n_l <= 0) continue;
        double level = 0;
        if (loop.filtered) {
            const double a2 = loop.alpha * loop.alpha;
            const double d = a2 / (kPi * std::pow((a2 - 1) * n_h * n_h + 1, 2));
            const double density = d * n_h / (4 * n_h);
            const double sample_sr = 1 / (loop.samples * density);
            const double texel_sr = 4 * kPi / (6.0 * loop.environment_size * loop.environment_size);
            level = std::max(0.0, 0.5 * std::log2(loop.overlap * sample_sr / texel_sr) + loop.bias);
        }
        const auto radiance = sampler.sample(l, level);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += n_l * radiance[c];
        weights += n_l;
    }
    for (double& channel : sum) channel /= weights;
    return sum;
}

CubeChain mips_of(const CubeMap& map) {
    CubeChain chain = {map};
    for (int size = map.size() / 2; size > 0; size /= 2) {
        CubeMap& level = chain.emplace_back(size);
        for (int i = 0; i < tile_count(size); ++i) shrink_tile(map, tile_at(i, size), level);
    }
    return chain;
}

// The sum over all texels of all faces, each cut into `cuts` x `cuts`.
Color quadrature(const CubeMap& map, double alpha, const Direction& n, int cuts) {
    Color sum = {};
    double weights = 0;
    const double a2 = alpha * alpha;
    const int fine = map.size() * cuts;
    for_each_texel(fine, [&](int face, int x, int y) {
        const double mu = dot(n, texel_direction(face, x, y, fine));
        if (mu <= 0) return;
        const double q = 1 - (1 - a2) * (1 + mu) / 2;
        const double weight = mu / (q * q) * texel_solid_angle_sr(x, y, fine);
        weights += weight;
        for (int c = 0; c < 3; ++c) {
            sum[static_cast<std::size_t>(c)] += weight * map.at(face, x / cuts, y / cuts, c);
        }
    });
    for (double& channel : sum) channel /= weights;
    return sum;
}

TEST(SamplingFilter, KeepsAConstant) {
    const CubeMap environment = constant_environment(16, {0.25F, 1, 60});
    for (const FilterMethod method : kMethods) {
        for (const double alpha : {1e-12, 1e-3, 0.09, 0.5, 1.0}) {
            for (const int size : {16, 5, 1}) {
                const CubeMap out = filtered(environment, {size, alpha, 37}, with(method));
                for_each_texel(size, [&](int face, int x, int y) {
                    EXPECT_NEAR(out.at(face, x, y, 0) / 0.25, 1, 1e-5) << name(method);
                    EXPECT_NEAR(out.at(face, x, y, 1), 1, 1e-5);
                    EXPECT_NEAR(out.at(face, x, y, 2) / 60, 1, 1e-5);
                });
            }
        }
    }
}

TEST(SamplingFilter, IsTheDocumentsLoop) {
    const CubeMap environment = studio_environment(32);
    const CubeSampler sampler(mips_of(environment));
    for (const bool fis : {false, true}) {
        for (const double alpha : {0.02, 0.2, 1.0}) {
            for (const int samples : {1, 8, 45, 300}) {
                const FilteredLevel level = {5, alpha, samples};
                const CubeMap out = filtered(
                    environment, level,
                    fis ? with(FilterMethod::kFis, 4, 0.3) : with(FilterMethod::kReference));
                for_each_texel(level.size, [&](int face, int x, int y) {
                    const Color expected =
                        document_texel(sampler, {alpha, samples, 32, fis, 4, 0.3},
                                       texel_direction(face, x, y, level.size));
                    for (int c = 0; c < 3; ++c) {
                        const double e = expected[static_cast<std::size_t>(c)];
                        // A sample may end on the other side of an edge of 40 : .02.
                        EXPECT_NEAR(out.at(face, x, y, c), e, 1e-3 * e + 2e-3)
                            << fis << " " << alpha << " " << samples;
                    }
                });
            }
        }
    }
}

// With all samples above the horizon, precomputing them changes nothing.
TEST(SamplingFilter, PrecomputedIsFisForNarrowLobes) {
    const CubeMap environment = interior_environment(64);
    const FilteredLevel level = {16, 0.04, 64};
    const CubeMap fis = filtered(environment, level, with(FilterMethod::kFis));
    const CubeMap precomputed = filtered(environment, level, with(FilterMethod::kPrecomputed));
    for_each_texel(level.size, [&](int face, int x, int y) {
        EXPECT_NEAR(precomputed.at(face, x, y, 1) / fis.at(face, x, y, 1), 1, 2e-3);
    });
}

// A smooth map, so that linear lookups and constant texels agree.
TEST(SamplingFilter, ConvergesToTheIntegral) {
    const CubeMap environment = overcast_environment(32);
    for (const FilterMethod method : kMethods) {
        for (const double alpha : {0.1, 0.3, 1.0}) {
            const FilteredLevel level = {3, alpha, 4096};
            const CubeMap out = filtered(environment, level, with(method, 0.25));
            for_each_texel(level.size, [&](int face, int x, int y) {
                const Color truth =
                    quadrature(environment, alpha, texel_direction(face, x, y, level.size), 2);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(out.at(face, x, y, c) / truth[static_cast<std::size_t>(c)], 1,
                                0.006)
                        << name(method) << " " << alpha;
                }
            });
        }
    }
}

// Turned by quarters about an axis: what was seen along d is seen along turn(d).
CubeMap turned(const CubeMap& map, const std::function<Direction(const Direction&)>& back) {
    return make_environment(map.size(), [&](const Direction& d) {
        const auto [face, x, y] = texel_of(back(d), map.size());
        return Radiance{map.at(face, x, y, 0), map.at(face, x, y, 1), map.at(face, x, y, 2)};
    });
}

TEST(SamplingFilter, TurnsWithTheEnvironment) {
    const CubeMap environment = interior_environment(32);
    const std::function<Direction(const Direction&)> turns[] = {
        [](const Direction& d) {
            return Direction{d.x, -d.z, d.y};
        },
        [](const Direction& d) {
            return Direction{d.z, d.y, -d.x};
        },
        [](const Direction& d) {
            return Direction{-d.y, d.x, d.z};
        },
        [](const Direction& d) {
            return Direction{-d.x, d.y, d.z};
        },
    };
    for (const FilterMethod method : kMethods) {
        for (const double alpha : {0.25, 1.0}) {
            const FilteredLevel level = {6, alpha, 8192};
            const CubeMap straight = filtered(environment, level, with(method));
            const double mean = mean_radiance(straight)[1];
            for (const auto& turn : turns) {
                const CubeMap expected = turned(straight, turn);
                const CubeMap out = filtered(turned(environment, turn), level, with(method));
                for_each_texel(level.size, [&](int face, int x, int y) {
                    EXPECT_NEAR(out.at(face, x, y, 1), expected.at(face, x, y, 1), 0.04 * mean)
                        << name(method) << " " << alpha;
                });
            }
        }
    }
}

TEST(SamplingFilter, GivesTheSameBitsWithAnyNumberOfThreads) {
    const CubeMap environment = sun_environment(64);
    for (const FilterMethod method : kMethods) {
        const FilteredLevel level = {32, 0.3, 40};
        const CubeMap many = filtered(environment, level, with(method));
        const ThreadLimit one(1);
        const CubeMap single = filtered(environment, level, with(method));
        for (int c = 0; c < 3; ++c) {
            const float* a = many.stacked().plane(c);
            EXPECT_TRUE(std::equal(a, a + many.stacked().pixels(), single.stacked().plane(c)));
        }
    }
}

TEST(SamplingFilter, IsFiniteAndPositiveWhateverComes) {
    for (const int size : {1, 2, 7, 32}) {
        const CubeMap environment = corner_texel_environment(size);
        for (const FilterMethod method : kMethods) {
            for (const double alpha : {1e-300, 1e-5, 0.01, 1.0}) {
                for (const int samples : {1, 2, 33}) {
                    const CubeMap out =
                        filtered(environment, {size, alpha, samples}, with(method, 1, 3));
                    for (std::size_t i = 0; i < out.stacked().pixels(); ++i) {
                        const float value = out.stacked().plane(1)[i];
                        ASSERT_TRUE(value > 0.0199F && value < 2.1e6F)
                            << name(method) << " " << alpha << " " << value;
                    }
                }
            }
        }
    }
}

// Every instruction set that this machine can run, the slowest included.
TEST(SamplingFilter, EveryInstructionSetAgrees) {
    const CubeMap environment = interior_environment(32);
    const std::int64_t supported = hwy::SupportedTargets();
    for (const FilterMethod method : kMethods) {
        const FilteredLevel level = {12, 0.3, 45};
        hwy::SetSupportedTargetsForTest(HWY_SCALAR);
        const CubeMap plain = filtered(environment, level, with(method));
        int tried = 0;
        for (const std::int64_t target : {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2},
                                          std::int64_t{HWY_SSSE3}, std::int64_t{HWY_NEON}}) {
            if ((supported & target) == 0) continue;
            hwy::SetSupportedTargetsForTest(target);
            const CubeMap out = filtered(environment, level, with(method));
            for_each_texel(level.size, [&](int face, int x, int y) {
                ASSERT_NEAR(out.at(face, x, y, 2) / plain.at(face, x, y, 2), 1, 1e-4)
                    << hwy::TargetName(target) << " " << name(method);
            });
            ++tried;
        }
        EXPECT_GE(tried, 1);
    }
    hwy::SetSupportedTargetsForTest(0);
}

// One sample is what a mirror shows.
TEST(SamplingFilter, OneSampleIsAMirror) {
    const CubeMap environment = interior_environment(32);
    for (const FilterMethod method : kMethods) {
        const CubeMap out = filtered(environment, {32, 1e-3, 1}, with(method));
        for_each_texel(32, [&](int face, int x, int y) {
            EXPECT_NEAR(out.at(face, x, y, 0), environment.at(face, x, y, 0),
                        1e-3F * environment.at(face, x, y, 0) + 1e-3F)
                << name(method);
        });
    }
}

}  // namespace
}  // namespace aureole::ibl
