#include "lens/mesh_facets.h"

#include <cmath>

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

using DI = hn::Rebind<std::int32_t, D>;

// Rows of a cell that are measured together.
constexpr int kRowsAtOnce = 16;
static_assert(kRowsAtOnce % kLanes == 0);

// Most facets are a few pixels wide.
using Short = hn::CappedTag<float, 8>;
constexpr int kShortLanes = static_cast<int>(hn::MaxLanes(Short()));

HWY_INLINE V safe_quotient(V a, V b) {
    const M zero = hn::Eq(b, hn::Zero(D()));
    return hn::Div(a, hn::IfThenElse(zero, set(1), b));
}

// Of a group of cells: a side of each, from its first vertex in the order of the mesh to its
// second. Both triangles that share it cross a row at the same float.
struct Sides {
    HWY_ALIGN float x[kGroup];
    HWY_ALIGN float y0[kGroup];
    HWY_ALIGN float y1[kGroup];
    HWY_ALIGN float dx_dy[kGroup];
};

// Of a group of cells: the triangles on one side of the diagonals from the first vertices to the
// last; the other two sides are given.
struct Triangles {
    const Sides* to_b = nullptr;  // from the first vertex to the second
    const Sides* to_c = nullptr;  // from there to the last
    std::ptrdiff_t b = 0;         // the second vertex, from the first on
    HWY_ALIGN float per_area[kGroup];
    HWY_ALIGN float radiance_x[kGroup];  // per pixel
    HWY_ALIGN float radiance_y[kGroup];
};

// A field that is linear over a triangle: at its first corner, and per pixel.
struct Gradient {
    float value = 0, x = 0, y = 0;
};

// What apertures need to know of a triangle.
struct MaskedFacet {
    float a_x = 0, a_y = 0;  // the first corner
    Gradient u, v, clip, entrance_x, entrance_y;
    float entrance_width = 0;
};

// Pixels of rows: where they begin, how many, and the radiance of the first.
struct RowSpans {
    HWY_ALIGN std::int32_t begin[kRowsAtOnce];
    HWY_ALIGN std::int32_t count[kRowsAtOnce];
    HWY_ALIGN float radiance[kRowsAtOnce];
};

// Widens [low, high] to where a side crosses rows at heights y. Of the two ends of a side one
// counts, so that a row that runs through a vertex crosses one of the two sides that meet there.
HWY_INLINE void cross(const Sides& side, int cell, V y, V& low, V& high) {
    const V y0 = set(side.y0[cell]);
    const M crossed = hn::Xor(hn::Le(y0, y), hn::Le(set(side.y1[cell]), y));
    const V x = hn::MulAdd(hn::Sub(y, y0), set(side.dx_dy[cell]), set(side.x[cell]));
    low = hn::IfThenElse(crossed, hn::Min(low, x), low);
    high = hn::IfThenElse(crossed, hn::Max(high, x), high);
}

// At pixels from (x, y) on, of which the position relative to the first corner is given.
HWY_INLINE V at_pixels(const Gradient& field, V dx, float dy) {
    return hn::MulAdd(set(field.x), dx, set(field.value + field.y * dy));
}

// How much light passes at pixels from x on, `dy` below the first corner.
HWY_INLINE V light_on(const MaskedFacet& facet, const MeshMask& mask, int x, float dy) {
    const V dx = hn::Iota(D(), static_cast<float>(x) + 0.5F - facet.a_x);
    const auto field = [&](const Gradient& gradient) {
        return MaskField{at_pixels(gradient, dx, dy), set(gradient.x), set(gradient.y)};
    };
    MaskPlace at;
    at.u = field(facet.u);
    at.v = field(facet.v);
    at.clip = field(facet.clip);
    at.entrance_x = at_pixels(facet.entrance_x, dx, dy);
    at.entrance_y = at_pixels(facet.entrance_y, dx, dy);
    at.entrance_width = facet.entrance_width;
    return light_at(mask, at);
}

