#include "aureole/wave/field_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "aureole/base/smoothstep.h"
#include "aureole/base/units.h"

namespace aureole::wave {
namespace {

constexpr double kOverlap = 0.25;

int nodes_over(int pixels, double spacing_px) {
    return std::min(pixels, 1 + static_cast<int>(std::ceil((pixels - 1) / spacing_px)));
}

// In pixel positions: node 0 in the middle of the first pixel.
double place(int node, int nodes, int pixels) {
    return nodes == 1 ? pixels / 2.0 : 0.5 + static_cast<double>(node) * (pixels - 1) / (nodes - 1);
}

}  // namespace

NodePlaces node_places(const View& view, double spacing_deg) {
    const double spacing_px = spacing_deg / view.pitch_deg;
    NodePlaces nodes{nodes_over(view.width, spacing_px), nodes_over(view.height, spacing_px), {}};
    for (int j = 0; j < nodes.rows; ++j) {
        for (int i = 0; i < nodes.columns; ++i) {
            nodes.places.push_back(
                {place(i, nodes.columns, view.width), place(j, nodes.rows, view.height)});
        }
    }
    return nodes;
}

KernelGrid grid_within(const View& view, double angle_deg) {
    const double angle = rad_from_deg(angle_deg);
    const double radius_px =
        view.focal_length_px() *
        (view.projection == Projection::kPerspective ? std::tan(angle) : angle);
    const int side = 2 * static_cast<int>(std::ceil(radius_px)) + 1;
    KernelGrid grid = KernelGrid::full_reach(view);
    grid.width = std::min(grid.width, side);
    grid.height = std::min(grid.height, side);
    return grid;
}

Image radial_window(const KernelGrid& grid, double end_deg) {
    Image window(grid.width, grid.height, 1);
    const View view = grid.view();
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const double angle_deg = view.angle_from_axis_deg(x + 0.5, y + 0.5);
            window.at(x, y) = static_cast<float>(smoothstep(0, kOverlap, 1 - angle_deg / end_deg));
        }
    }
    return window;
}

Image radial_ring(const KernelGrid& grid, double from_deg, double end_deg) {
    const Image inner = radial_window(grid, from_deg);
    Image ring = radial_window(grid, end_deg);
    for (std::size_t i = 0; i < ring.pixels(); ++i) ring.plane(0)[i] *= 1 - inner.plane(0)[i];
    return ring;
}

Image windowed(const Image& kernel, const Image& window, double scale) {
    Image result(window.width(), window.height(), 3);
    const int shift_x = kernel.width() / 2 - window.width() / 2;
    const int shift_y = kernel.height() / 2 - window.height() / 2;
    for (int c = 0; c < 3; ++c) {
        for (int y = std::max(0, -shift_y); y < window.height() - std::max(0, -shift_y); ++y) {
            for (int x = std::max(0, -shift_x); x < window.width() - std::max(0, -shift_x); ++x) {
                result.at(x, y, c) = static_cast<float>(scale) * window.at(x, y) *
                                     kernel.at(x + shift_x, y + shift_y, c);
            }
        }
    }
    return result;
}

void take_out(Psf& psf, const Image& part) {
    const int x0 = (psf.kernel.width() - part.width()) / 2;
    const int y0 = (psf.kernel.height() - part.height()) / 2;
    for (int c = 0; c < 3; ++c) {
        double taken = 0;
        for (int y = 0; y < part.height(); ++y) {
            float* from = psf.kernel.row(y0 + y, c) + x0;
            for (int x = 0; x < part.width(); ++x) {
                const float value = std::min(from[x], part.at(x, y, c));  // but for rounding, part
                taken += static_cast<double>(value);
                from[x] -= value;
            }
        }
        const double up = 1 / (1 - taken);
        std::for_each_n(psf.kernel.plane(c), psf.kernel.pixels(),
                        [factor = static_cast<float>(up)](float& value) { value *= factor; });
        psf.off_kernel_energy[static_cast<std::size_t>(c)] *= up;
    }
}

}  // namespace aureole::wave
