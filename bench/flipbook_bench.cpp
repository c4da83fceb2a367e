// A new PSF from a flipbook against direct computation: 511x511 pixels for 1080p at 60 deg, an eye
// between frames (its halo blended of four, its streaks of eight).
#include <benchmark/benchmark.h>

#include "aureole/base/parallel.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/flipbook_bake.h"
#include "aureole/eye/flipbook_player.h"
#include "aureole/image/view.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

View view() { return View::from_fov(1920, 1080, 60, Projection::kPerspective); }
wave::KernelGrid raster() { return wave::KernelGrid::square(view(), 511); }

eye::Eye now() {
    eye::Eye eye;
    eye.pupil_diameter_mm = 6.2;
    eye.pose.lash_closure = 0.2;
    eye.eyelid = 0.1;
    return eye;
}

const eye::Flipbook& book() {
    static const std::vector<std::byte> bytes = [] {
        eye::FlipbookRange range;
        range.pupil_from_mm = 6;
        range.pupil_to_mm = 7;
        range.texture_pupils = 1;
        range.lens_states = 1;
        range.vitreous_phases = 1;
        range.halo_pupils = 2;
        range.streak_pupils = 2;
        range.lid_states = 3;
        return eye::bake_flipbook(eye::Eye(), raster(), range);
    }();
    static const eye::Flipbook flipbook(bytes);
    return flipbook;
}

void direct(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(eye::eye_psf(now(), raster()));
}
BENCHMARK(direct)->Unit(benchmark::kMillisecond)->UseRealTime();

void play(benchmark::State& state, const wave::KernelGrid& grid) {
    eye::FlipbookPlayer player(book(), eye::Eye(), {}, grid);
    wave::Psf psf;
    psf.kernel = Image(grid.width, grid.height, 3);
    const eye::Eye eye = now();
    for (auto _ : state) {
        player.write(eye, psf);
        benchmark::DoNotOptimize(psf.kernel.plane(0)[0]);
    }
}
BENCHMARK_CAPTURE(play, raster, raster())->Unit(benchmark::kMillisecond)->UseRealTime();
// The kernel that reaches from any pixel of the picture to any other, 3839x2159.
BENCHMARK_CAPTURE(play, full_reach, wave::KernelGrid::full_reach(view()))
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

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
