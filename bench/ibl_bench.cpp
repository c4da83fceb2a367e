// Prefiltering of an environment of 256 texels per side, five levels as Filament has them, on one
// thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "aureole/base/parallel.h"
#include "aureole/ibl/prefilter.h"
#include "aureole/ibl/roughness.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

constexpr int kSize = 256;
constexpr int kLevels = 5;

// A sky with a sun of one texel, over a checkered floor.
ibl::CubeMap sunny_environment(int size) {
    ibl::CubeMap map(size);
    for (int face = 0; face < ibl::kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const ibl::Direction d = ibl::texel_direction(face, x, y, size);
                const bool tile =
                    (std::lround(4 * d.x / d.y) + std::lround(4 * d.z / d.y)) % 2 == 0;
                const double value = d.y > 0 ? 1.5 - d.y : tile ? 0.4 : 0.05;
                for (int c = 0; c < 3; ++c) map.at(face, x, y, c) = static_cast<float>(value);
            }
        }
    }
    for (int c = 0; c < 3; ++c) map.at(0, size / 3, size / 4, c) = 3e5F;
    return map;
}

void prefilter(benchmark::State& state, const ibl::PrefilterOptions& options) {
    const ibl::CubeMap environment = sunny_environment(kSize);
    ibl::Prefilter filter(kSize, options);
    ibl::CubeChain chain = filter.make_chain();
    for (auto _ : state) filter.run(environment, chain);
}

void register_all() {
    ibl::PrefilterOptions options;
    options.roughness = ibl::level_roughness(ibl::RoughnessMapping::kFilament, kLevels, kSize);
    for (const auto quality :
         {ibl::FilterQuality::kDraft, ibl::FilterQuality::kNormal, ibl::FilterQuality::kHigh}) {
        options.quality = quality;
        const std::string name =
            "gather/" + std::string(ibl::kFilterQualityNames[static_cast<std::size_t>(quality)]);
        benchmark::RegisterBenchmark(name.c_str(), prefilter, options)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    options.method = ibl::FilterMethod::kPrecomputed;
    for (const int samples : {32, 128}) {
        options.samples = {samples};
        const std::string name = "precomputed/" + std::to_string(samples);
        benchmark::RegisterBenchmark(name.c_str(), prefilter, options)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
}

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    aureole::bench::take_simd_option(argc, argv);
    const aureole::ThreadLimit one(1);
    aureole::bench::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
