#include "aureole/lens/halation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/coating.h"

namespace aureole::lens {
namespace {

void check(const HalationOptions& options, double efl_mm, const wave::KernelGrid& grid) {
    const auto refuse = [](const char* what, double value, const char* allowed) {
        throw InvalidArgument(what, fmt::format("{}", value), allowed);
    };
    if (!(options.share >= 0 && options.share <= 1)) {
        refuse("halation", options.share, "must be from 0 to 1");
    }
    if (!(options.layer_mm > 0 && options.layer_mm <= 100)) {
        refuse("layer of halation (mm)", options.layer_mm, "must be above 0 and at most 100");
    }
    if (!(options.refractive_index > 1 && options.refractive_index <= 4)) {
        refuse("refractive index of the layer", options.refractive_index,
               "must be above 1 and at most 4");
    }
    if (!(options.backing >= 0 && options.backing <= 1)) {
        refuse("reflectance of the backing", options.backing, "must be from 0 to 1");
    }
    if (!(efl_mm > 0) || !std::isfinite(efl_mm)) {
        refuse("focal length (mm)", efl_mm, "must be positive");
    }
    if (grid.width < 1 || grid.height < 1 || grid.width % 2 == 0 || grid.height % 2 == 0 ||
        !(grid.pitch_deg > 0)) {
        throw InvalidArgument(
            "kernel",
            fmt::format("{}x{} pixels of {} deg", grid.width, grid.height, grid.pitch_deg),
            "must have odd sides and a pitch above 0");
    }
}

// What the far face and its backing return, by the squared sine of the angle within the layer; all
// beyond the critical one.
double returned(double sine2, double refractive_index, double backing) {
    if (sine2 * refractive_index * refractive_index >= 1) return 1;
    constexpr double kAnyNm = 550;  // without coating
    const double face = reflectance(refractive_index, 1, {}, kAnyNm, std::sqrt(1 - sine2)).mean();
    return face + (1 - face) * (1 - face) * backing / (1 - face * backing);
}

// H in units of t = r / 2d.
class Ring {
  public:
    Ring(double n, double backing)
        : n_(n), backing_(backing), mean_(diffuse_reflectance(n, backing)) {}

    double density(double t2) const {
        const double s2 = t2 / (1 + t2);
        return returned(s2, n_, backing_) / (mean_ * kPi * (1 + t2) * (1 + t2));
    }
    // Energy beyond t, which must lie outside the critical angle: R is 1 there.
    double beyond(double t2) const { return 1 / (mean_ * (1 + t2)); }
    double critical_t2() const { return 1 / (n_ * n_ - 1); }

  private:
    double n_;
    double backing_;
    double mean_;
};

// The share outside a rectangle of the given half sides: around it in polar coordinates.
double energy_outside(const Ring& ring, double half_width, double half_height) {
    constexpr int kDirections = 4096;  // of a quarter turn
    constexpr int kSteps = 256;        // up to the critical angle, where a kernel ends within
    double sum = 0;
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 0.5 * kPi * (i + 0.5) / kDirections;
        const double t = std::min(half_width / std::cos(angle), half_height / std::sin(angle));
        const double t2 = std::max(t * t, ring.critical_t2());
        sum += ring.beyond(t2);
        const double step = (t2 - t * t) / kSteps;  // in t^2, of which pi per ring of area
        for (int k = 0; k < kSteps && step > 0; ++k) {
            sum += kPi * step * ring.density(t * t + (k + 0.5) * step);
        }
    }
    return sum / kDirections;
}

// The mean over a pixel whose middle is (x, y) away, all in units of t.
double pixel_mean(const Ring& ring, double x, double y, double side) {
    // Near the ring its edge is steep, and pixels may be as large as all of it.
    const double distance = std::hypot(x, y) / side;
    const bool near = std::hypot(x, y) < 3 || distance < 3;
    const int parts = near ? std::clamp(static_cast<int>(std::ceil(24 * side)), 6, 64) : 2;
    double sum = 0;
    for (int j = 0; j < parts; ++j) {
        const double v = y + ((j + 0.5) / parts - 0.5) * side;
        for (int i = 0; i < parts; ++i) {
            const double u = x + ((i + 0.5) / parts - 0.5) * side;
            sum += ring.density(u * u + v * v);
        }
    }
    return sum / (parts * parts);
}

}  // namespace

double diffuse_reflectance(double refractive_index, double backing) {
    const double n = refractive_index;
    // Over s^2, in which Lambertian light is even: all returned beyond 1 / n^2; below it in equal
    // steps of the cosine outside, where Fresnel's formulas have no steep end.
    constexpr int kSteps = 1000;
    double sum = 1 - 1 / (n * n);
    for (int k = 0; k < kSteps; ++k) {
        const double out = (k + 0.5) / kSteps;
        sum += 2 * out / (n * n * kSteps) * returned((1 - out * out) / (n * n), n, backing);
    }
    return sum;
}

wave::Psf halation_psf(const HalationOptions& options, double efl_mm,
                       const wave::KernelGrid& grid) {
    check(options, efl_mm, grid);
    const Ring ring(options.refractive_index, options.backing);
    const double side = efl_mm / grid.view().focal_length_px() / (2 * options.layer_mm);
    wave::Psf psf;
    psf.grid = grid;
    psf.kernel = Image(grid.width, grid.height, 3);
    const int half_width = grid.width / 2;
    const int half_height = grid.height / 2;
    // One quadrant; the others are its mirror images.
    std::vector<double> sums(static_cast<std::size_t>(half_height) + 1, 0.0);
    parallel_for(sums.size(), [&](std::size_t row, int) {
        const int dy = static_cast<int>(row);
        float* below = psf.kernel.row(half_height + dy, 0) + half_width;
        for (int dx = 0; dx <= half_width; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const double value =
                options.share * side * side * pixel_mean(ring, dx * side, dy * side, side);
            below[dx] = below[-dx] = static_cast<float>(value);
            sums[row] += value * (dx > 0 ? 2 : 1) * (dy > 0 ? 2 : 1);
        }
        std::copy_n(below - half_width, grid.width, psf.kernel.row(half_height - dy, 0));
    });
    const double outside =
        options.share * energy_outside(ring, (half_width + 0.5) * side, (half_height + 0.5) * side);
    double around = outside;
    for (const double sum : sums) around += sum;
    // What is left is in the middle: the light that stays, and what the ring sends there.
    psf.kernel.at(half_width, half_height, 0) = static_cast<float>(1 - around);
    for (int c = 1; c < 3; ++c) {
        std::copy_n(psf.kernel.plane(0), psf.kernel.pixels(), psf.kernel.plane(c));
    }
    psf.off_kernel_energy = {outside, outside, outside};
    return psf;
}

}  // namespace aureole::lens
