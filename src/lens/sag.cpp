#include "lens/sag.h"

#include <cmath>

namespace aureole::lens {
namespace {

// Which of x and y a face is curved along.
struct Curved {
    double x = 1, y = 1;
};

Curved curved_along(const Face& face) {
    return {face.profile == Profile::kCylinderY ? 0.0 : 1.0,
            face.profile == Profile::kCylinderX ? 0.0 : 1.0};
}

Vector along(const Vector& origin, const Vector& direction, double t) {
    return {origin[0] + t * direction[0], origin[1] + t * direction[1],
            origin[2] + t * direction[2]};
}

Vector unit(const Vector& v) {
    const double scale = 1 / std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return {v[0] * scale, v[1] * scale, v[2] * scale};
}

// The conic through the vertex is c (r^2 + (1 + k) z^2) - 2 z = 0. Along the ray this is
// a t^2 - 2 b t + g = 0, solved as t = g / (b + sqrt(b^2 - a g)): no 1 / c, no cancellation near
// the vertex, planes included (after Welford, "Aberrations of Optical Systems", 1986, 4.4). The
// sign of the root is that of dz, which makes the ray cross the normal from its own side.
std::optional<Hit> intersect_conic(const Face& face, const Vector& p, const Vector& d) {
    const Curved w = curved_along(face);
    const double c = face.curvature_per_mm;
    const double stretch = 1 + face.conic;
    const double a = c * (w.x * d[0] * d[0] + w.y * d[1] * d[1] + stretch * d[2] * d[2]);
    const double b = d[2] - c * (w.x * p[0] * d[0] + w.y * p[1] * d[1] + stretch * p[2] * d[2]);
    const double g = c * (w.x * p[0] * p[0] + w.y * p[1] * p[1] + stretch * p[2] * p[2]) - 2 * p[2];
    const double under_root = b * b - a * g;
    if (!(under_root >= 0)) return std::nullopt;
    const double divisor = b + std::copysign(std::sqrt(under_root), d[2]);
    if (divisor == 0) return std::nullopt;
    const double t = g / divisor;
    const Vector hit = along(p, d, t);
    const Vector normal = {-c * w.x * hit[0], -c * w.y * hit[1], 1 - c * stretch * hit[2]};
    // The other half of an ellipsoid, the other sheet of a hyperboloid; infinitely far away.
    if (!(normal[2] > 0) || !std::isfinite(t)) return std::nullopt;
    // Of a sphere it is as long as 1 already.
    const bool sphere = face.conic == 0 && face.profile == Profile::kRotational;
    return Hit{hit, sphere ? normal : unit(normal)};
}

struct Sag {
    double height = 0;
    double slope_over_r = 0;  // (dz/dr) / r, finite on the axis
};

std::optional<Sag> sag_at(const Face& face, double r2) {
    const double c = face.curvature_per_mm;
    const double under_root = 1 - (1 + face.conic) * c * c * r2;
    if (!(under_root > 0)) return std::nullopt;
    const double root = std::sqrt(under_root);
    Sag sag{c * r2 / (1 + root), c / root};
    double power = r2;  // r^(2 i + 2)
    for (std::size_t i = 0; i < face.asphere.size(); ++i) {
        sag.height += face.asphere[i] * power * r2;
        sag.slope_over_r += static_cast<double>(2 * i + 4) * face.asphere[i] * power;
        power *= r2;
    }
    return sag;
}

// Newton's method on z - sag(r) along the ray, from where it meets the conic.
std::optional<Hit> intersect_asphere(const Face& face, const Vector& p, const Vector& d) {
    constexpr int kIterations = 30;
    constexpr double kCloseMm = 1e-13;
    const Curved w = curved_along(face);
    const std::optional<Hit> start = intersect_conic(face, p, d);
    Vector hit = start ? start->point : along(p, d, -p[2] / d[2]);
    for (int i = 0; i < kIterations; ++i) {
        const auto sag = sag_at(face, w.x * hit[0] * hit[0] + w.y * hit[1] * hit[1]);
        if (!sag) return std::nullopt;
        const Vector normal = {-sag->slope_over_r * w.x * hit[0], -sag->slope_over_r * w.y * hit[1],
                               1};
        const double across = normal[0] * d[0] + normal[1] * d[1] + d[2];
        const double step = (sag->height - hit[2]) / across;
        if (!std::isfinite(step)) return std::nullopt;
        hit = along(hit, d, step);
        if (std::abs(step) <= kCloseMm * (1 + std::abs(hit[2]))) {
            if (!(across * d[2] > 0)) return std::nullopt;
            return Hit{hit, unit(normal)};
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<Hit> intersect(const Face& face, const Vector& origin, const Vector& direction) {
    return face.asphere.empty() ? intersect_conic(face, origin, direction)
                                : intersect_asphere(face, origin, direction);
}

}  // namespace aureole::lens
