#include "aureole/ibl/filter_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/ibl/prefilter.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

CubeMap filtered(const CubeMap& environment, double roughness) {
    PrefilterOptions options;
    options.roughness = {0, roughness};
    options.method = FilterMethod::kExact;
    Prefilter prefilter(environment.size(), options);
    CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain);
    return chain[1];
}

void scale(CubeMap& map, float factor) {
    Image& pixels = map.stacked();
    for (std::size_t i = 0; i < 3 * pixels.pixels(); ++i) pixels.plane(0)[i] *= factor;
}

TEST(FilterError, OfTheExactLevelIsNone) {
    const CubeMap environment = sun_environment(32);
    const ExactFilter exact(environment);
    for (const double roughness : {0.2, 0.6}) {
        const auto error = measure_filter_error(exact, filtered(environment, roughness),
                                                roughness * roughness, {.texels = 64});
        EXPECT_LT(error.rms, 1e-4) << roughness;
        EXPECT_LT(std::abs(error.bias), 1e-4);
    }
}

// Everything 1 % too bright is a bias of 1 % of the mean.
TEST(FilterError, SeesABias) {
    const CubeMap environment = overcast_environment(16);
    CubeMap level = filtered(environment, 0.7);
    scale(level, 1.01F);
    const auto error =
        measure_filter_error(ExactFilter(environment), level, 0.49, {.texels = 6 * 8 * 8});
    EXPECT_EQ(error.texels, 6 * 8 * 8);
    EXPECT_NEAR(error.bias, 0.0099, 2e-4);
    EXPECT_GE(error.rms, error.bias);
    EXPECT_GE(error.most, error.rms);
}

// The sample against all texels: one texel of a sun's lobe is wrong, where few even draws fall.
TEST(FilterError, SampleAgreesWithAllTexels) {
    const CubeMap environment = sun_environment(32);
    const ExactFilter exact(environment);
    CubeMap level = filtered(environment, 0.25);
    for (std::size_t i = 0; i < 3 * level.stacked().pixels(); ++i) {
        float& value = level.stacked().plane(0)[i];
        value += 1e-3F * value;
    }
    const double all = measure_filter_error(exact, level, 0.0625, {.texels = 6 * 16 * 16}).rms;
    double mean_square = 0;
    constexpr int kRuns = 8;
    for (int seed = 1; seed <= kRuns; ++seed) {
        const auto error = measure_filter_error(
            exact, level, 0.0625, {.texels = 200, .seed = static_cast<std::uint64_t>(seed)});
        EXPECT_NEAR(error.rms / all, 1, 0.25) << seed;
        mean_square += error.rms * error.rms / kRuns;
    }
    EXPECT_NEAR(std::sqrt(mean_square) / all, 1, 0.08);
}

TEST(FilterError, RefusesWhatMakesNoSense) {
    const CubeMap map(4);
    const ExactFilter exact(map);
    EXPECT_THROW(measure_filter_error(exact, {}, 0.5), InvalidArgument);
    EXPECT_THROW(measure_filter_error(exact, map, 0), InvalidArgument);
    EXPECT_THROW(measure_filter_error(exact, map, 0.5, {.texels = 0}), InvalidArgument);
    EXPECT_EQ(measure_filter_error(exact, map, 0.5).rms, 0);  // a black environment
}

}  // namespace
}  // namespace aureole::ibl
