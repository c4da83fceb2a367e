#include "eye/scatter_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "eye/quadrature.h"

namespace aureole::eye {
namespace {

// Relative error at which the subdivision of a pixel stops, and the most times it halves.
constexpr double kPixelTolerance = 1e-6;
constexpr int kMaxHalvings = 14;

// The table's nodes divide every octave of the squared distance into 1024 equal steps, so that a
// node is the leading bits of the float: linear interpolation of rho^-3 is then off by 4e-7.
constexpr int kStepBits = 10;
constexpr int kDroppedBits = 23 - kStepBits;
constexpr std::uint32_t kFractionMask = (1U << kDroppedBits) - 1;

std::uint32_t table_node(float squared) {
    return std::bit_cast<std::uint32_t>(squared) >> kDroppedBits;
}
float node_value(std::uint32_t node) { return std::bit_cast<float>(node << kDroppedBits); }

// The mean of a smooth function over a rectangle, by halving both sides until quarters agree with
// their whole.
template <class Function>
double adaptive_mean(const Function& f, double x0, double x1, double y0, double y1, double whole,
                     int halvings) {
    const double xm = 0.5 * (x0 + x1);
    const double ym = 0.5 * (y0 + y1);
    const double a = gauss_legendre_mean(f, x0, xm, y0, ym);
    const double b = gauss_legendre_mean(f, xm, x1, y0, ym);
    const double c = gauss_legendre_mean(f, x0, xm, ym, y1);
    const double d = gauss_legendre_mean(f, xm, x1, ym, y1);
    const double refined = 0.25 * (a + b + c + d);
    if (halvings == 0 || std::abs(refined - whole) <= kPixelTolerance * std::abs(refined)) {
        return refined;
    }
    return 0.25 * (adaptive_mean(f, x0, xm, y0, ym, a, halvings - 1) +
                   adaptive_mean(f, xm, x1, y0, ym, b, halvings - 1) +
                   adaptive_mean(f, x0, xm, ym, y1, c, halvings - 1) +
                   adaptive_mean(f, xm, x1, ym, y1, d, halvings - 1));
}

}  // namespace

ScatterPixels::ScatterPixels(const ScatterPsf& scatter, const wave::KernelGrid& grid)
    : scatter_(scatter),
      grid_(grid),
      focal_length_px_(grid.view().focal_length_px()),
      off_kernel_energy_(energy_outside(0.5 * grid.width, 0.5 * grid.height)) {
    constexpr int kSide = kExactRadius + 1;
    near_.resize(static_cast<std::size_t>(kSide) * kSide);
    parallel_for(kSide, [&](std::size_t y, int) {
        for (std::size_t x = 0; x <= y; ++x) {
            const auto energy =
                static_cast<float>(exact_pixel(static_cast<int>(x), static_cast<int>(y)));
            near_[y * kSide + x] = energy;
            near_[x * kSide + y] = energy;
        }
    });
    tabulate(0.5 * std::hypot(grid.width, grid.height));
}

double ScatterPixels::angle_deg(double rho_px) const {
    const double ratio = rho_px / focal_length_px_;
    return deg_from_rad(grid_.projection == Projection::kPerspective ? std::atan(ratio) : ratio);
}

double ScatterPixels::per_pixel_area(double rho_px) const {
    const double theta_deg = angle_deg(rho_px);
    const double theta = rad_from_deg(theta_deg);
    const double cosine = std::cos(theta);
    const double squeeze = grid_.projection == Projection::kPerspective ? cosine * cosine * cosine
                           : theta > 0                                  ? std::sin(theta) / theta
                                                                        : 1.0;
    return scatter_.per_sr(theta_deg) * squeeze / (focal_length_px_ * focal_length_px_);
}

// In polar coordinates about the source: (1 / 2 pi) integral over phi of the energy beyond the
// edge of the rectangle in that direction. The edge has a corner, where the integral is split.
double ScatterPixels::energy_outside(double half_width_px, double half_height_px) const {
    const double corner = std::atan2(half_height_px, half_width_px);
    constexpr int kIntervals = 12;
    const auto beyond_side = [&](double phi) {
        return scatter_.energy_beyond(angle_deg(half_width_px / std::cos(phi)));
    };
    const auto beyond_top = [&](double phi) {
        return scatter_.energy_beyond(angle_deg(half_height_px / std::sin(phi)));
    };
    double sum = 0;
    for (int i = 0; i < kIntervals; ++i) {
        const double low = static_cast<double>(i) / kIntervals;
        const double high = static_cast<double>(i + 1) / kIntervals;
        sum += gauss_legendre(beyond_side, corner * low, corner * high);
        sum += gauss_legendre(beyond_top, corner + (kPi / 2 - corner) * low,
                              corner + (kPi / 2 - corner) * high);
    }
    return sum / (kPi / 2);
}

double ScatterPixels::exact_pixel(int dx, int dy) const {
    if (dx == 0 && dy == 0) return 1 - energy_outside(0.5, 0.5);
    const auto density = [&](double x, double y) { return per_pixel_area(std::hypot(x, y)); };
    const double whole = gauss_legendre_mean(density, dx - 0.5, dx + 0.5, dy - 0.5, dy + 0.5);
    return adaptive_mean(density, dx - 0.5, dx + 0.5, dy - 0.5, dy + 0.5, whole, kMaxHalvings);
}

// The mean over a unit square rho away is taken in the direction 22.5 deg, where the leading term
// that depends on direction, cos(4 phi), vanishes.
void ScatterPixels::tabulate(double max_rho_px) {
    if (max_rho_px <= kExactRadius) return;
    const std::uint32_t first = table_node(static_cast<float>(kExactRadius * kExactRadius));
    const std::uint32_t last = table_node(static_cast<float>(max_rho_px * max_rho_px));
    table_.resize(static_cast<std::size_t>(last - first) + 2);
    const auto density = [&](double x, double y) { return per_pixel_area(std::hypot(x, y)); };
    parallel_for(table_.size(), [&](std::size_t i, int) {
        const double rho = std::sqrt(node_value(first + static_cast<std::uint32_t>(i)));
        const double x = rho * std::cos(kPi / 8);
        const double y = rho * std::sin(kPi / 8);
        table_[i] =
            static_cast<float>(gauss_legendre_mean(density, x - 0.5, x + 0.5, y - 0.5, y + 0.5));
    });
}

void ScatterPixels::row(int dy, int count, float* energy) const {
    constexpr int kSide = kExactRadius + 1;
    constexpr int kExactSquared = kExactRadius * kExactRadius;
    const int first_far =
        dy >= kExactRadius
            ? 0
            : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(kExactSquared - dy * dy))));
    for (int dx = 0; dx < std::min(first_far, count); ++dx) {
        energy[dx] = near_[static_cast<std::size_t>(dy * kSide + dx)];
    }
    const std::uint32_t first_node = table_node(static_cast<float>(kExactSquared));
    const float dy_squared = static_cast<float>(dy) * static_cast<float>(dy);
    for (int dx = first_far; dx < count; ++dx) {
        const float squared = dy_squared + static_cast<float>(dx) * static_cast<float>(dx);
        const auto bits = std::bit_cast<std::uint32_t>(squared);
        const std::uint32_t node = (bits >> kDroppedBits) - first_node;
        const float fraction = static_cast<float>(bits & kFractionMask) *
                               (1.0F / static_cast<float>(kFractionMask + 1));
        energy[dx] = table_[node] + fraction * (table_[node + 1] - table_[node]);
    }
}

Image ScatterPixels::image(int width, int height) const {
    Image out(width, height, 1);
    const int half_width = width / 2;
    const int half_height = height / 2;
    parallel_for(static_cast<std::size_t>(half_height) + 1, [&](std::size_t y, int) {
        const int dy = static_cast<int>(y);
        float* below = out.row(half_height + dy, 0) + half_width;
        row(dy, half_width + 1, below);
        for (int dx = 1; dx <= half_width; ++dx) below[-dx] = below[dx];
        std::copy_n(below - half_width, width, out.row(half_height - dy, 0));
    });
    return out;
}

}  // namespace aureole::eye
