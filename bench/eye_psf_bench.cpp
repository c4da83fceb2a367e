// The point spread function of an eye (1025x1025 pixels for 1080p at 60 deg, three apertures of
// 4096x4096, masks drawn) against one complex FFTW transform of 4096x4096.
#include <benchmark/benchmark.h>

#include "aureole/base/parallel.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/image/view.h"
#include "fftw_baseline.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

void eye_psf(benchmark::State& state) {
    const View view = View::from_fov(1920, 1080, 60, Projection::kPerspective);
    eye::Eye eye;
    eye.pupil_diameter_mm = 6;  // wide enough for all three components
    eye::EyePsfOptions options;
    options.spectral.bands = static_cast<int>(state.range(0));
    eye::EyePsfTimings timings;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            eye::eye_psf(eye, wave::KernelGrid::square(view, 1025), options, nullptr, &timings));
    }
    state.counters["draw"] = timings.draw;
    state.counters["transform"] = timings.transform;
    state.counters["pattern"] = timings.pattern;
    state.counters["spectral"] = timings.spectral;
    state.counters["scatter"] = timings.scatter;
}
// 0: the default sampling, adapted to the radius; 64: bands everywhere.
BENCHMARK(eye_psf)->Arg(0)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

void fftw_4096(benchmark::State& state) {
    FftwSquare fftw(4096);
    for (auto _ : state) fftw.run();
}
BENCHMARK(fftw_4096)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace aureole::bench

int main(int argc, char** argv) {
    aureole::bench::take_simd_option(argc, argv);
    const aureole::ThreadLimit limit(2);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
