// Lens flares of one light in 1920x1080: the renderers, placement alone, and how many rays per
// second the SIMD tracer follows against the plain one that it is tested against.
#include <benchmark/benchmark.h>

#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/flare.h"
#include "aureole/lens/ghosts.h"
#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "simd_option.h"

namespace aureole::bench {
namespace {

constexpr int kWidth = 1920;
constexpr int kHeight = 1080;

// On a sensor 36 mm wide.
View view_of(const lens::Lens& lens) {
    return View::from_fov(kWidth, kHeight, 2 * deg_from_rad(std::atan(18 / lens.efl_mm())),
                          Projection::kPerspective);
}

sources::Light light_at_angle(const View& view, double angle_deg) {
    const double radius = view.focal_length_px() * std::tan(rad_from_deg(angle_deg));
    return sources::light_at(view, view.axis_x + 0.8 * radius, view.axis_y - 0.6 * radius,
                             {1e6F, 1e6F, 1e6F});
}

void render(benchmark::State& state, const char* name, double angle_deg,
            const lens::FlareOptions& options) {
    const lens::Lens lens{lens::shipped_lens(name)};
    const View view = view_of(lens);
    lens::Flare flare(lens, lens::Iris({.blades = 8}), view, options);
    sources::Light light = light_at_angle(view, angle_deg);
    Image out(kWidth, kHeight, 3);
    flare.render({&light, 1}, out);
    for (auto _ : state) {
        // So that nothing is known from the frame before.
        light.tan_x += 1e-6;
        flare.render({&light, 1}, out);
    }
    state.counters["ghosts"] = static_cast<double>(flare.report().ghosts.size());
    if (flare.report().rays > 0) {
        state.counters["rays"] = benchmark::Counter(static_cast<double>(flare.report().rays),
                                                    benchmark::Counter::kIsIterationInvariantRate);
    }
}

// Where all ghosts of a lens are and how bright, on one thread.
void place(benchmark::State& state, int blades) {
    const lens::Lens lens{lens::shipped_lens("nikon-28-75")};
    const View view = view_of(lens);
    lens::Flare flare(lens, lens::Iris({.blades = blades}), view,
                      {.method = lens::GhostMethod::kMatrix});
    const sources::Light light = light_at_angle(view, 10);
    for (auto _ : state) benchmark::DoNotOptimize(flare.place(light).data());
}

// One thread of the exact tracer in double precision, with throughput.
void plain_rays(benchmark::State& state) {
    const lens::Lens lens{lens::shipped_lens("biotar")};
    const lens::Tracer tracer(lens, 550);
    const auto ghosts = enumerate_ghosts(lens, lens::GhostSet::kAll);
    std::size_t rays = 0;
    for (auto _ : state) {
        for (const lens::Bounces& bounces : ghosts) {
            for (int i = 0; i < 16; ++i) {
                const lens::Ray ray = lens::ray_from_light(0.1, 0.1, i - 8, 0.5 * (i - 8));
                benchmark::DoNotOptimize(tracer.trace(bounces, ray));
                benchmark::DoNotOptimize(tracer.throughput(bounces, ray));
                ++rays;
            }
        }
    }
    state.counters["rays"] =
        benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

lens::FlareOptions with(lens::GhostMethod method, double energy_dropped) {
    lens::FlareOptions options;
    options.method = method;
    options.energy_dropped = energy_dropped;
    options.wavelengths = 3;
    return options;
}

void register_all() {
    using lens::GhostMethod;
    const auto add = [](const char* name, auto... arguments) {
        benchmark::RegisterBenchmark(name, render, arguments...)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    add("traced/biotar", "biotar", 10.0, with(GhostMethod::kTraced, 0));
    add("hybrid/biotar", "biotar", 10.0, with(GhostMethod::kHybrid, 1e-3));
    add("matrix/nikon-28-75", "nikon-28-75", 10.0, with(GhostMethod::kMatrix, 0));
    add("traced/nikon-28-75", "nikon-28-75", 10.0, with(GhostMethod::kTraced, 1e-3));
    add("hybrid/nikon-28-75", "nikon-28-75", 10.0, with(GhostMethod::kHybrid, 1e-3));
    for (const int blades : {0, 8}) {
        benchmark::RegisterBenchmark(blades == 0 ? "place/round" : "place/blades", place, blades)
            ->Unit(benchmark::kMicrosecond)
            ->UseRealTime();
    }
    benchmark::RegisterBenchmark("plain_rays", plain_rays)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
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
