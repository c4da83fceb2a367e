#include "aureole/eye/field_psf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/field_nodes.h"
#include "eye/field_checks.h"
#include "eye/field_streaks.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

// How much coarser the nodes of the rays are.
constexpr double kRaySpacing = 7;

void check(const View& view, const FieldPsfOptions& options) {
    if (options.rank < 0) {
        throw InvalidArgument("rank of streaks", fmt::format("{}", options.rank),
                              "must be at least 1, or 0 for the kernels themselves");
    }
    if (options.psf.spectral.by_color) {
        throw InvalidArgument("spectrum by colour", "on", "must be off where streaks vary");
    }
    require_deg("spacing of the nodes", options.spacing_deg, 0.5, 30);
    require_deg("centre of streaks", options.centre_deg, 0.2, 5);
    require_deg("reach of streaks", options.reach_deg, options.centre_deg, 45);
    check_field_of(view);
}

}  // namespace

FieldPosition field_position(const View& view, double x, double y) {
    const double u = (x - view.axis_x) / view.focal_length_px();
    const double v = (view.axis_y - y) / view.focal_length_px();
    if (view.projection == Projection::kPerspective) {
        return {deg_from_rad(std::atan(u)), deg_from_rad(std::atan(v))};
    }
    const double angle = std::hypot(u, v);
    const double stretch = angle > 0 ? std::tan(std::min(angle, kPi / 2 - 1e-6)) / angle : 1;
    return {deg_from_rad(std::atan(stretch * u)), deg_from_rad(std::atan(stretch * v))};
}

Image streaks_at(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
                 const EyePsfOptions& options) {
    check(eye);
    check(field);
    check_kernel(grid);
    check_aperture(options.aperture);
    return std::move(
        FieldStreaks(eye, grid, options.aperture, options.spectral).at({&field, 1}).front().kernel);
}

wave::VaryingPsf eye_field_psf(const Eye& eye, const View& view, const FieldPsfOptions& options,
                               Progress* progress) {
    check(eye);
    check(view, options);
    check_aperture(options.psf.aperture);
    wave::VaryingPsf result;
    result.view = view;

    const wave::KernelGrid centre_grid = wave::grid_within(view, options.centre_deg);
    const wave::KernelGrid ray_grid = wave::grid_within(view, options.reach_deg);
    const Image centre_part = wave::radial_window(centre_grid, options.centre_deg);
    const Image ray_part = wave::radial_ring(ray_grid, options.centre_deg, options.reach_deg);

    const SpectralSampling& spectrum = options.psf.spectral;
    FieldStreaks centre(eye, centre_grid,
                        streak_raster(eye, centre_grid, options.centre_deg, options.psf.aperture),
                        spectrum);
    FieldStreaks rays(eye, ray_grid,
                      streak_raster(eye, ray_grid, options.reach_deg, options.psf.aperture),
                      spectrum);
    // Both rasters give energy relative to a band of their own: one factor between them.
    const FieldPosition ahead;
    const FieldStreaks::Streaks axis = std::move(rays.at({&ahead, 1}).front());
    double centre_scale = 1;
    if (axis.share > 0) {
        const FieldStreaks::Streaks fine = std::move(centre.at({&ahead, 1}).front());
        centre_scale = plane_sums(wave::windowed(axis.kernel, centre_part))[1] /
                       plane_sums(wave::windowed(fine.kernel, centre_part))[1];
    }

    Eye rest = eye;
    rest.streaks = 0;
    // On the axis what streaks hold is taken from the scatter alone.
    rest.halo = std::min(20.0, eye.halo / (1 - axis.share));
    result.base = eye_psf(rest, wave::KernelGrid::full_reach(view), options.psf, progress);

    const auto fill = [&](const char* what, double spacing_deg, FieldStreaks& streaks,
                          const Image& window, double scale) {
        const wave::NodePlaces nodes = wave::node_places(view, spacing_deg);
        fourier::KernelNodes part{nodes.columns, nodes.rows, {}, {}};
        std::vector<FieldPosition> fields;
        for (const auto& place : nodes.places) {
            fields.push_back(field_position(view, place.x, place.y));
        }
        const std::span<const FieldPosition> all = fields;
        for (std::size_t first = 0; first < all.size(); first += 2) {
            const auto pair = all.subspan(first, std::min<std::size_t>(2, all.size() - first));
            for (const FieldStreaks::Streaks& light : streaks.at(pair)) {
                part.halves.push_back(
                    fourier::right_half(wave::windowed(light.kernel, window, scale)));
            }
            if (progress == nullptr) continue;
            progress->report(
                what, static_cast<double>(part.halves.size()) / static_cast<double>(all.size()));
            if (progress->cancelled()) throw Cancelled();
        }
        result.parts.push_back(options.rank == 0 ? std::move(part)
                                                 : principal_components(part, options.rank));
    };
    fill("streaks: centre", options.spacing_deg, centre, centre_part, centre_scale);
    fill("streaks: rays", kRaySpacing * options.spacing_deg, rays, ray_part, 1);
    return result;
}

}  // namespace aureole::eye
