// Prefiltering an environment by sampling: the reference, filtered importance sampling, and what
// computing everything beforehand saves; sizes and sample counts of the document's table of times.
// Six levels, the first of which is a copy; roughness rises evenly.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/ibl/prefilter.h"
#include "aureole/ibl/progressive.h"
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

ibl::ProgressiveOptions progressive_options(int size) {
    ibl::ProgressiveOptions options;
    options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kLinear, kLevels, size);
    options.samples = 4096;
    return options;
}

// One pass of 32 samples.
void pass(benchmark::State& state, int size) {
    ibl::ProgressiveFilter progressive(size, progressive_options(size));
    const ibl::CubeMap environment = noise(size);
    progressive.set_environment(environment);
    for (auto _ : state) {
        if (progressive.converged()) {
            state.PauseTiming();
            progressive.set_environment(environment);
            state.ResumeTiming();
        }
        progressive.advance(32);
    }
}

void reset(benchmark::State& state, int size) {
    ibl::ProgressiveFilter progressive(size, progressive_options(size));
    const ibl::CubeMap environment = noise(size);
    for (auto _ : state) progressive.set_environment(environment);
}

// How long frames are that ask for 1 ms: the 99th percentile and the longest.
void frame(benchmark::State& state, int size) {
    ibl::ProgressiveFilter progressive(size, progressive_options(size));
    const ibl::CubeMap environment = noise(size);
    std::vector<double> times;
    for (auto _ : state) {
        if (progressive.converged()) progressive.set_environment(environment);
        const auto start = std::chrono::steady_clock::now();
        progressive.advance_for(1);
        const std::chrono::duration<double, std::milli> spent =
            std::chrono::steady_clock::now() - start;
        times.push_back(spent.count());
        state.SetIterationTime(spent.count() / 1000);
    }
    std::sort(times.begin(), times.end());
    state.counters["p99_ms"] = times[times.size() * 99 / 100];
    state.counters["longest_ms"] = times.back();
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
        const auto add_progressive = [&](const char* name, void (*run)(benchmark::State&, int)) {
            const std::string full =
                std::string("progressive_") + name + "/" + std::to_string(size);
            return benchmark::RegisterBenchmark(full.c_str(), run, size)
                ->Unit(benchmark::kMillisecond);
        };
        add_progressive("reset", reset)->UseRealTime();
        add_progressive("pass", pass)->UseRealTime();
        add_progressive("frame", frame)->UseManualTime();
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
