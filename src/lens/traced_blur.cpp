#include "lens/traced_blur.h"

#include <algorithm>
#include <cmath>

#include "lens/steps.h"

namespace aureole::lens {
namespace {

// [a b; c d].
struct Square {
    double a = 0, b = 0, c = 0, d = 0;
};

Square product(const Square& l, const Square& r) {
    return {l.a * r.a + l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c,
            l.c * r.b + l.d * r.d};
}

}  // namespace

BlurProbe::BlurProbe(const Lens& lens, double wavelength_nm)
    : tracer_(lens, wavelength_nm), faces_(lens.faces().begin(), lens.faces().end()) {}

BlurMoments BlurProbe::moments(const Bounces& ghost, const sources::Light& light, double x_mm,
                               double y_mm) {
    constexpr double kSlope = 1e-5;
    constexpr double kShiftMm = 1e-4;
    const double tx = light.tan_x;
    const double ty = light.tan_y;
    const Ray rays[] = {
        ray_from_light(tx, ty, x_mm, y_mm), ray_from_light(tx, ty, x_mm + kShiftMm, y_mm),
        ray_from_light(tx, ty, x_mm, y_mm + kShiftMm), ray_from_light(tx + kSlope, ty, x_mm, y_mm),
        ray_from_light(tx, ty + kSlope, x_mm, y_mm)};
    for (std::size_t k = 0; k < 5; ++k) {
        if (tracer_.trace(ghost, rays[k], &paths_[k]).fate != Fate::kArrived) return {};
    }
    // d(x, y) at a point of the paths by two of the rays.
    const auto jacobian = [&](std::size_t at, std::size_t ray, double step) {
        const Vector& here = paths_[0][at];
        const Vector& by_x = paths_[ray][at];
        const Vector& by_y = paths_[ray + 1][at];
        return Square{(by_x[0] - here[0]) / step, (by_y[0] - here[0]) / step,
                      (by_x[1] - here[1]) / step, (by_y[1] - here[1]) / step};
    };
    const std::size_t sensor = paths_[0].size() - 1;
    Square move = jacobian(sensor, 3, kSlope);
    // The aperture that limits the ghost is the one whose image on the entrance is smallest. As the
    // light moves by ds, the ray through the same point of it enters elsewhere: dp = -a^-1 b ds,
    // a = da/dp and b = da/ds there.
    double largest = 0;
    std::size_t limit = 0;
    std::size_t at = 1;
    visit_steps(static_cast<int>(faces_.size()), ghost, [&](const Step& step) {
        const Square a = jacobian(at, 1, kShiftMm);
        const double radius = faces_[static_cast<std::size_t>(step.face)].semi_aperture_mm;
        const double reduction = std::abs(a.a * a.d - a.b * a.c) / (radius * radius);
        if (reduction > largest) {
            largest = reduction;
            limit = at;
        }
        ++at;
        return true;
    });
    if (largest > 0) {
        const Square a = jacobian(limit, 1, kShiftMm);
        const double det = a.a * a.d - a.b * a.c;
        const Square inverse = {a.d / det, -a.b / det, -a.c / det, a.a / det};
        const Square back =
            product(jacobian(sensor, 1, kShiftMm), product(inverse, jacobian(limit, 3, kSlope)));
        move = {move.a - back.a, move.b - back.b, move.c - back.c, move.d - back.d};
    }
    const Square moments = {light.moment_xx, light.moment_xy, light.moment_xy, light.moment_yy};
    const Square half = product(move, moments);
    return {half.a * move.a + half.b * move.b, half.a * move.c + half.b * move.d,
            half.c * move.c + half.d * move.d};
}

double BlurKernel::reach(const BlurMoments& m) {
    const double mean = 0.5 * (m.xx + m.yy);
    const double apart = std::hypot(0.5 * (m.xx - m.yy), m.xy);
    // The variance of an even ellipse is a quarter of its semi-axis squared.
    return 2 * std::sqrt(std::max(0.0, mean + apart));
}

void BlurKernel::set(const BlurMoments& moments) {
    constexpr int kSub = 8;  // samples per pixel and direction
    // At least half a pixel wide in all directions.
    const double xx = moments.xx + 0.0625;
    const double yy = moments.yy + 0.0625;
    const double xy = moments.xy;
    const double det = std::max(xx * yy - xy * xy, 1e-9);
    radius_ = std::min(kMaxRadius, static_cast<int>(std::ceil(reach({xx, xy, yy}) + 0.5)));
    double sum = 0;
    for (int dy = -kMaxRadius; dy <= kMaxRadius; ++dy) {
        half_widths_[dy + kMaxRadius] = -1;
        for (int dx = -kMaxRadius; dx <= kMaxRadius; ++dx) {
            float& weight = weights_[(dy + kMaxRadius) * kSide + dx + kMaxRadius];
            weight = 0;
            if (std::abs(dx) > radius_ || std::abs(dy) > radius_) continue;
            int inside = 0;
            for (int j = 0; j < kSub; ++j) {
                for (int i = 0; i < kSub; ++i) {
                    const double x = dx + (i + 0.5) / kSub - 0.5;
                    const double y = dy + (j + 0.5) / kSub - 0.5;
                    // p^T C^-1 p < 4 for an even ellipse with covariance C.
                    inside += (yy * x * x - 2 * xy * x * y + xx * y * y) < 4 * det ? 1 : 0;
                }
            }
            weight = static_cast<float>(inside);
            sum += inside;
            if (inside > 0) {
                half_widths_[dy + kMaxRadius] =
                    std::max(half_widths_[dy + kMaxRadius], std::abs(dx));
            }
        }
    }
    for (float& weight : weights_) weight /= static_cast<float>(sum);
}

}  // namespace aureole::lens
