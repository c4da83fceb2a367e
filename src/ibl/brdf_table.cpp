#include "aureole/ibl/brdf_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/roughness.h"
#include "ibl/brdf_kernels.h"
#include "ibl/gauss_legendre.h"

namespace aureole::ibl {
namespace {

constexpr int kLargestSize = 1024;

template <std::size_t kCount>
void set_rule(std::array<float, kCount>& nodes, std::array<float, kCount>& weights) {
    const GaussRule rule = gauss_legendre(static_cast<int>(kCount));
    for (std::size_t i = 0; i < kCount; ++i) {
        nodes[i] = static_cast<float>((rule.nodes[i] + 1) / 2);
        weights[i] = static_cast<float>(rule.weights[i] / 2);
    }
}

BrdfNodes brdf_nodes() {
    BrdfNodes nodes;
    set_rule(nodes.elevation, nodes.elevation_weight);
    set_rule(nodes.azimuth, nodes.azimuth_weight);
    return nodes;
}

std::array<double, 2> integrate(BrdfTableKind kind, const BrdfNodes& nodes, double n_dot_v,
                                double alpha) {
    if (kind == BrdfTableKind::kCloth) return brdf_kernels().cloth(nodes, n_dot_v, alpha);
    const auto [all, fresnel] = brdf_kernels().ggx(nodes, n_dot_v, alpha);
    if (kind == BrdfTableKind::kMultiscatter) return {fresnel, all};
    return {all - fresnel, fresnel};
}

}  // namespace

BrdfTable::BrdfTable(BrdfTableKind kind, int size) : kind_(kind) {
    if (size < 1 || size > kLargestSize) {
        throw InvalidArgument(
            "size", std::to_string(size),
            "a table has 1 to " + std::to_string(kLargestSize) + " entries per side");
    }
    const int channels = kind == BrdfTableKind::kCloth ? 1 : 2;
    image_ = Image(size, size, channels);
    const BrdfNodes nodes = brdf_nodes();
    parallel_for(static_cast<std::size_t>(size), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const double alpha = alpha_from_roughness((y + 0.5) / size);
        for (int x = 0; x < size; ++x) {
            const auto values = integrate(kind, nodes, (x + 0.5) / size, alpha);
            for (int c = 0; c < channels; ++c) {
                image_.row(y, c)[x] = static_cast<float>(values[static_cast<std::size_t>(c)]);
            }
        }
    });
}

std::array<float, 2> BrdfTable::lookup(double n_dot_v, double roughness) const noexcept {
    const int last = size() - 1;
    const auto place = [&](double coordinate) {
        return std::clamp(coordinate * size() - 0.5, 0.0, static_cast<double>(last));
    };
    const double x = place(n_dot_v);
    const double y = place(roughness);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, last);
    const int y1 = std::min(y0 + 1, last);
    std::array<float, 2> values = {};
    for (int c = 0; c < image_.channels(); ++c) {
        const float* low = image_.row(y0, c);
        const float* high = image_.row(y1, c);
        const double below = std::lerp(low[x0], low[x1], x - x0);
        const double above = std::lerp(high[x0], high[x1], x - x0);
        values[static_cast<std::size_t>(c)] = static_cast<float>(std::lerp(below, above, y - y0));
    }
    return values;
}

}  // namespace aureole::ibl
