// What the methods of prefilter.h promise of each other.
#include "aureole/ibl/prefilter.h"

#include <gtest/gtest.h>

#include "aureole/ibl/roughness.h"
#include "ibl/filter_checks.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

CubeChain filtered(const CubeMap& environment, PrefilterOptions options, FilterMethod method) {
    options.method = method;
    Prefilter prefilter(environment.size(), options);
    CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain);
    return chain;
}

TEST(Prefilter, GatherIsCloserThan128PrecomputedSamples) {
    constexpr int kSize = 64;
    PrefilterOptions options;
    options.roughness = level_roughness(RoughnessMapping::kFilament, 4, kSize);
    options.samples = {128};
    for (const CubeMap& environment :
         {overcast_environment(kSize), interior_environment(kSize), studio_environment(kSize),
          sun_environment(kSize), corner_texel_environment(kSize)}) {
        const FilterOracle oracle(environment);
        const CubeChain gather = filtered(environment, options, FilterMethod::kGather);
        const CubeChain sampled = filtered(environment, options, FilterMethod::kPrecomputed);
        for (std::size_t level = 1; level < gather.size(); ++level) {
            const LevelTruth truth(environment, oracle,
                                   alpha_from_roughness(options.roughness[level]), kSize >> level,
                                   40);
            EXPECT_LT(truth.rms_error(gather[level]), truth.rms_error(sampled[level])) << level;
        }
    }
}

}  // namespace
}  // namespace aureole::ibl
