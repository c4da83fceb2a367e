#include "aureole/lens/field_starburst.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/wave/field_nodes.h"
#include "lens/starburst_behind.h"

namespace aureole::lens {
namespace {

void check(const FieldStarburstOptions& options) {
    const auto require = [](const char* what, double value, double low, double high) {
        if (value >= low && value <= high) return;
        throw InvalidArgument(what, fmt::format("{}", value),
                              fmt::format("must be {} to {} deg", low, high));
    };
    require("spacing of the nodes", options.spacing_deg, 0.5, 30);
    require("reach of varying stars", options.reach_deg, 0.2, 45);
    if (options.rank < 0) {
        throw InvalidArgument("rank of stars", fmt::format("{}", options.rank),
                              "must be at least 1, or 0 for the kernels themselves");
    }
}

// Tangents, to the right and up, of the direction of a pixel position.
std::array<double, 2> direction(const View& view, double x, double y) {
    const double u = (x - view.axis_x) / view.focal_length_px();
    const double v = (view.axis_y - y) / view.focal_length_px();
    const double angle = std::hypot(u, v);
    const double stretch =
        view.projection == Projection::kPerspective || angle == 0 ? 1 : std::tan(angle) / angle;
    return {stretch * u, stretch * v};
}

// The star of the axis beyond the reach, as a kernel of unit energy.
wave::Psf far_part(wave::Psf axis, const Image& window) {
    const int x0 = (axis.kernel.width() - window.width()) / 2;
    const int y0 = (axis.kernel.height() - window.height()) / 2;
    for (int c = 0; c < 3; ++c) {
        double left = axis.off_kernel_energy[static_cast<std::size_t>(c)];
        for (int y = 0; y < axis.kernel.height(); ++y) {
            for (int x = 0; x < axis.kernel.width(); ++x) {
                const int wx = x - x0;
                const int wy = y - y0;
                float& value = axis.kernel.at(x, y, c);
                if (wx >= 0 && wy >= 0 && wx < window.width() && wy < window.height()) {
                    value *= 1 - window.at(wx, wy);
                }
                left += static_cast<double>(value);
            }
        }
        for (int y = 0; y < axis.kernel.height(); ++y) {
            for (int x = 0; x < axis.kernel.width(); ++x) {
                axis.kernel.at(x, y, c) /= static_cast<float>(left);
            }
        }
        axis.off_kernel_energy[static_cast<std::size_t>(c)] /= left;
    }
    return axis;
}

}  // namespace

wave::VaryingPsf field_starburst(const Lens& lens, const Iris& iris, double pupil_diameter_mm,
                                 const View& view, const FieldStarburstOptions& options,
                                 Progress* progress) {
    check(options);
    const wave::KernelGrid grid = wave::grid_within(view, options.reach_deg);
    const Image window = wave::radial_window(grid, options.reach_deg);
    wave::VaryingPsf result;
    result.view = view;
    result.base = far_part(
        starburst_psf(iris, pupil_diameter_mm, wave::KernelGrid::full_reach(view), options.psf),
        window);

    const wave::NodePlaces nodes = wave::node_places(view, options.spacing_deg);
    fourier::KernelNodes part{nodes.columns, nodes.rows, {}, {}};
    for (const auto& place : nodes.places) {
        const auto [tan_x, tan_y] = direction(view, place.x, place.y);
        const std::optional<wave::Shape> outline = pupil_outline(lens, iris, tan_x, tan_y);
        const wave::Psf star = starburst_behind(iris, pupil_diameter_mm, grid, options.psf,
                                                {nullptr, outline ? &*outline : nullptr});
        part.halves.push_back(fourier::right_half(wave::windowed(star.kernel, window)));
        if (progress == nullptr) continue;
        progress->report("stars over the field", static_cast<double>(part.halves.size()) /
                                                     static_cast<double>(nodes.places.size()));
        if (progress->cancelled()) throw Cancelled();
    }
    result.parts.push_back(options.rank == 0 ? std::move(part)
                                             : principal_components(part, options.rank));
    return result;
}

}  // namespace aureole::lens
