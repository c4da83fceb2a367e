#include "aureole/lens/iris.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "lens/iris_pyramid.h"

namespace aureole::lens {
namespace {

void check(const IrisShape& shape) {
    if (shape.blades != 0 && (shape.blades < 3 || shape.blades > Iris::kMaxBlades)) {
        throw InvalidArgument("iris blades", std::to_string(shape.blades),
                              "must be 0 (round) or 3 to 64");
    }
    if (!std::isfinite(shape.rotation_deg)) {
        throw InvalidArgument("iris rotation (deg)", std::to_string(shape.rotation_deg),
                              "must be finite");
    }
    if (!(shape.curvature >= 0 && shape.curvature <= 1)) {
        throw InvalidArgument("iris curvature", std::to_string(shape.curvature),
                              "must be in [0, 1]");
    }
    if (!(shape.smoothing >= 0 && shape.smoothing <= 0.5)) {
        throw InvalidArgument("iris smoothing", std::to_string(shape.smoothing),
                              "must be in [0, .5]");
    }
}

// The polynomial smooth maximum of the blog (after Inigo Quilez), of a >= b.
template <class T>
T smooth_maximum(T a, T b, T k) {
    if (k <= 0) return a;
    const T h = std::min(T(0.5) + T(0.5) * (a - b) / k, T(1));
    return b + h * (a - b + k * (1 - h));
}

// What one blade looks like in its own frame: the middle of its edge at (apothem, 0).
struct BladeEdge {
    double apothem;
    double radius;  // 0: straight

    // `along`: towards the blade, `across`: beside it.
    double distance(double along, double across) const {
        if (radius == 0) return 1 + along - apothem;
        return 1 + std::hypot(along + radius - apothem, across) - radius;
    }
};

// Through corners at distance 1 from the axis, curved as in wave::regular_polygon.
BladeEdge blade_edge(int blades, double curvature) {
    const double half_angle = kPi / blades;
    const double half_chord = std::sin(half_angle);
    const double bulge = curvature * (1 - std::cos(half_angle));
    if (bulge == 0) return {std::cos(half_angle), 0};
    return {std::cos(half_angle) + bulge, (half_chord * half_chord + bulge * bulge) / (2 * bulge)};
}

// Where a ray from the axis at `angle` from a corner, within half a blade of it, meets the edge:
// only the two blades that share the corner are near.
double edge_at(const BladeEdge& edge, int blades, double smoothing, double angle) {
    const double half_angle = kPi / blades;
    const auto distance = [&](double radius) {
        const double near = half_angle - angle;
        const double far = half_angle + angle;
        return smooth_maximum(edge.distance(radius * std::cos(near), radius * std::sin(near)),
                              edge.distance(radius * std::cos(far), radius * std::sin(far)),
                              smoothing);
    };
    double low = 0;
    double high = 3 * edge.apothem;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (distance(middle) < 1 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Area by Simpson's rule over half a blade.
double area_of(const BladeEdge& edge, int blades, double smoothing) {
    constexpr int kSteps = 512;
    const double step = kPi / blades / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double radius = edge_at(edge, blades, smoothing, i * step);
        const int weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * radius * radius;
    }
    return blades * sum * step / 3;
}

}  // namespace

Iris::Iris(const IrisShape& shape) : shape_(shape) {
    check(shape);
    if (shape.blades == 0) return;
    const BladeEdge unit = blade_edge(shape.blades, shape.curvature);
    const auto scaled = [&](double by) { return BladeEdge{unit.apothem * by, unit.radius * by}; };
    // The smooth maximum takes the same off the corners of an iris of any size, so the size is
    // found by iteration: the area is nearly a quadratic function of it.
    double scale = 1;
    for (int i = 0; i < 30; ++i) {
        const double by = std::sqrt(kPi / area_of(scaled(scale), shape.blades, shape.smoothing));
        scale *= by;
        if (std::abs(by - 1) < 1e-12) break;
    }
    const BladeEdge edge = scaled(scale);
    apothem_ = edge.apothem;
    blade_radius_ = edge.radius;
    const double half_angle = kPi / shape.blades;
    // Corners are farthest and middles of blades nearest, unless the smooth maximum levels them.
    outer_radius_ = 0;
    inner_radius_ = 2 * edge.apothem;
    constexpr int kAngles = 256;
    for (int i = 0; i <= kAngles; ++i) {
        const double radius =
            edge_at(edge, shape.blades, shape.smoothing, half_angle * i / kAngles);
        outer_radius_ = std::max(outer_radius_, radius);
        inner_radius_ = std::min(inner_radius_, radius);
    }
    for (int b = 0; b < shape.blades; ++b) {
        const double angle = rad_from_deg(shape.rotation_deg) + (2 * b + 1) * half_angle;
        blades_[b] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
}

Iris::Iris(const ConstImageView& transmission) : inner_radius_(0) {
    Image image = transmission_of(transmission, "iris picture");
    const double middle_x = 0.5 * image.width();
    const double middle_y = 0.5 * image.height();
    double area_px = 0;
    double outer_px = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (image.at(x, y) <= 0) continue;
            area_px += image.at(x, y);
            // The farthest corner of the pixel, and the half pixel of interpolation around it.
            outer_px = std::max(outer_px, std::hypot(std::abs(x + 0.5 - middle_x) + 1,
                                                     std::abs(y + 0.5 - middle_y) + 1));
        }
    }
    if (area_px <= 0) throw InvalidArgument("iris picture: must let light through, but is black");
    pixels_per_unit_ = std::sqrt(area_px / kPi);
    outer_radius_ = outer_px / pixels_per_unit_;
    pyramid_ = transmission_pyramid(std::move(image), 0);
}

float Iris::distance(float u, float v) const noexcept {
    if (is_image()) return std::hypot(u, v) - static_cast<float>(outer_radius_) + 1;
    if (shape_.blades == 0) return std::hypot(u, v);
    const auto apothem = static_cast<float>(apothem_);
    const auto radius = static_cast<float>(blade_radius_);
    float first = -std::numeric_limits<float>::infinity();
    float second = first;
    for (int b = 0; b < shape_.blades; ++b) {
        const Blade& blade = blades_[b];
        const float distance = radius == 0
                                   ? 1 + blade.normal_u * u + blade.normal_v * v - apothem
                                   : 1 - radius +
                                         std::hypot(u + (radius - apothem) * blade.normal_u,
                                                    v + (radius - apothem) * blade.normal_v);
        second = std::max(second, std::min(first, distance));
        first = std::max(first, distance);
    }
    return smooth_maximum(first, second, static_cast<float>(shape_.smoothing));
}

float Iris::image_transmission(float u, float v, float footprint) const noexcept {
    const auto scale = static_cast<float>(pixels_per_unit_);
    const Image& image = pyramid_.front();
    return sample(pyramid_, 0.5F * static_cast<float>(image.width()) + u * scale,
                  0.5F * static_cast<float>(image.height()) - v * scale, footprint * scale, 0);
}

float Iris::transmission(float u, float v) const noexcept {
    if (is_image()) return image_transmission(u, v, 0);
    return distance(u, v) <= 1 ? 1.0F : 0.0F;
}

}  // namespace aureole::lens
