#include "lens/traced_blur.h"

#include <algorithm>
#include <cmath>

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

BlurMoments blur_of(const Tracer& tracer, const Bounces& ghost, const sources::Light& light,
                    double x_mm, double y_mm) {
    constexpr double kSlope = 1e-5;
    constexpr double kShiftMm = 1e-4;
    struct Landing {
        double x = 0, y = 0, u = 0, v = 0;
    };
    bool arrived = true;
    const auto land = [&](double tan_x, double tan_y, double x, double y) {
        const TracedRay ray = tracer.trace(ghost, ray_from_light(tan_x, tan_y, x, y));
        arrived = arrived && ray.fate == Fate::kArrived;
        return Landing{ray.x_mm, ray.y_mm, ray.stop_x_mm, ray.stop_y_mm};
    };
    const auto jacobian = [](const Landing& at, const Landing& by_x, const Landing& by_y,
                             double step) {
        struct Both {
            Square sensor, stop;
        };
        return Both{{(by_x.x - at.x) / step, (by_y.x - at.x) / step, (by_x.y - at.y) / step,
                     (by_y.y - at.y) / step},
                    {(by_x.u - at.u) / step, (by_y.u - at.u) / step, (by_x.v - at.v) / step,
                     (by_y.v - at.v) / step}};
    };
    const double tx = light.tan_x;
    const double ty = light.tan_y;
    const Landing at = land(tx, ty, x_mm, y_mm);
    const auto by_place = jacobian(at, land(tx, ty, x_mm + kShiftMm, y_mm),
                                   land(tx, ty, x_mm, y_mm + kShiftMm), kShiftMm);
    const auto by_slope =
        jacobian(at, land(tx + kSlope, ty, x_mm, y_mm), land(tx, ty + kSlope, x_mm, y_mm), kSlope);
    if (!arrived) return {};
    // As the light moves, the ray through the same point of the stop enters elsewhere:
    // dp = -(du/dp)^-1 du/ds ds.
    Square move = by_slope.sensor;
    const Square& u = by_place.stop;
    const double det = u.a * u.d - u.b * u.c;
    const double size = std::abs(u.a * u.d) + std::abs(u.b * u.c);
    if (std::abs(det) > 1e-6 * size && size > 1e-12) {
        const Square inverse = {u.d / det, -u.b / det, -u.c / det, u.a / det};
        const Square back = product(by_place.sensor, product(inverse, by_slope.stop));
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