class FacetGroup {
  public:
    FacetGroup(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile)
        : mesh_(mesh), mask_(mask), tile_(tile), first_(group.row * mesh.stride + group.column) {
        const std::ptrdiff_t s = mesh.stride;
        above_.to_b = &upper_;
        above_.to_c = &right_;
        above_.b = 1;
        below_.to_b = &left_;
        below_.to_c = &lower_;
        below_.b = s;
        for (int cell = 0; cell < kGroup; cell += kLanes) {
            measure_side(cell, 0, 1, upper_);
            measure_side(cell, 0, s, left_);
            measure_side(cell, 1, s + 1, right_);
            measure_side(cell, s, s + 1, lower_);
            measure_side(cell, 0, s + 1, diagonal_);
            measure_triangles(cell, above_);
            measure_triangles(cell, below_);
            measure_height(cell);
        }
    }

    // One cell.
    template <bool kMasked>
    void draw(int cell) const {
        const int y1 = y1_[cell];
        if (y0_[cell] >= y1) return;
        MaskedFacet above;
        MaskedFacet below;
        if constexpr (kMasked) {
            above = masked_facet(above_, cell);
            below = masked_facet(below_, cell);
        }
        for (int first = y0_[cell]; first < y1; first += kRowsAtOnce) {
            const int rows = std::min(kRowsAtOnce, y1 - first);
            RowSpans of_above;
            RowSpans of_below;
            measure_rows(cell, first, rows, of_above, of_below);
            float* row = tile_.sums + (first - tile_.y0 + 1) * tile_.stride - tile_.x0 + 1;
            for (int k = 0; k < rows; ++k, row += tile_.stride) {
                if constexpr (kMasked) {
                    add_masked(above, of_above, above_.radiance_x[cell], k, first, row);
                    add_masked(below, of_below, below_.radiance_x[cell], k, first, row);
                } else {
                    add_ramp(of_above, above_.radiance_x[cell], k, row);
                    add_ramp(of_below, below_.radiance_x[cell], k, row);
                }
            }
        }
    }

  private:
    void measure_side(int cell, std::ptrdiff_t from, std::ptrdiff_t to, Sides& side) const {
        const D d;
        const std::ptrdiff_t a = first_ + cell + from;
        const std::ptrdiff_t b = first_ + cell + to;
        const V x = load(mesh_.x + a);
        const V y0 = load(mesh_.y + a);
        const V y1 = load(mesh_.y + b);
        hn::Store(x, d, side.x + cell);
        hn::Store(y0, d, side.y0 + cell);
        hn::Store(y1, d, side.y1 + cell);
        // One that is level crosses no row.
        hn::Store(safe_quotient(hn::Sub(load(mesh_.x + b), x), hn::Sub(y1, y0)), d,
                  side.dx_dy + cell);
    }

    void measure_triangles(int cell, Triangles& t) const {
        const D d;
        const std::ptrdiff_t a = first_ + cell;
        const std::ptrdiff_t b = a + t.b;
        const std::ptrdiff_t c = a + mesh_.stride + 1;
        const auto from_a = [&](const float* field, std::ptrdiff_t at) {
            return hn::Sub(load(field + at), load(field + a));
        };
        const V bx = from_a(mesh_.x, b);
        const V by = from_a(mesh_.y, b);
        const V cx = from_a(mesh_.x, c);
        const V cy = from_a(mesh_.y, c);
        const V per_area = safe_quotient(set(1), hn::MulSub(bx, cy, hn::Mul(cx, by)));
        const V to_b = hn::Mul(from_a(mesh_.radiance, b), per_area);
        const V to_c = hn::Mul(from_a(mesh_.radiance, c), per_area);
        hn::Store(per_area, d, t.per_area + cell);
        hn::Store(hn::MulSub(to_b, cy, hn::Mul(to_c, by)), d, t.radiance_x + cell);
        hn::Store(hn::MulSub(to_c, bx, hn::Mul(to_b, cx)), d, t.radiance_y + cell);
    }

