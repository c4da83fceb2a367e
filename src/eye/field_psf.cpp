#include "aureole/eye/field_psf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "eye/components.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

constexpr double kMostStreakShare = 0.5;
// Centre and rays overlap over the last part of the centre's radius, so that no edge shows between
// what is blended over fine and over coarse nodes.
constexpr double kOverlap = 0.25;
constexpr double kMostFieldDeg = 160;
// The centre's own raster: up to centre_deg the shortest wavelength must not have begun to fade
// (kStreaksFade), which leaves .65 of the band.
constexpr double kUnfadedShare = 0.6;
constexpr double kShortestNm = 380;
// How much coarser the nodes of the rays are.
constexpr double kRaySpacing = 4;

struct Streaks {
    Image kernel;      // of energy `share` over the whole band, 3 channels, on the patch reached
    double share = 0;  // of the light, in streaks
};

// The smallest even 7-smooth number of samples from `needed` on, `most` at most.
int raster_samples(double needed, int most) {
    for (int samples = 64; samples < most; samples += 2) {
        int rest = samples;
        for (const int prime : {2, 3, 5, 7}) {
            while (rest % prime == 0) rest /= prime;
        }
        if (rest == 1 && samples >= needed) return samples;
    }
    return most;
}

Streaks streaks(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
                const EyePsfOptions& options) {
    Components components(eye, grid, options, nullptr, nullptr, field);
    auto result = components.corona_and_streaks(false, eye.streaks > 0 && eye.eyelashes > 0);
    const double share = std::min(result.blocked_share * eye.streaks, kMostStreakShare);
    if (!result.streaks) {
        return {Image(components.patch().width, components.patch().height, 3), 0};
    }
    Image kernel = std::move(*result.streaks);
    for (std::size_t i = 0; i < 3 * kernel.pixels(); ++i) {
        kernel.plane(0)[i] *= static_cast<float>(share);
    }
    return {std::move(kernel), share};
}

// 1 towards the axis, 0 away from it, in between over the overlap.
Image centre_window(const wave::KernelGrid& grid, double centre_deg) {
    Image window(grid.width, grid.height, 1);
    const View view = grid.view();
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const double angle_deg = view.angle_from_axis_deg(x + 0.5, y + 0.5);
            const double t = std::clamp((1 - angle_deg / centre_deg) / kOverlap, 0.0, 1.0);
            window.at(x, y) = static_cast<float>(t * t * (3 - 2 * t));
        }
    }
    return window;
}

// kernel * scale * window, or with `outside` kernel * scale * (1 - window), on the middle of
// `grid`.
Image windowed(const Image& kernel, const Image& window, bool outside, double scale) {
    Image result(window.width(), window.height(), 3);
    const int shift_x = kernel.width() / 2 - window.width() / 2;
    const int shift_y = kernel.height() / 2 - window.height() / 2;
    for (int c = 0; c < 3; ++c) {
        for (int y = std::max(0, -shift_y); y < window.height() - std::max(0, -shift_y); ++y) {
            for (int x = std::max(0, -shift_x); x < window.width() - std::max(0, -shift_x); ++x) {
                const float share = outside ? 1 - window.at(x, y) : window.at(x, y);
                result.at(x, y, c) =
                    static_cast<float>(scale) * share * kernel.at(x + shift_x, y + shift_y, c);
            }
        }
    }
    return result;
}

// Odd, reaching `angle_deg` from the centre, no further than from pixel to pixel of the view.
wave::KernelGrid grid_within(const View& view, double angle_deg) {
    const wave::KernelGrid full = wave::KernelGrid::full_reach(view);
    const double angle = rad_from_deg(angle_deg);
    const double radius_px =
        view.focal_length_px() *
        (view.projection == Projection::kPerspective ? std::tan(angle) : angle);
    const int side = 2 * static_cast<int>(std::ceil(radius_px)) + 1;
    wave::KernelGrid grid = full;
    grid.width = std::min(full.width, side);
    grid.height = std::min(full.height, side);
    return grid;
}

int nodes_over(int pixels, double spacing_px) {
    return std::min(pixels, 1 + static_cast<int>(std::ceil((pixels - 1) / spacing_px)));
}

fourier::KernelNodes empty_nodes(const View& view, double spacing_deg) {
    const double spacing_px = spacing_deg / view.pitch_deg;
    return {nodes_over(view.width, spacing_px), nodes_over(view.height, spacing_px), {}};
}

