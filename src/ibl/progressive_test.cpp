#include "aureole/ibl/progressive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/roughness.h"
#include "ibl/level_filter.h"
#include "ibl/shrink.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

constexpr SampleSequence kSequences[] = {SampleSequence::kHammersley, SampleSequence::kRotated,
                                         SampleSequence::kMultiJittered};

ProgressiveOptions options_for(int size, int levels, int samples) {
    ProgressiveOptions options;
    options.roughness = level_roughness(RoughnessMapping::kLinear, levels, size);
    options.samples = samples;
    return options;
}

void expect_same_bits(const CubeChain& a, const CubeChain& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
            const float* first = a[k].stacked().plane(c);
            ASSERT_TRUE(std::equal(first, first + a[k].stacked().pixels(), b[k].stacked().plane(c)))
                << "level " << k;
        }
    }
}

// Root mean square over a level, relative to its mean.
double difference(const CubeMap& a, const CubeMap& truth) {
    double sum2 = 0;
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < truth.stacked().pixels(); ++i) {
            const double t = static_cast<double>(truth.stacked().plane(c)[i]);
            const double off = static_cast<double>(a.stacked().plane(c)[i]) - t;
            sum2 += off * off;
            sum += t;
        }
    }
    const double values = 3 * static_cast<double>(truth.stacked().pixels());
    return std::sqrt(sum2 / values) / (sum / values);
}

// The sum over all texels of the environment, each cut in 3 x 3.
CubeMap quadrature(const CubeMap& environment, double alpha, int size) {
    constexpr int kCuts = 3;
    const int fine = environment.size() * kCuts;
    struct Part {
        Direction direction;
        double solid_angle = 0;
        const float* radiance = nullptr;
    };
    std::vector<Part> parts;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < fine; ++y) {
            for (int x = 0; x < fine; ++x) {
                parts.push_back({texel_direction(face, x, y, fine),
                                 texel_solid_angle_sr(x, y, fine),
                                 environment.row(face, y / kCuts, 0) + x / kCuts});
            }
        }
    }
    CubeMap out(size);
    const double a2 = alpha * alpha;
    const std::size_t plane = environment.stacked().pixels();
    parallel_for(static_cast<std::size_t>(kFaces * size * size), [&](std::size_t i, int) {
        const int face = static_cast<int>(i) / (size * size);
        const int y = static_cast<int>(i) / size % size;
        const int x = static_cast<int>(i) % size;
        const Direction n = texel_direction(face, x, y, size);
        double sum[3] = {};
        double weights = 0;
        for (const Part& part : parts) {
            const double mu = dot(n, part.direction);
            if (mu <= 0) continue;
            const double q = 1 - (1 - a2) * (1 + mu) / 2;
            const double weight = mu / (q * q) * part.solid_angle;
            weights += weight;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * part.radiance[c * plane];
        }
        for (int c = 0; c < 3; ++c) out.at(face, x, y, c) = static_cast<float>(sum[c] / weights);
    });
    return out;
}

CubeMap one_shot(const CubeMap& environment, double alpha, int size, int samples) {
    PrefilterOptions options;
    options.method = FilterMethod::kNlWeighted;
    const auto filter = make_sampling_filter(environment.size(), {{size, alpha, samples}}, options);
    filter->prepare(environment);
    CubeMap out(size);
    for (int i = 0; i < tile_count(size); ++i) filter->filter(0, tile_at(i, size), 0, out);
    return out;
}

TEST(Progressive, ErrorFallsToThatOfAllSamplesAtOnce) {
    constexpr int kSize = 32;
    constexpr int kSamples = 512;
    for (const CubeMap& environment :
         {overcast_environment(kSize), interior_environment(kSize), studio_environment(kSize)}) {
        const ProgressiveOptions options = options_for(kSize, 4, kSamples);
        for (const std::size_t level : {std::size_t{2}, std::size_t{3}}) {
            const double alpha = alpha_from_roughness(options.roughness[level]);
            const CubeMap truth = quadrature(environment, alpha, kSize >> level);
            const double at_once =
                difference(one_shot(environment, alpha, kSize >> level, kSamples), truth);
            ProgressiveFilter filter(kSize, options);
            filter.set_environment(environment);
            double before = 1e9;
            for (int done = 32; done <= kSamples; done *= 2) {
                filter.advance(done - filter.samples());
                EXPECT_EQ(filter.samples(), done);
                const double error = difference(filter.result()[level], truth);
                EXPECT_LT(error, before) << "level " << level << ", " << done;
                before = error;
            }
            EXPECT_LT(before, 1.001 * at_once);
        }
    }
}

