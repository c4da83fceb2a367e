#include "ibl/lat_long_grid.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// Abramowitz & Stegun 1964, 4.4.49: 2e-8 at most on [0, 1]. A hundredth of a millionth of a turn is
// far below a pixel, and all that share a vertex have the same.
double arc_tangent(double x) {
    const double y = x * x;
    double sum = 0.0028662257;
    for (const double next : {-0.0161657367, 0.0429096138, -0.0752896400, 0.1065626393,
                              -0.1420889944, 0.1999355085, -0.3333314528, 1.0}) {
        sum = sum * y + next;
    }
    return x * sum;
}

// In [-pi, pi], as std::atan2.
double fast_longitude(double x, double z) {
    const double ax = std::abs(x);
    const double az = std::abs(z);
    const double larger = std::max(ax, az);
    if (larger == 0) return 0;
    double angle = arc_tangent(std::min(ax, az) / larger);
    if (ax > az) angle = kPi / 2 - angle;
    if (z < 0) angle = kPi - angle;
    return std::copysign(angle, x);
}

// Abramowitz & Stegun 1964, 4.4.45: 7e-5 at most.
double rough_arc_cosine(double x) {
    const double y = std::abs(x);
    const double angle =
        std::sqrt(1 - y) * (1.5707288 + y * (-0.2121144 + y * (0.0742610 - y * 0.0187293)));
    return x < 0 ? kPi - angle : angle;
}

}  // namespace

LatLongGrid::LatLongGrid(int width_px, int height_px)
    : width(width_px),
      height(height_px),
      strips(std::max(1, height_px - 1)),
      shrink_(height_px > 1 ? std::cos(kPi / (2 * height_px)) : 0) {
    for (int r = 0; r <= strips; ++r) {
        node_mu.push_back(std::sin(kPi / 2 - kPi * (r + 0.5) / height) / shrink_);
    }
    node_mu.front() = 1;
    node_mu.back() = -1;
    for (int r = 0; r < strips; ++r) {
        const auto i = static_cast<std::size_t>(r);
        per_strip.push_back(1 / (node_mu[i] - node_mu[i + 1]));
    }
}

double LatLongGrid::column(double x, double z) const {
    return width * (0.5 - fast_longitude(x, z) / (2 * kPi)) - 0.5;
}

int LatLongGrid::strip(double mu) const {
    const double angle = rough_arc_cosine(std::clamp(mu * shrink_, -1.0, 1.0));
    int r = std::clamp(static_cast<int>(height * (angle / kPi) - 0.5), 0, strips - 1);
    while (r > 0 && mu > node_mu[static_cast<std::size_t>(r)]) --r;
    while (r + 1 < strips && mu < node_mu[static_cast<std::size_t>(r) + 1]) ++r;
    return r;
}

}  // namespace aureole::ibl
