#include "lens/mesh_facets.h"

#include <cmath>
#include <utility>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_facets.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_mask-inl.h"
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
    std::ptrdiff_t at;  // vertex
    float x, y;
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

struct Triangle {
    Corner a, b, c;
    Side ab, bc, ac;
};

// A field that is linear over a triangle.
struct Gradient {
    float value = 0, x = 0, y = 0;  // at the first corner, and per pixel
};

class Plane {
  public:
    explicit Plane(const Triangle& t)
        : bx_(t.b.x - t.a.x), by_(t.b.y - t.a.y), cx_(t.c.x - t.a.x), cy_(t.c.y - t.a.y) {
        const float area = bx_ * cy_ - cx_ * by_;
        per_area_ = area != 0 ? 1 / area : 0;
    }
    Gradient through(float a, float b, float c) const {
        const float to_b = (b - a) * per_area_;
        const float to_c = (c - a) * per_area_;
        return {a, to_b * cy_ - to_c * by_, to_c * bx_ - to_b * cx_};
    }
    Gradient of(const float* field, const Triangle& t) const {
        return through(field[t.a.at], field[t.b.at], field[t.c.at]);
    }

  private:
    float bx_, by_, cx_, cy_, per_area_;
};

// What a triangle's pixels receive.
struct Facet {
    float a_x = 0, a_y = 0;
    Gradient radiance;
    Gradient u, v, clip, entrance_x, entrance_y;
};

// At pixels from (x, y) on, of which the position relative to the first corner is given.
HWY_INLINE V at_pixels(const Gradient& field, V dx, float dy) {
    return hn::MulAdd(set(field.x), dx, set(field.value + field.y * dy));
}

template <bool kMasked>
HWY_INLINE V light_on(const Facet& facet, const MeshMask& mask, float entrance_width, int x,
                      float dy) {
    const V dx = hn::Iota(D(), static_cast<float>(x) + 0.5F - facet.a_x);
    V radiance = at_pixels(facet.radiance, dx, dy);
    if constexpr (kMasked) {
        const auto field = [&](const Gradient& gradient) {
            return MaskField{at_pixels(gradient, dx, dy), set(gradient.x), set(gradient.y)};
        };
        MaskPlace at;
        at.u = field(facet.u);
        at.v = field(facet.v);
        at.clip = field(facet.clip);
        at.entrance_x = at_pixels(facet.entrance_x, dx, dy);
        at.entrance_y = at_pixels(facet.entrance_y, dx, dy);
        at.entrance_width = entrance_width;
        radiance = hn::Mul(radiance, light_at(mask, at));
    }
    return radiance;
}

template <bool kMasked>
void draw_triangle(const Mesh& mesh, const Triangle& t, const MeshMask& mask,
                   const MeshTile& tile) {
    const D d;
    const hn::Rebind<std::int32_t, D> di;
    const auto [least, most] = std::minmax({t.a.y, t.b.y, t.c.y});
    // Rows whose middles are within.
    const int y0 = std::max(tile.y0, static_cast<int>(std::ceil(least - 0.5F)));
    const int y1 = std::min(tile.y1, static_cast<int>(std::ceil(most - 0.5F)));
    if (y0 >= y1) return;
    const Plane plane(t);
    Facet facet;
    facet.a_x = t.a.x;
    facet.a_y = t.a.y;
    facet.radiance = plane.of(mesh.radiance, t);
    float entrance_width = 0;
    if constexpr (kMasked) {
        facet.u = plane.of(mesh.u, t);
        facet.v = plane.of(mesh.v, t);
        facet.clip = plane.of(mesh.clip, t);
        if (mask.extra) {
            const auto entrance = [&](std::ptrdiff_t k) {
                const std::ptrdiff_t j = k / mesh.stride;
                const auto i = static_cast<float>(k - j * mesh.stride);
                return std::pair(mesh.entrance_x + i * mesh.entrance_step_x,
                                 mesh.entrance_y + static_cast<float>(j) * mesh.entrance_step_y);
            };
            const auto [ax, ay] = entrance(t.a.at);
            const auto [bx, by] = entrance(t.b.at);
            const auto [cx, cy] = entrance(t.c.at);
            facet.entrance_x = plane.through(ax, bx, cx);
            facet.entrance_y = plane.through(ay, by, cy);
            entrance_width = std::sqrt(std::abs(facet.entrance_x.x * facet.entrance_y.y -
                                                facet.entrance_x.y * facet.entrance_y.x));
        }
    }
    for (int first = y0; first < y1; first += kRowsAtOnce) {
        HWY_ALIGN std::int32_t begin[kRowsAtOnce];
        HWY_ALIGN std::int32_t end[kRowsAtOnce];
        for (int k = 0; k < kRowsAtOnce && first + k < y1; k += kLanes) {
            const V y = hn::Iota(d, static_cast<float>(first + k) + 0.5F);
            V low = set(1e9F);
            V high = set(-1e9F);
            cross(t.ab, y, low, high);
            cross(t.bc, y, low, high);
            cross(t.ac, y, low, high);
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
            const float dy = static_cast<float>(first + k) + 0.5F - facet.a_y;
            float* to = tile.sums + (first + k - tile.y0 + 1) * tile.stride + x - tile.x0 + 1;
            for (; x + kLanes <= end[k]; x += kLanes, to += kLanes) {
                const V light = light_on<kMasked>(facet, mask, entrance_width, x, dy);
                hn::StoreU(hn::Add(load(to), light), d, to);
            }
            if (x < end[k]) {
                const V light = light_on<kMasked>(facet, mask, entrance_width, x, dy);
                const M rest = hn::FirstN(d, static_cast<std::size_t>(end[k] - x));
                hn::StoreU(hn::Add(load(to), hn::IfThenElseZero(rest, light)), d, to);
            }
        }
    }
}

void draw(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile) {
    const std::ptrdiff_t s = mesh.stride;
    const int last = std::min(group.column + kGroup, mesh.columns - 2);
    const std::uint8_t* states = mesh.state + static_cast<std::ptrdiff_t>(group.row) * mesh.columns;
    const auto corner = [&](std::ptrdiff_t k) { return Corner{k, mesh.x[k], mesh.y[k]}; };
    std::ptrdiff_t at = group.row * s + group.column;
    Corner upper_left = corner(at);
    Corner lower_left = corner(at + s);
    Side left = side_between(upper_left, lower_left);
    for (int column = group.column; column < last; ++column, ++at) {
        const Corner upper_right = corner(at + 1);
        const Corner lower_right = corner(at + s + 1);
        const Side right = side_between(upper_right, lower_right);
        const auto weighs = [&](const Corner& c) { return mesh.smooth[c.at] > 0; };
        const std::uint8_t state = states[column];
        if ((state == kCellOpen || state == kCellMasked) &&
            (weighs(upper_left) || weighs(upper_right) || weighs(lower_left) ||
             weighs(lower_right))) {
            const Side upper = side_between(upper_left, upper_right);
            const Side lower = side_between(lower_left, lower_right);
            const Side diagonal = side_between(upper_left, lower_right);
            const Triangle above = {upper_left, upper_right, lower_right, upper, right, diagonal};
            const Triangle below = {upper_left, lower_left, lower_right, left, lower, diagonal};
            const auto draw_one =
                state == kCellMasked ? &draw_triangle<true> : &draw_triangle<false>;
            draw_one(mesh, above, mask, tile);
            draw_one(mesh, below, mask, tile);
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
void draw_facets(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                 const MeshTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(mesh, group, mask, tile);
}
}  // namespace aureole::lens
#endif