TEST(Progressive, PassesOfAnySequenceAverageOut) {
    constexpr int kSize = 32;
    const CubeMap environment = interior_environment(kSize);
    const CubeMap truth = quadrature(environment, 1, kSize >> 3);
    for (const SampleSequence sequence : kSequences) {
        for (const SampleLevels levels : {SampleLevels::kFinal, SampleLevels::kGrowing}) {
            ProgressiveOptions options = options_for(kSize, 4, 2048);
            options.sequence = sequence;
            options.levels = levels;
            ProgressiveFilter filter(kSize, options);
            filter.set_environment(environment);
            filter.advance(32);
            const double first = difference(filter.result()[3], truth);
            filter.advance(2048);
            EXPECT_LT(difference(filter.result()[3], truth), 0.5 * first)
                << static_cast<int>(sequence) << " " << static_cast<int>(levels);
        }
    }
}

// The levels of few samples are coarser: less noise.
TEST(Progressive, GrowingLevelsBeginBetter) {
    constexpr int kSize = 32;
    const CubeMap environment = studio_environment(kSize);
    const CubeMap truth = quadrature(environment, 1, kSize >> 3);
    double error[2] = {};
    for (const SampleLevels levels : {SampleLevels::kFinal, SampleLevels::kGrowing}) {
        ProgressiveOptions options = options_for(kSize, 4, 2048);
        options.levels = levels;
        ProgressiveFilter filter(kSize, options);
        filter.set_environment(environment);
        filter.advance(32);
        error[static_cast<int>(levels)] = difference(filter.result()[3], truth);
    }
    EXPECT_LT(error[1], 0.7 * error[0]);
}

TEST(Progressive, ANewEnvironmentLeavesNoTraceOfTheOldOne) {
    for (const SampleSequence sequence : kSequences) {
        ProgressiveOptions options = options_for(32, 4, 96);
        options.sequence = sequence;
        ProgressiveFilter used(32, options);
        used.set_environment(sun_environment(32));
        used.advance(40);
        used.advance_for(0);
        ProgressiveFilter fresh(32, options);
        for (ProgressiveFilter* filter : {&used, &fresh}) {
            filter->set_environment(studio_environment(32));
        }
        EXPECT_EQ(used.samples(), 0);
        EXPECT_EQ(used.change(), 1);
        for (int i = 0; i < 4; ++i) {
            expect_same_bits(used.result(), fresh.result());
            used.advance(32);
            fresh.advance(32);
        }
        EXPECT_TRUE(used.converged());
    }
}

// To the bit, next to a texel so bright that rounding would show.
TEST(Progressive, OnePassIsTheFilterOfAsManySamples) {
    const CubeMap environment = corner_texel_environment(16);
    ProgressiveOptions options = options_for(16, 2, 64);
    options.sequence = SampleSequence::kRotated;
    options.samples_per_pass = 64;
    ProgressiveFilter filter(16, options);
    filter.set_environment(environment);
    filter.advance(64);
    expect_same_bits({filter.result()[1]}, {one_shot(environment, 1, 8, 64)});
}

// However it is cut in time, and with any number of threads.
TEST(Progressive, TheResultDependsOnSamplesOnly) {
    const CubeMap environment = interior_environment(64);
    const ProgressiveOptions options = options_for(64, 5, 128);
    ProgressiveFilter at_once(64, options);
    at_once.set_environment(environment);
    at_once.advance(128);
    EXPECT_TRUE(at_once.converged());
    {
        ProgressiveFilter little_by_little(64, options);
        little_by_little.set_environment(environment);
        int calls = 0;
        for (; !little_by_little.converged(); ++calls) little_by_little.advance_for(0);
        EXPECT_GT(calls, 8);
        expect_same_bits(little_by_little.result(), at_once.result());
    }
    {
        ProgressiveFilter mixed(64, options);
        mixed.set_environment(environment);
        mixed.advance_for(0);
        EXPECT_EQ(mixed.samples(), 0);
        mixed.advance(32);  // the rest of the first pass
        EXPECT_EQ(mixed.samples(), 32);
        mixed.advance(1000);
        EXPECT_EQ(mixed.samples(), 128);
        expect_same_bits(mixed.result(), at_once.result());
    }
    const ThreadLimit one(1);
    ProgressiveFilter alone(64, options);
    alone.set_environment(environment);
    alone.advance(128);
    expect_same_bits(alone.result(), at_once.result());
}

