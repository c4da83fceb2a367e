#include "aureole/eye/field_needles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/eye/field_psf.h"
#include "aureole/wave/field_nodes.h"
#include "eye/components.h"
#include "eye/corona_texture.h"
#include "eye/field_checks.h"
#include "eye/field_streaks.h"
#include "eye/kernel_checks.h"
#include "eye/scatter_pixels.h"

namespace aureole::eye {
namespace {

// Steps of the blend within a region.
constexpr int kBlendsPerRegion = 3;

void check_corona(const Eye& eye) {
    check(eye);
    const Anatomy& anatomy = eye.anatomy;
    const int particles = anatomy.lens_small.count + anatomy.lens_large.count +
                          anatomy.vitreous.count + anatomy.cornea.count;
    if (eye.scatter == ScatterModel::kNone || particles == 0 || eye.corona_contrast == 0) {
        throw InvalidArgument("corona", "none",
                              "needles by position need scatter, particles and a contrast above 0");
    }
}

void check(const View& view, const FieldNeedlesOptions& options) {
    if (options.psf.spectral.by_color) {
        throw InvalidArgument("spectrum by colour", "on", "must be off where needles vary");
    }
    require_deg("width of the regions", options.region_deg, 2, 60);
    require_deg("reach of the needles", options.reach_deg, 0.5, 10);
    check_field_of(view);
}

ScatterPixels scatter_of(const Eye& eye, const wave::KernelGrid& grid) {
    return {ScatterPsf(eye.scatter, eye.age_years, eye.pigmentation, eye.pupil_diameter_mm), grid};
}

Image needles(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
              const EyePsfOptions& options, const ScatterPixels& scatter) {
    Components components(eye, grid, options, nullptr, nullptr, field);
    const wave::KernelGrid& patch = components.patch();
    const std::optional<Image> corona = components.corona_and_streaks(true, false).corona;
    const Image smooth = scatter.image(grid.width, grid.height);
    Image result(grid.width, grid.height, 3);
    std::optional<Image> texture;  // none behind a lid that is closed from there
    if (corona) {
        texture =
            corona_texture(*corona, scatter.image(patch.width, patch.height), eye.corona_contrast);
    }
    const int x0 = (grid.width - patch.width) / 2;
    const int y0 = (grid.height - patch.height) / 2;
    for (int c = 0; c < 3; ++c) {
        std::copy_n(smooth.plane(0), smooth.pixels(), result.plane(c));
        for (int y = 0; texture && y < patch.height; ++y) {
            float* to = result.row(y0 + y, c) + x0;
            const float* factor = texture->row(y, c);
            for (int x = 0; x < patch.width; ++x) to[x] *= factor[x];
        }
        result.at(grid.width / 2, grid.height / 2, c) = 0;
    }
    return result;
}

void scale(Image& image, const std::array<double, 3>& factors) {
    for (int c = 0; c < 3; ++c) {
        const auto factor = static_cast<float>(factors[static_cast<std::size_t>(c)]);
        std::for_each_n(image.plane(c), image.pixels(), [&](float& value) { value *= factor; });
    }
}

// What the parts leave of a light at a pixel, mean of the colours.
double left_by(const wave::VaryingPsf& psf, const wave::NodePlaces::Place& place) {
    if (psf.parts.empty()) return 1;
    const View& view = psf.view;
    const auto pixel = [](double position, int size) {
        return std::clamp(static_cast<int>(position), 0, size - 1);
    };
    const std::vector<double> sums =
        plane_sums(fourier::kernel_at(psf.parts, view.width, view.height,
                                      pixel(place.x, view.width), pixel(place.y, view.height)));
    return 1 - (sums[0] + sums[1] + sums[2]) / 3;
}

// Index of the region that node i of `nodes` lies in.
int region_of(int i, int nodes, int regions) {
    if (nodes == 1) return 0;
    return static_cast<int>(std::lround(static_cast<double>(i) * (regions - 1) / (nodes - 1)));
}

}  // namespace

Image needles_at(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
                 const EyePsfOptions& options) {
    check_corona(eye);
    check(field);
    check_kernel(grid);
    check_aperture(options.aperture);
    return needles(eye, field, grid, options, scatter_of(eye, grid));
}

void vary_needles(wave::VaryingPsf& psf, const Eye& eye, const FieldNeedlesOptions& options,
                  Progress* progress) {
    check_corona(eye);
    check(psf.view, options);
    check_aperture(options.psf.aperture);
    const wave::KernelGrid grid = wave::grid_within(psf.view, options.reach_deg);
    const Image window = wave::radial_window(grid, options.reach_deg);
    const ScatterPixels scatter = scatter_of(eye, grid);

    // (1 - c) of eye_psf.h: nothing but scatter lies off the kernel.
    const double off = scatter_of(eye, psf.base.grid).off_kernel_energy();
    std::array<double, 3> rest = {};
    for (std::size_t c = 0; c < 3; ++c) rest[c] = psf.base.off_kernel_energy[c] / off;
    const auto part_of = [&](const FieldPosition& field, const EyePsfOptions& how) {
        Image part = wave::windowed(needles(eye, field, grid, how, scatter), window);
        scale(part, rest);
        return part;
    };
    const wave::NodePlaces regions = wave::node_places(psf.view, options.region_deg);
    const wave::NodePlaces nodes =
        wave::node_places(psf.view, options.region_deg / kBlendsPerRegion);
    EyePsfOptions within = options.psf;
    within.aperture = streak_raster(eye, grid, options.reach_deg, options.psf.aperture);
    fourier::KernelNodes part{nodes.columns, nodes.rows, {}, {}};
    for (const auto& place : regions.places) {
        part.halves.push_back(
            fourier::right_half(part_of(field_position(psf.view, place.x, place.y), within)));
        if (progress == nullptr) continue;
        progress->report("needles", static_cast<double>(part.halves.size()) /
                                        static_cast<double>(regions.places.size()));
        if (progress->cancelled()) throw Cancelled();
    }
    part.mixture.assign(nodes.places.size() * part.halves.size(), 0.0F);
    parallel_for(nodes.places.size(), [&](std::size_t n, int) {
        const int node = static_cast<int>(n);
        const int column = region_of(node % nodes.columns, nodes.columns, regions.columns);
        const int row = region_of(node / nodes.columns, nodes.rows, regions.rows);
        part.mixture[n * part.halves.size() +
                     static_cast<std::size_t>(row * regions.columns + column)] =
            static_cast<float>(left_by(psf, nodes.places[n]));
    });
    wave::take_out(psf.base, part_of({}, options.psf));
    psf.parts.push_back(std::move(part));
}

}  // namespace aureole::eye
