#include "lens/mesh_facets.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_facets.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_mask-inl.h"
#include "lens/mesh_triangles-inl.h"
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// Most facets are a few pixels wide.
using Short = hn::CappedTag<float, 8>;
constexpr int kShortLanes = static_cast<int>(hn::MaxLanes(Short()));

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
        : mesh_(mesh),
          mask_(mask),
          tile_(tile),
          first_(group.row * mesh.stride + group.column),
          triangles_(mesh, group, tile) {}

    // One cell.
    template <bool kMasked>
    void draw(int cell) const {
        const int y1 = triangles_.y1(cell);
        if (triangles_.y0(cell) >= y1) return;
        const Triangles& above = triangles_.above();
        const Triangles& below = triangles_.below();
        MaskedFacet masked_above;
        MaskedFacet masked_below;
        if constexpr (kMasked) {
            masked_above = masked_facet(above, cell);
            masked_below = masked_facet(below, cell);
        }
        for (int first = triangles_.y0(cell); first < y1; first += kRowsAtOnce) {
            const int rows = std::min(kRowsAtOnce, y1 - first);
            RowSpans of_above;
            RowSpans of_below;
            triangles_.measure_rows(cell, first, rows, of_above, of_below);
            float* row = tile_.sums + (first - tile_.y0 + 1) * tile_.stride - tile_.x0 + 1;
            for (int k = 0; k < rows; ++k, row += tile_.stride) {
                if constexpr (kMasked) {
                    add_masked(masked_above, of_above, above.radiance_x[cell], k, first, row);
                    add_masked(masked_below, of_below, below.radiance_x[cell], k, first, row);
                } else {
                    add_ramp(of_above, above.radiance_x[cell], k, row);
                    add_ramp(of_below, below.radiance_x[cell], k, row);
                }
            }
        }
    }

  private:
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
    TriangleGroup triangles_;
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