    // Rows whose middles are within.
    void measure_height(int cell) {
        const auto row = [&](V y) {
            const V whole = hn::Ceil(hn::Sub(y, set(0.5F)));
            return hn::ConvertTo(DI(), hn::Min(hn::Max(whole, set(static_cast<float>(tile_.y0))),
                                               set(static_cast<float>(tile_.y1))));
        };
        const CellBounds y(mesh_.y + first_ + cell, mesh_.stride);
        hn::Store(row(y.low), DI(), y0_ + cell);
        hn::Store(row(y.high), DI(), y1_ + cell);
    }

    // Of both triangles of a cell, in rows from `first` on.
    HWY_INLINE void measure_rows(int cell, int first, int rows, RowSpans& above,
                                 RowSpans& below) const {
        const D d;
        const V x_low = set(static_cast<float>(tile_.x0));
        const V x_high = set(static_cast<float>(tile_.x1));
        const V corner = set(mesh_.radiance[first_ + cell]);
        for (int k = 0; k < rows; k += kLanes) {
            const V y = hn::Iota(d, static_cast<float>(first + k) + 0.5F);
            const V dy = hn::Sub(y, set(diagonal_.y0[cell]));
            V diagonal_low = set(1e9F);
            V diagonal_high = set(-1e9F);
            cross(diagonal_, cell, y, diagonal_low, diagonal_high);
            const auto measure = [&](const Triangles& t, RowSpans& spans) {
                V low = diagonal_low;
                V high = diagonal_high;
                cross(*t.to_b, cell, y, low, high);
                cross(*t.to_c, cell, y, low, high);
                // Pixels whose middles are in [low, high).
                const auto whole = [&](V x) {
                    return hn::Min(hn::Max(hn::Ceil(hn::Sub(x, set(0.5F))), x_low), x_high);
                };
                const V begin = whole(low);
                hn::Store(hn::ConvertTo(DI(), begin), DI(), spans.begin + k);
                hn::Store(hn::ConvertTo(DI(), hn::Sub(whole(high), begin)), DI(), spans.count + k);
                const V dx = hn::Sub(hn::Add(begin, set(0.5F)), set(diagonal_.x[cell]));
                const V radiance = hn::MulAdd(set(t.radiance_x[cell]), dx,
                                              hn::MulAdd(set(t.radiance_y[cell]), dy, corner));
                hn::Store(radiance, d, spans.radiance + k);
            };
            measure(above_, above);
            measure(below_, below);
        }
    }

    // Adds a row of radiance that changes by `step` per pixel to a row that begins at x = 0.
    static HWY_INLINE void add_ramp(const RowSpans& spans, float step, int k, float* row) {
        const Short d;
        int count = spans.count[k];
        if (count <= 0) return;
        float* to = row + spans.begin[k];
        auto value = hn::MulAdd(hn::Iota(d, 0.0F), hn::Set(d, step), hn::Set(d, spans.radiance[k]));
        const auto more = hn::Set(d, step * static_cast<float>(kShortLanes));
        for (; count >= kShortLanes; count -= kShortLanes, to += kShortLanes) {
            hn::StoreU(hn::Add(hn::LoadU(d, to), value), d, to);
            value = hn::Add(value, more);
        }
        if (count <= 0) return;
        const auto rest = hn::FirstN(d, static_cast<std::size_t>(count));
        hn::StoreU(hn::Add(hn::LoadU(d, to), hn::IfThenElseZero(rest, value)), d, to);
    }

