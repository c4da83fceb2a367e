// Prefiltering an environment by sampling: the reference, filtered importance sampling, and what
// computing everything beforehand saves; sizes and sample counts of the document's table of times.
// Six levels, the first of which is a copy; roughness rises evenly.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/ibl/prefilter.h"
#include "aureole/ibl/roughness.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

constexpr int kLevels = 6;

// Content does not change what sampling costs.
ibl::CubeMap noise(int size) {
    ibl::CubeMap map(size);
    Random random(1);
    Image& pixels = map.stacked();
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < pixels.pixels(); ++i) {
            pixels.plane(c)[i] = static_cast<float>(random.log_uniform(0.01, 10));
        }
    }
    return map;
}

void filter(benchmark::State& state, ibl::FilterMethod method, int size,
            const std::vector<int>& samples) {
    ibl::PrefilterOptions options;
    options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kLinear, kLevels, size);
    options.method = method;
    options.samples = samples;
    ibl::Prefilter prefilter(size, options);
    const ibl::CubeMap environment = noise(size);
    ibl::CubeChain chain = prefilter.make_chain();
    prefilter.run(environment, chain);
    for (auto _ : state) prefilter.run(environment, chain);
}

void register_all() {
    using ibl::FilterMethod;
    const std::vector<int> varying = {1, 8, 32, 64, 128, 128};
    for (const int size : {256, 128}) {
        const auto add = [&](const char* name, FilterMethod method,
                             const std::vector<int>& samples) {
            const std::string full = std::string(name) + "/" + std::to_string(size);
            benchmark::RegisterBenchmark(full.c_str(), filter, method, size, samples)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        };
        add("reference_1024", FilterMethod::kReference, {1024});
        add("fis_32", FilterMethod::kFis, {32});
        add("precomputed_32", FilterMethod::kPrecomputed, {32});
        add("nl_weighted_32", FilterMethod::kNlWeighted, {32});
        add("fis_varying", FilterMethod::kFis, varying);
        add("precomputed_varying", FilterMethod::kPrecomputed, varying);
        add("nl_weighted_varying", FilterMethod::kNlWeighted, varying);
    }
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    aureole::bench::take_simd_option(argc, argv);
    const aureole::ThreadLimit two(2);
    aureole::bench::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