TEST(Progressive, KeepsAConstantAtAnyTime) {
    for (const SampleSequence sequence : kSequences) {
        ProgressiveOptions options = options_for(24, 3, 300);
        options.sequence = sequence;
        options.samples_per_pass = 7;
        ProgressiveFilter filter(24, options);
        filter.set_environment(constant_environment(24, {0.5F, 2, 40}));
        while (!filter.converged()) {
            for (const CubeMap& level : filter.result()) {
                for (std::size_t i = 0; i < level.stacked().pixels(); ++i) {
                    ASSERT_NEAR(level.stacked().plane(0)[i], 0.5, 5e-6);
                    ASSERT_NEAR(level.stacked().plane(2)[i], 40, 4e-4);
                }
            }
            filter.advance_for(0);
        }
        EXPECT_EQ(filter.samples(), 300);
    }
}

TEST(Progressive, StopsWhenTheResultNoLongerChanges) {
    ProgressiveOptions options = options_for(32, 4, 4096);
    options.tolerance = 0.01;
    ProgressiveFilter filter(32, options);
    filter.set_environment(interior_environment(32));
    EXPECT_EQ(filter.change(), 1);
    filter.advance(4096);
    EXPECT_TRUE(filter.converged());
    EXPECT_LT(filter.change(), 0.01);
    EXPECT_LT(filter.samples(), 4096);
    const int before = filter.samples();
    filter.advance(32);
    filter.advance_for(1);
    EXPECT_EQ(filter.samples(), before);
    // Nothing to average.
    filter.set_environment(constant_environment(32));
    filter.advance(4096);
    EXPECT_EQ(filter.samples(), 64);
}

TEST(Progressive, ShowsTheEnvironmentBeforeItHasSamples) {
    const CubeMap environment = interior_environment(32);
    ProgressiveOptions options = options_for(32, 3, 64);
    options.roughness = {0, 0, 1};
    ProgressiveFilter filter(32, options);
    EXPECT_EQ(filter.levels(), 3);
    filter.set_environment(environment);
    const auto expect_mean = [&](std::size_t level) {
        const CubeMap& map = filter.result()[level];
        CubeMap mean(map.size());
        for (int i = 0; i < tile_count(map.size()); ++i) {
            shrink_tile(environment, tile_at(i, map.size()), mean);
        }
        EXPECT_LT(difference(map, mean), 1e-6);
    };
    for (std::size_t level = 0; level < 3; ++level) expect_mean(level);
    filter.advance(64);
    // Mirrors stay.
    expect_mean(0);
    expect_mean(1);
}

TEST(Progressive, AMirrorIsFinalAtOnce) {
    ProgressiveOptions options;
    options.roughness = {0, 0};
    ProgressiveFilter filter(8, options);
    EXPECT_TRUE(filter.converged());
    filter.advance(100);
    EXPECT_EQ(filter.samples(), 0);
}

TEST(Progressive, RefusesWhatCannotBe) {
    const ProgressiveOptions good = options_for(32, 4, 64);
    const auto refused = [&](auto change) {
        ProgressiveOptions options = good;
        change(options);
        EXPECT_THROW(ProgressiveFilter(32, options), InvalidArgument);
    };
    EXPECT_THROW(ProgressiveFilter(0, good), InvalidArgument);
    EXPECT_THROW(ProgressiveFilter(4, good), InvalidArgument);  // 3 levels
    refused([](auto& o) { o.roughness.clear(); });
    refused([](auto& o) { o.roughness[1] = 1.5; });
    refused([](auto& o) { o.samples = 0; });
    refused([](auto& o) { o.samples = 70000; });
    refused([](auto& o) { o.samples_per_pass = 2000; });
    refused([](auto& o) { o.tolerance = -1; });
    refused([](auto& o) { o.fis_overlap = 0; });
    refused([](auto& o) { o.fis_bias = NAN; });
}

}  // namespace
}  // namespace aureole::ibl
