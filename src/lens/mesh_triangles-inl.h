// Cells as triangles, and which pixels of a row these hold. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_TRIANGLES_INL_H_
#undef AUREOLE_LENS_MESH_TRIANGLES_INL_H_
#else
#define AUREOLE_LENS_MESH_TRIANGLES_INL_H_
#endif

#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

using DI = hn::Rebind<std::int32_t, D>;

// Rows of a cell that are measured together.
inline constexpr int kRowsAtOnce = 16;
static_assert(kRowsAtOnce % kLanes == 0);

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

// The cells of a group, divided into triangles above and below the diagonals.
class TriangleGroup {
  public:
    TriangleGroup(const Mesh& mesh, const MeshGroup& group, const MeshTile& tile)
        : mesh_(mesh), tile_(tile), first_(group.row * mesh.stride + group.column) {
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
    TriangleGroup(const TriangleGroup&) = delete;
    TriangleGroup& operator=(const TriangleGroup&) = delete;

    const Triangles& above() const { return above_; }
    const Triangles& below() const { return below_; }
    // Rows of the tile that a cell may have pixels in: [y0, y1).
    int y0(int cell) const { return y0_[cell]; }
    int y1(int cell) const { return y1_[cell]; }

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

    const Mesh& mesh_;
    const MeshTile& tile_;
    std::ptrdiff_t first_;  // vertex
    Sides upper_, left_, right_, lower_, diagonal_;
    Triangles above_, below_;
    HWY_ALIGN std::int32_t y0_[kGroup];
    HWY_ALIGN std::int32_t y1_[kGroup];
};

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
