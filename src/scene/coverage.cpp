#include "scene/coverage.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::scene {
namespace {

// Sutherland & Hodgman 1974: the part of a convex polygon where sign * (axis - limit) >= 0.
template <double Pixel::*kAxis>
void clip(const Polygon& in, double limit, double sign, Polygon& out) {
    out.clear();
    for (std::size_t i = 0; i < in.size(); ++i) {
        const Pixel& a = in[i];
        const Pixel& b = in[i + 1 == in.size() ? 0 : i + 1];
        const double da = sign * (a.*kAxis - limit);
        const double db = sign * (b.*kAxis - limit);
        if (da >= 0) out.push_back(a);
        if ((da >= 0) != (db >= 0)) {
            const double t = da / (da - db);
            out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
}

struct Bounds {
    int low;
    int high;  // exclusive
};

Bounds pixel_bounds(const Polygon& polygon, double Pixel::*axis, int size) {
    double low = polygon[0].*axis;
    double high = low;
    for (const Pixel& p : polygon) {
        low = std::min(low, p.*axis);
        high = std::max(high, p.*axis);
    }
    return {static_cast<int>(std::floor(std::clamp(low, 0.0, 1.0 * size))),
            static_cast<int>(std::ceil(std::clamp(high, 0.0, 1.0 * size)))};
}

}  // namespace

Polygon ellipse(Pixel centre, Pixel half_axis_1, Pixel half_axis_2) {
    constexpr int kSides = 48;
    // A regular n-gon of circumradius r has the area n/2 sin(2 pi / n) r^2.
    const double grow = std::sqrt(kPi / (kSides / 2.0 * std::sin(2 * kPi / kSides)));
    Polygon polygon;
    polygon.reserve(kSides);
    for (int i = 0; i < kSides; ++i) {
        const double c = grow * std::cos(2 * kPi * i / kSides);
        const double s = grow * std::sin(2 * kPi * i / kSides);
        polygon.push_back({centre.x + c * half_axis_1.x + s * half_axis_2.x,
                           centre.y + c * half_axis_1.y + s * half_axis_2.y});
    }
    return polygon;
}

Polygon cone_outline(const Camera& camera, Vec3 direction, double radius_deg) {
    constexpr int kSides = 96;
    const Vec3 axis = normalize(direction);
    const Vec3 right = normalize(Vec3{axis.z, 0, -axis.x});
    const Vec3 up = {axis.y * right.z - axis.z * right.y, axis.z * right.x - axis.x * right.z,
                     axis.x * right.y - axis.y * right.x};
    // A regular polygon of equal area.
    const double grow = std::sqrt(kPi / (kSides / 2.0 * std::sin(2 * kPi / kSides)));
    const double radius = std::tan(rad_from_deg(radius_deg)) * grow;
    Polygon outline;
    for (int i = 0; i < kSides; ++i) {
        const auto c = static_cast<float>(radius * std::cos(2 * kPi * i / kSides));
        const auto s = static_cast<float>(radius * std::sin(2 * kPi * i / kSides));
        const auto pixel = camera.project_direction(axis + right * c + up * s);
        if (!pixel) return {};
        outline.push_back(*pixel);
    }
    return outline;
}

double area(const Polygon& polygon) {
    double doubled = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Pixel& a = polygon[i];
        const Pixel& b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        doubled += (a.x - polygon[0].x) * (b.y - polygon[0].y) -
                   (b.x - polygon[0].x) * (a.y - polygon[0].y);
    }
    return std::abs(doubled) / 2;
}

std::vector<PixelCoverage> coverage(const Polygon& polygon, int width, int height) {
    std::vector<PixelCoverage> pixels;
    if (polygon.size() < 3) return pixels;
    const Bounds rows = pixel_bounds(polygon, &Pixel::y, height);
    Polygon above;
    Polygon row;
    Polygon left;
    Polygon cell;
    for (int y = rows.low; y < rows.high; ++y) {
        clip<&Pixel::y>(polygon, y, 1, above);
        clip<&Pixel::y>(above, y + 1, -1, row);
        if (row.size() < 3) continue;
        const Bounds columns = pixel_bounds(row, &Pixel::x, width);
        for (int x = columns.low; x < columns.high; ++x) {
            clip<&Pixel::x>(row, x, 1, left);
            clip<&Pixel::x>(left, x + 1, -1, cell);
            const double share = cell.size() < 3 ? 0 : area(cell);
            if (share > 0) pixels.push_back({x, y, static_cast<float>(std::min(share, 1.0))});
        }
    }
    return pixels;
}

void add_light(const Polygon& polygon, Vec3 radiance, Image& picture) {
    for (const PixelCoverage& p : coverage(polygon, picture.width(), picture.height())) {
        const float values[] = {radiance.x, radiance.y, radiance.z};
        for (int c = 0; c < 3; ++c) picture.at(p.x, p.y, c) += p.share * values[c];
    }
}

void add_point(Pixel position, Vec3 illuminance, const View& view, Image& picture) {
    const Polygon square = {{position.x - 0.5, position.y - 0.5},
                            {position.x + 0.5, position.y - 0.5},
                            {position.x + 0.5, position.y + 0.5},
                            {position.x - 0.5, position.y + 0.5}};
    for (const PixelCoverage& p : coverage(square, picture.width(), picture.height())) {
        const auto per_sr =
            static_cast<float>(double{p.share} / view.pixel_solid_angle_sr(p.x, p.y));
        const float values[] = {illuminance.x, illuminance.y, illuminance.z};
        for (int c = 0; c < 3; ++c) picture.at(p.x, p.y, c) += values[c] * per_sr;
    }
}

}  // namespace aureole::scene