    // The same, through apertures.
    void add_masked(const MaskedFacet& facet, const RowSpans& spans, float step, int row, int first,
                    float* to) const {
        const D d;
        const float dy = static_cast<float>(first + row) + 0.5F - facet.a_y;
        to += spans.begin[row];
        for (int k = 0; k < spans.count[row]; k += kLanes) {
            const V radiance =
                hn::MulAdd(hn::Iota(d, static_cast<float>(k)), set(step), set(spans.radiance[row]));
            const V light = hn::Mul(radiance, light_on(facet, mask_, spans.begin[row] + k, dy));
            const int left = std::min(kLanes, spans.count[row] - k);
            const M which = hn::FirstN(d, static_cast<std::size_t>(left));
            hn::StoreU(hn::Add(load(to + k), hn::IfThenElseZero(which, light)), d, to + k);
        }
    }

    MaskedFacet masked_facet(const Triangles& t, int cell) const {
        const std::ptrdiff_t a = first_ + cell;
        const std::ptrdiff_t b = a + t.b;
        const std::ptrdiff_t c = a + mesh_.stride + 1;
        const float bx = mesh_.x[b] - mesh_.x[a];
        const float by = mesh_.y[b] - mesh_.y[a];
        const float cx = mesh_.x[c] - mesh_.x[a];
        const float cy = mesh_.y[c] - mesh_.y[a];
        const auto through = [&](float at_a, float at_b, float at_c) {
            const float to_b = (at_b - at_a) * t.per_area[cell];
            const float to_c = (at_c - at_a) * t.per_area[cell];
            return Gradient{at_a, to_b * cy - to_c * by, to_c * bx - to_b * cx};
        };
        const auto of = [&](const float* field) { return through(field[a], field[b], field[c]); };
        MaskedFacet facet;
        facet.a_x = mesh_.x[a];
        facet.a_y = mesh_.y[a];
        facet.u = of(mesh_.u);
        facet.v = of(mesh_.v);
        facet.clip = of(mesh_.clip);
        if (mask_.extra == nullptr) return facet;
        const auto entrance = [&](std::ptrdiff_t at, float& x, float& y) {
            const std::ptrdiff_t j = at / mesh_.stride;
            x = mesh_.entrance_x +
                static_cast<float>(at - j * mesh_.stride) * mesh_.entrance_step_x;
            y = mesh_.entrance_y + static_cast<float>(j) * mesh_.entrance_step_y;
        };
        float x[3];
        float y[3];
        entrance(a, x[0], y[0]);
        entrance(b, x[1], y[1]);
        entrance(c, x[2], y[2]);
        facet.entrance_x = through(x[0], x[1], x[2]);
        facet.entrance_y = through(y[0], y[1], y[2]);
        facet.entrance_width = std::sqrt(std::abs(facet.entrance_x.x * facet.entrance_y.y -
                                                  facet.entrance_x.y * facet.entrance_y.x));
        return facet;
    }

    const Mesh& mesh_;
    const MeshMask& mask_;
    const MeshTile& tile_;
    std::ptrdiff_t first_;  // vertex
    Sides upper_, left_, right_, lower_, diagonal_;
    Triangles above_, below_;
    HWY_ALIGN std::int32_t y0_[kGroup];
    HWY_ALIGN std::int32_t y1_[kGroup];
};

void draw(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile) {
    const FacetGroup facets(mesh, group, mask, tile);
    const int count = std::min(kGroup, mesh.columns - 2 - group.column);
    const std::uint8_t* states =
        mesh.state + static_cast<std::ptrdiff_t>(group.row) * mesh.columns + group.column;
    const float* upper = mesh.smooth + group.row * mesh.stride + group.column;
    const float* lower = upper + mesh.stride;
    for (int cell = 0; cell < count; ++cell) {
        const bool weighs =
            upper[cell] > 0 || upper[cell + 1] > 0 || lower[cell] > 0 || lower[cell + 1] > 0;
        if (!weighs) continue;
        if (states[cell] == kCellOpen) facets.draw<false>(cell);
        if (states[cell] == kCellMasked) facets.draw<true>(cell);
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
