#include "lens/starburst_pattern.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"
#include "aureole/wave/diffraction.h"

namespace aureole::lens {
namespace {

// The law takes over from the wide raster within the outer part of the ring that it was fitted to.
constexpr double kHandOver = 1.4142135623730951;
// A sample is read as evenly bright. Around the axis, where the pattern varies by its full height
// over lambda / opening, sixteen samples to that put .001 of the energy where it does not belong;
// farther out it only matters how much light there is. The core hands over from 16 to 32
// lambda / opening.
constexpr double kCoreWidth = 16;  // extent over opening
constexpr int kCoreSamples = 2048;
constexpr Crossover kCore = {kCoreWidth * 16, kCoreWidth * 32};

// The pattern of an aperture out to `end` samples, as energy per sample but for a common factor
// that is the same for all rasters of one aperture: |sum of t dx^2|^2 / extent^2.
AxisSquare square_around_axis(StarburstAperture aperture, double end) {
    wave::Field& field = aperture.field;
    const wave::ApertureGrid grid = field.grid;
    fourier::Fft2d fft(grid.samples, grid.samples);
    wave::transform(field, fft);
    const double area = grid.spacing_mm() * grid.spacing_mm();
    const double unit = area * area / (grid.extent_mm * grid.extent_mm);
    AxisSquare square;
    square.half = static_cast<int>(std::ceil(end)) + 1;
    const std::size_t side = square.side();
    square.power = Buffer(side * side);
    const auto n = static_cast<std::size_t>(grid.samples);
    const std::size_t first = n - static_cast<std::size_t>(square.half);
    parallel_for(side, [&](std::size_t j, int) {
        const auto gain = [&](std::size_t i) {
            const int distance = std::abs(static_cast<int>(i) - square.half);
            return aperture.gain[static_cast<std::size_t>(distance)];
        };
        const auto row_factor = static_cast<float>(unit * static_cast<double>(gain(j)));
        const float* re = field.re.data() + (first + j) % n * n;
        const float* im = field.im.data() + (first + j) % n * n;
        float* out = square.row(j);
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t k = (first + i) % n;
            out[i] = (re[k] * re[k] + im[k] * im[k]) * (gain(i) * row_factor);
        }
    });
    return square;
}

// Multiplies by weight(rho) and returns the sum.
template <class Weight>
double apply(AxisSquare& square, const Weight& weight) {
    std::vector<double> rows(square.side(), 0.0);
    parallel_for(rows.size(), [&](std::size_t j, int) {
        const double l = static_cast<double>(j) - square.half;
        float* row = square.row(j);
        double sum = 0;
        for (std::size_t i = 0; i < square.side(); ++i) {
            const double k = static_cast<double>(i) - square.half;
            row[i] *= static_cast<float>(weight(std::sqrt(k * k + l * l)));
            sum += static_cast<double>(row[i]);
        }
        rows[j] = sum;
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0);
}

// Integral of 1 - before(rho) over rho^-2 from `full` to infinity: what the law holds of a profile
// of turn 1. Simpson's rule in log rho.
double share_beyond(const Crossover& crossover) {
    constexpr int kSteps = 256;
    const double step = std::log(crossover.end / crossover.full) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double rho = crossover.full * std::exp(i * step);
        const int factor = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += factor * (1 - crossover.before(rho)) / rho;
    }
    return sum * step / 3 + 1 / crossover.end;
}

// Across an edge: half a blade from a corner.
double first_spike_rad(const IrisShape& shape) {
    return rad_from_deg(shape.rotation_deg) + kPi / shape.blades;
}

bool has_straight_blades(const Iris& iris) {
    return !iris.is_image() && iris.shape().blades > 0 && iris.shape().curvature == 0 &&
           iris.shape().smoothing == 0;
}

SpikeProfile spikes_from(AngularProfile profile, const Iris& iris, double pupil_diameter_mm,
                         const RasterPlan& plan) {
    const IrisShape& shape = iris.shape();
    // An edge of length l makes a spike lambda / l to either side.
    const double edge_mm = pupil_diameter_mm * iris.outer_radius() * std::sin(kPi / shape.blades);
    const double width = plan.grid.extent_mm / edge_mm;
    // Of an odd number of blades, the light that each sends backwards falls between the others.
    return {std::move(profile), first_spike_rad(shape),
            (shape.blades % 2 == 0 ? 2 : 1) * kPi / shape.blades,
            width / fitted_at(plan.end_samples)};
}

PatternRaster raster(AxisSquare square, double factor, double extent_mm, double end) {
    apply(square, [factor](double) { return factor; });
    return {wave::PatternIntegral(square.power.data(), static_cast<int>(square.side())), extent_mm,
            end};
}

}  // namespace

double Crossover::before(double rho) const {
    if (rho <= full) return 1;
    if (rho >= end) return 0;
    return 1 - smoothstep(0, std::log(end / full), std::log(rho / full));
}

StarburstPattern starburst_pattern(const Iris& iris, double pupil_diameter_mm,
                                   const RasterPlan& plan, const Obstacles& obstacles) {
    const double opening_mm = pupil_diameter_mm * iris.outer_radius();
    const Crossover crossover{plan.end_samples / kHandOver, plan.end_samples};
    const double core_extent_mm = kCoreWidth * opening_mm;
    const double wide_per_core = plan.grid.extent_mm / core_extent_mm;  // samples per sample
    const bool with_core = wide_per_core < 1;

    AxisSquare wide = square_around_axis(
        draw_aperture(iris, pupil_diameter_mm, plan.grid, obstacles), plan.end_samples);
    AngularProfile beyond = AngularProfile::of(wide, plan.end_samples);
    double total = share_beyond(crossover) * beyond.turn();
    SpikeProfile spikes;
    if (has_straight_blades(iris)) {
        AngularProfile blades;
        if (obstacles.none()) {
            std::swap(blades, beyond);
        } else {
            const AxisSquare clean = square_around_axis(
                draw_aperture(iris, pupil_diameter_mm, plan.grid, {}), plan.end_samples);
            blades = AngularProfile::of(clean, plan.end_samples);
            beyond.take_out(blades, first_spike_rad(iris.shape()));
        }
        spikes = spikes_from(std::move(blades), iris, pupil_diameter_mm, plan);
    }
    total += apply(wide, [&](double rho) {
        return crossover.before(rho) * (with_core ? 1 - kCore.before(rho / wide_per_core) : 1);
    });
    std::optional<AxisSquare> core;
    if (with_core) {
        core = square_around_axis(
            draw_aperture(iris, pupil_diameter_mm, {kCoreSamples, core_extent_mm}, obstacles),
            kCore.end);
        total += apply(*core, [](double rho) { return kCore.before(rho); });
    }
    beyond.multiply(1 / total);
    spikes.multiply(1 / total);
    StarburstPattern pattern{
        std::nullopt, raster(std::move(wide), 1 / total, plan.grid.extent_mm, plan.end_samples),
        crossover, std::move(spikes), std::move(beyond)};
    if (core) pattern.core = raster(std::move(*core), 1 / total, core_extent_mm, kCore.end);
    return pattern;
}

}  // namespace aureole::lens