void check(const View& view, const FieldPsfOptions& options) {
    const auto require = [](const char* what, double value, double low, double high) {
        if (value >= low && value <= high) return;
        throw InvalidArgument(what, fmt::format("{}", value),
                              fmt::format("must be {} to {} deg", low, high));
    };
    if (options.psf.spectral.by_color) {
        throw InvalidArgument("spectrum by colour", "on", "must be off where streaks vary");
    }
    require("spacing of the nodes", options.spacing_deg, 0.5, 30);
    require("centre of streaks", options.centre_deg, 0.2, 5);
    require("reach of streaks", options.reach_deg, options.centre_deg, 45);
    for (const double x : {0.0, static_cast<double>(view.width)}) {
        for (const double y : {0.0, static_cast<double>(view.height)}) {
            const FieldPosition corner = field_position(view, x, y);
            require("field of view", 2 * std::max(std::abs(corner.x_deg), std::abs(corner.y_deg)),
                    0, kMostFieldDeg);
        }
    }
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
    const Image patch = streaks(eye, field, grid, options).kernel;
    return windowed(patch, Image(grid.width, grid.height, 1), true, 1);
}

wave::VaryingPsf eye_field_psf(const Eye& eye, const View& view, const FieldPsfOptions& options,
                               Progress* progress) {
    check(eye);
    check(view, options);
    check_aperture(options.psf.aperture);
    wave::VaryingPsf result;
    result.view = view;

    const wave::KernelGrid centre_grid = grid_within(view, options.centre_deg);
    const wave::KernelGrid ray_grid = grid_within(view, options.reach_deg);
    EyePsfOptions centre_options = options.psf;
    // The band's half width: extent_mm sin / lambda samples.
    centre_options.aperture.samples = raster_samples(
        2 * options.psf.aperture.extent_mm * std::sin(rad_from_deg(options.centre_deg)) /
            mm_from_nm(kShortestNm) / kUnfadedShare,
        options.psf.aperture.samples);
    const Image centre_part = centre_window(centre_grid, options.centre_deg);
    const Image ray_part = centre_window(ray_grid, options.centre_deg);

    // Both rasters give energy relative to a band of their own: one factor between them.
    const Streaks axis = streaks(eye, {}, ray_grid, options.psf);
    double centre_scale = 1;
    if (axis.share > 0) {
        const Streaks fine = streaks(eye, {}, centre_grid, centre_options);
        centre_scale = plane_sums(windowed(axis.kernel, centre_part, false, 1))[1] /
                       plane_sums(windowed(fine.kernel, centre_part, false, 1))[1];
    }

    Eye rest = eye;
    rest.streaks = 0;
    // On the axis what streaks hold is taken from the scatter alone.
    rest.halo = std::min(20.0, eye.halo / (1 - axis.share));
    result.base = eye_psf(rest, wave::KernelGrid::full_reach(view), options.psf, progress);

    const auto fill = [&](double spacing_deg, const wave::KernelGrid& grid,
                          const EyePsfOptions& sampling, const Image& window, bool outside,
                          double scale) {
        fourier::KernelNodes part = empty_nodes(view, spacing_deg);
        const auto place = [](int node, int nodes, int pixels) {
            return nodes == 1 ? pixels / 2.0
                              : 0.5 + static_cast<double>(node) * (pixels - 1) / (nodes - 1);
        };
        for (int j = 0; j < part.rows; ++j) {
            for (int i = 0; i < part.columns; ++i) {
                const FieldPosition field = field_position(view, place(i, part.columns, view.width),
                                                           place(j, part.rows, view.height));
                part.halves.push_back(fourier::right_half(
                    windowed(streaks(eye, field, grid, sampling).kernel, window, outside, scale)));
            }
            if (progress == nullptr) continue;
            progress->report(outside ? "streaks: rays" : "streaks: centre", (j + 1.0) / part.rows);
            if (progress->cancelled()) throw Cancelled();
        }
        result.parts.push_back(std::move(part));
    };
    fill(options.spacing_deg, centre_grid, centre_options, centre_part, false, centre_scale);
    fill(kRaySpacing * options.spacing_deg, ray_grid, options.psf, ray_part, true, 1);
    return result;
}

}  // namespace aureole::eye
