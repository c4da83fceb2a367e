#include "lens/mesh_facets.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_facets.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

constexpr int kRowsAtOnce = 16;
static_assert(kRowsAtOnce % kLanes == 0);

// A side of a triangle, from its first vertex in the order of the mesh to its second: both
// triangles that share it cross a row at the same float.
struct Side {
    float x = 0, y0 = 0, y1 = 0, dx_dy = 0;
};

struct Corner {
    float x, y, radiance;
};

Side side_between(const Corner& a, const Corner& b) {
    const float dy = b.y - a.y;
    return {a.x, a.y, b.y, dy != 0 ? (b.x - a.x) / dy : 0.0F};
}

// Widens [low, high] to where a side crosses rows at heights y. Of the two ends of a side one
// counts, so that a row that runs through a vertex crosses one of the two sides that meet there.
HWY_INLINE void cross(const Side& side, V y, V& low, V& high) {
    const M above = hn::Le(set(side.y0), y);
    const M below = hn::Le(set(side.y1), y);
    const M crossed = hn::Xor(above, below);
    const V x = hn::MulAdd(hn::Sub(y, set(side.y0)), set(side.dx_dy), set(side.x));
    low = hn::IfThenElse(crossed, hn::Min(low, x), low);
    high = hn::IfThenElse(crossed, hn::Max(high, x), high);
}

void draw_triangle(const Corner& a, const Corner& b, const Corner& c, const Side& ab,
                   const Side& bc, const Side& ac, const MeshTile& tile) {
    const D d;
    const hn::Rebind<std::int32_t, D> di;
    const auto [least, most] = std::minmax({a.y, b.y, c.y});
    // Rows whose middles are within.
    const int y0 = std::max(tile.y0, static_cast<int>(std::ceil(least - 0.5F)));
    const int y1 = std::min(tile.y1, static_cast<int>(std::ceil(most - 0.5F)));
    if (y0 >= y1) return;
    const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return;
    const float gradient_x =
        ((b.radiance - a.radiance) * (c.y - a.y) - (c.radiance - a.radiance) * (b.y - a.y)) / area;
    const float gradient_y =
        ((c.radiance - a.radiance) * (b.x - a.x) - (b.radiance - a.radiance) * (c.x - a.x)) / area;
    const V step = hn::Mul(hn::Iota(d, 0), set(gradient_x));
    for (int first = y0; first < y1; first += kRowsAtOnce) {
        HWY_ALIGN std::int32_t begin[kRowsAtOnce];
        HWY_ALIGN std::int32_t end[kRowsAtOnce];
        for (int k = 0; k < kRowsAtOnce && first + k < y1; k += kLanes) {
            const V y = hn::Iota(d, static_cast<float>(first + k) + 0.5F);
            V low = set(1e9F);
            V high = set(-1e9F);
            cross(ab, y, low, high);
            cross(bc, y, low, high);
            cross(ac, y, low, high);
            // Pixels whose middles are in [low, high).
            const auto whole = [&](V x) {
                const V clamped = hn::Min(
                    hn::Max(hn::Ceil(hn::Sub(x, set(0.5F))), set(static_cast<float>(tile.x0))),
                    set(static_cast<float>(tile.x1)));
                return hn::ConvertTo(di, clamped);
            };
            hn::Store(whole(low), di, begin + k);
            hn::Store(whole(high), di, end + k);
        }
        const int rows = std::min(kRowsAtOnce, y1 - first);
        for (int k = 0; k < rows; ++k) {
            int x = begin[k];
            if (x >= end[k]) continue;
            const float at_y = static_cast<float>(first + k) + 0.5F - a.y;
            const float at_x = static_cast<float>(x) + 0.5F - a.x;
            V radiance = hn::Add(set(a.radiance + gradient_y * at_y + gradient_x * at_x), step);
            float* to = tile.sums + (first + k - tile.y0 + 1) * tile.stride + x - tile.x0 + 1;
            for (; x + kLanes <= end[k]; x += kLanes, to += kLanes) {
                hn::StoreU(hn::Add(load(to), radiance), d, to);
                radiance = hn::Add(radiance, set(gradient_x * static_cast<float>(kLanes)));
            }
            if (x < end[k]) {
                const M rest = hn::FirstN(d, static_cast<std::size_t>(end[k] - x));
                hn::StoreU(hn::Add(load(to), hn::IfThenElseZero(rest, radiance)), d, to);
            }
        }
    }
}

void draw(const Mesh& mesh, const MeshGroup& group, const MeshTile& tile) {
    const std::ptrdiff_t s = mesh.stride;
    const int last = std::min(group.column + kGroup, mesh.columns - 2);
    const auto corner = [&](std::ptrdiff_t k) {
        return Corner{mesh.x[k], mesh.y[k], mesh.radiance[k]};
    };
    std::ptrdiff_t at = group.row * s + group.column;
    Corner upper_left = corner(at);
    Corner lower_left = corner(at + s);
    Side left = side_between(upper_left, lower_left);
    for (int column = group.column; column < last; ++column, ++at) {
        const Corner upper_right = corner(at + 1);
        const Corner lower_right = corner(at + s + 1);
        const Side right = side_between(upper_right, lower_right);
        // Vertices with weight have only fit cells around them.
        if (upper_left.radiance != 0 || upper_right.radiance != 0 || lower_left.radiance != 0 ||
            lower_right.radiance != 0) {
            const Side upper = side_between(upper_left, upper_right);
            const Side lower = side_between(lower_left, lower_right);
            const Side diagonal = side_between(upper_left, lower_right);
            draw_triangle(upper_left, upper_right, lower_right, upper, right, diagonal, tile);
            draw_triangle(upper_left, lower_left, lower_right, left, lower, diagonal, tile);
        }
        upper_left = upper_right;
        lower_left = lower_right;
        left = right;
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(draw);
void draw_facets(const Mesh& mesh, const MeshGroup& group, const MeshTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(mesh, group, tile);
}
}  // namespace aureole::lens
#endif
