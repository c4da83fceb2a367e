#include "ibl/lat_long_grid.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {

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
    return width * (0.5 - std::atan2(x, z) / (2 * kPi)) - 0.5;
}

int LatLongGrid::strip(double mu) const {
    const double angle = std::acos(std::clamp(mu * shrink_, -1.0, 1.0));
    int r = std::clamp(static_cast<int>(height * (angle / kPi) - 0.5), 0, strips - 1);
    while (r > 0 && mu > node_mu[static_cast<std::size_t>(r)]) --r;
    while (r + 1 < strips && mu < node_mu[static_cast<std::size_t>(r) + 1]) ++r;
    return r;
}

}  // namespace aureole::ibl
