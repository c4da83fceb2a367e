#include "lens/mesh_pieces.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_pieces.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_vectors-inl.h"
#include "lens/ray_iris-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// The cubic of Catmull and Rom between the middle two of four values, and its derivative.
struct Cubic {
    float value[4];
    float slope[4];
    explicit Cubic(float t) {
        const float t2 = t * t;
        const float t3 = t2 * t;
        value[0] = 0.5F * (2 * t2 - t - t3);
        value[1] = 0.5F * (3 * t3 - 5 * t2 + 2);
        value[2] = 0.5F * (4 * t2 + t - 3 * t3);
        value[3] = 0.5F * (t3 - t2);
        slope[0] = 0.5F * (4 * t - 1 - 3 * t2);
        slope[1] = 0.5F * (9 * t2 - 10 * t);
        slope[2] = 0.5F * (8 * t + 1 - 9 * t2);
        slope[3] = 0.5F * (3 * t2 - 2 * t);
    }
};

HWY_INLINE V weighted(const float w[4], const float* from, std::ptrdiff_t step) {
    V sum = hn::Mul(set(w[0]), load(from));
    sum = hn::MulAdd(set(w[1]), load(from + step), sum);
    sum = hn::MulAdd(set(w[2]), load(from + 2 * step), sum);
    return hn::MulAdd(set(w[3]), load(from + 3 * step), sum);
}

HWY_INLINE V between(float t, const float* from, std::ptrdiff_t step) {
    const V a = load(from);
    return hn::MulAdd(set(t), hn::Sub(load(from + step), a), a);
}

// The values of a group's vertices on a line across its cells, interpolated over rows: from the
// vertex before the group on.
constexpr int kLine = ((kGroup + 3 + kLanes - 1) / kLanes) * kLanes;

struct Line {
    HWY_ALIGN float x[kLine];
    HWY_ALIGN float y[kLine];
    HWY_ALIGN float xj[kLine];  // per piece across
    HWY_ALIGN float yj[kLine];
    HWY_ALIGN float power[kLine];
    HWY_ALIGN float upper_smooth[kLine];  // of the vertices above and below
    HWY_ALIGN float lower_smooth[kLine];
    HWY_ALIGN float u[kLine];
    HWY_ALIGN float v[kLine];
    HWY_ALIGN float clip[kLine];
    HWY_ALIGN float uj[kLine];
    HWY_ALIGN float vj[kLine];
    HWY_ALIGN float clipj[kLine];
};

// One coordinate along the group's line at t between its rows.
HWY_INLINE void follow_cubic(const float weights[4], const float* field, std::ptrdiff_t stride,
                             float* line) {
    for (int k = 0; k < kLine; k += kLanes) {
        hn::Store(weighted(weights, field + k, stride), D(), line + k);
    }
}

// Is the whole of a line outside [low, high]? Cubics stay within the range of their four vertices
// but for an eighth of it.
HWY_INLINE bool beside(const float* line, float low, float high) {
    // The last of these vectors overlaps the one before.
    V least = load(line + kGroup + 3 - kLanes);
    V most = least;
    for (int k = 0; k + kLanes <= kGroup; k += kLanes) {
        least = hn::Min(least, load(line + k));
        most = hn::Max(most, load(line + k));
    }
    const float a = lowest(least);
    const float b = highest(most);
    const float more = 0.125F * (b - a) + 1.5F;
    return b + more < low || a - more > high;
}

// The group's line at t between its rows. False if none of it falls into the tile.
HWY_INLINE bool interpolate_line(const Mesh& mesh, const MeshGroup& group, float t, bool masked,
                                 const MeshTile& tile, Line& line) {
    const D d;
    const Cubic cubic(t);
    const float step_j = 1 / static_cast<float>(group.pieces_j);
    const std::ptrdiff_t s = mesh.stride;
    const std::ptrdiff_t before = (group.row - 1) * s + group.column - 1;
    follow_cubic(cubic.value, mesh.y + before, s, line.y);
    if (beside(line.y, static_cast<float>(tile.y0), static_cast<float>(tile.y1))) return false;
    follow_cubic(cubic.value, mesh.x + before, s, line.x);
    if (beside(line.x, static_cast<float>(tile.x0), static_cast<float>(tile.x1))) return false;
    float slope[4];
    for (int k = 0; k < 4; ++k) slope[k] = cubic.slope[k] * step_j;
    follow_cubic(slope, mesh.x + before, s, line.xj);
    follow_cubic(slope, mesh.y + before, s, line.yj);
    for (int k = 0; k < kLine; k += kLanes) {
        const std::ptrdiff_t at = before + s + k;
        hn::Store(between(t, mesh.power + at, s), d, line.power + k);
        hn::Store(load(mesh.smooth + at), d, line.upper_smooth + k);
        hn::Store(load(mesh.smooth + at + s), d, line.lower_smooth + k);
        if (!masked) continue;
        const auto both = [&](const float* from, float* value, float* change) {
            const V a = load(from + at);
            const V difference = hn::Sub(load(from + at + s), a);
            hn::Store(hn::MulAdd(set(t), difference, a), d, value + k);
            hn::Store(hn::Mul(difference, set(step_j)), d, change + k);
        };
        both(mesh.u, line.u, line.uj);
        both(mesh.v, line.v, line.vj);
        both(mesh.clip, line.clip, line.clipj);
    }
    return true;
}

// How much of a piece is inside, from a distance that is 1 on the edge and its change over the
// piece in both directions.
HWY_INLINE V inside(V distance, V change_i, V change_j) {
    const V width = hn::Max(hn::Add(hn::Abs(change_i), hn::Abs(change_j)), set(1e-6F));
    const V covered = hn::Add(hn::Div(hn::Sub(set(1), distance), width), set(0.5F));
    return hn::Min(hn::Max(covered, hn::Zero(D())), set(1));
}

HWY_INLINE V light_through(const PieceMask& mask, const Mesh& mesh, const MeshGroup& group,
                           const Line& line, int lane, float t, float tj) {
    const D d;
    const float step_i = 1 / static_cast<float>(group.pieces_i);
    const auto value = [&](const float* from) { return between(t, from + lane + 1, 1); };
    const auto change = [&](const float* from) {
        return hn::Mul(set(step_i), hn::Sub(load(from + lane + 2), load(from + lane + 1)));
    };
    const V u = value(line.u);
    const V v = value(line.v);
    const V ui = change(line.u);
    const V vi = change(line.v);
    const V uj = value(line.uj);
    const V vj = value(line.vj);
    V light = inside(value(line.clip), change(line.clip), value(line.clipj));
    if (!mask.open) {
        const V distance = iris_distance(d, mask.iris, u, v);
        const V beside_i = iris_distance(d, mask.iris, hn::Add(u, ui), hn::Add(v, vi));
        const V beside_j = iris_distance(d, mask.iris, hn::Add(u, uj), hn::Add(v, vj));
        light = hn::Mul(light,
                        inside(distance, hn::Sub(beside_i, distance), hn::Sub(beside_j, distance)));
    }
    if (mask.extra) {
        HWY_ALIGN float us[kLanes];
        HWY_ALIGN float vs[kLanes];
        HWY_ALIGN float widths[kLanes];
        HWY_ALIGN float xs[kLanes];
        HWY_ALIGN float ys[kLanes];
        HWY_ALIGN float lights[kLanes];
        hn::Store(u, d, us);
        hn::Store(v, d, vs);
        // The side of a square as large as the piece is in the iris.
        const V area = hn::Abs(hn::MulSub(ui, vj, hn::Mul(uj, vi)));
        hn::Store(hn::Sqrt(area), d, widths);
        const V column = hn::Iota(d, static_cast<float>(group.column + lane) + t);
        hn::Store(hn::MulAdd(column, set(mesh.entrance_step_x), set(mesh.entrance_x)), d, xs);
        hn::Store(
            set(mesh.entrance_y + (static_cast<float>(group.row) + tj) * mesh.entrance_step_y), d,
            ys);
        hn::Store(light, d, lights);
        const float pieces =
            static_cast<float>(group.pieces_i) * static_cast<float>(group.pieces_j);
        mask.extra(mask.context, us, vs, widths, xs, ys,
                   std::sqrt(mesh.entrance_step_x * mesh.entrance_step_y / pieces), kLanes, lights);
        light = hn::Load(d, lights);
    }
    return light;
}

// The weight of the facets at (t, tj) of cells: linear over the same triangles.
HWY_INLINE V facet_weight(const Line& line, int lane, float t, float tj) {
    const float* upper = line.upper_smooth + lane + 1;
    const float* lower = line.lower_smooth + lane + 1;
    const V ends = hn::MulAdd(set(1 - std::max(t, tj)), load(upper),
                              hn::Mul(set(std::min(t, tj)), load(lower + 1)));
    return hn::MulAdd(set(std::abs(t - tj)), load(t > tj ? upper + 1 : lower), ends);
}

// A rectangle at most one pixel wide, laid over two pixels.
struct Overlap {
    V first;  // left or upper pixel
    V share;  // of the rectangle on it
};

HWY_INLINE Overlap lay(V middle, V width) {
    const V left = hn::NegMulAdd(set(0.5F), width, middle);
    const V first = hn::Floor(left);
    const V share = hn::Div(hn::Sub(hn::Add(first, set(1)), left), width);
    return {first, hn::Min(share, set(1))};
}

// Which of these positions are within a pixel of the tile.
HWY_INLINE M near(const MeshTile& tile, V x, V y) {
    const M columns = hn::And(hn::Gt(x, set(static_cast<float>(tile.x0 - 1))),
                              hn::Lt(x, set(static_cast<float>(tile.x1 + 1))));
    const M rows = hn::And(hn::Gt(y, set(static_cast<float>(tile.y0 - 1))),
                           hn::Lt(y, set(static_cast<float>(tile.y1 + 1))));
    return hn::And(columns, rows);
}

// Which rectangles have a pixel in the tile, from the first pixel of each.
HWY_INLINE M touching(const MeshTile& tile, V x, V y) {
    const M columns = hn::And(hn::Ge(x, set(static_cast<float>(tile.x0 - 1))),
                              hn::Lt(x, set(static_cast<float>(tile.x1))));
    const M rows = hn::And(hn::Ge(y, set(static_cast<float>(tile.y0 - 1))),
                           hn::Lt(y, set(static_cast<float>(tile.y1))));
    return hn::And(columns, rows);
}

HWY_INLINE void scatter(const MeshTile& tile, const Overlap& x, const Overlap& y, M kept,
                        V energy) {
    const D d;
    const hn::Rebind<std::int32_t, D> di;
    const std::size_t count = hn::CountTrue(d, kept);
    const V upper = hn::Mul(energy, y.share);
    const V lower = hn::Sub(energy, upper);
    const V upper_left = hn::Mul(upper, x.share);
    const V lower_left = hn::Mul(lower, x.share);
    const auto column = hn::ConvertTo(di, hn::Sub(x.first, set(static_cast<float>(tile.x0 - 1))));
    const auto row = hn::ConvertTo(di, hn::Sub(y.first, set(static_cast<float>(tile.y0 - 1))));
    const auto at =
        hn::Add(hn::Mul(row, hn::Set(di, static_cast<std::int32_t>(tile.stride))), column);
    HWY_ALIGN float parts[4][2 * kGroup];
    HWY_ALIGN std::int32_t offset[2 * kGroup];
    const V all[4] = {upper_left, hn::Sub(upper, upper_left), lower_left,
                      hn::Sub(lower, lower_left)};
    for (int k = 0; k < 4; ++k) hn::StoreU(hn::Compress(all[k], kept), d, parts[k]);
    hn::StoreU(hn::Compress(at, hn::RebindMask(di, kept)), di, offset);
    for (std::size_t k = 0; k < count; ++k) {
        float* to = tile.sums + offset[k];
        to[0] += parts[0][k];
        to[1] += parts[1][k];
        to += tile.stride;
        to[0] += parts[2][k];
        to[1] += parts[3][k];
    }
}

// The width of the rectangle with the second moment that the piece has along one axis.
HWY_INLINE V width_of(V change_i, V change_j) {
    const V width = hn::Sqrt(hn::MulAdd(change_i, change_i, hn::Mul(change_j, change_j)));
    return hn::Min(hn::Max(width, set(1e-3F)), set(1));
}

void draw(const Mesh& mesh, const MeshGroup& group, const PieceMask& mask, const MeshTile& tile) {
    const D d;
    Line line;
    const bool masked = group.masked || mask.extra != nullptr;
    const float step_i = 1 / static_cast<float>(group.pieces_i);
    const float step_j = 1 / static_cast<float>(group.pieces_j);
    const float* shares = mesh.share + group.row * mesh.stride + group.column;
    for (int b = 0; b < group.pieces_j; ++b) {
        const float tj = (static_cast<float>(b) + 0.5F) * step_j;
        if (!interpolate_line(mesh, group, tj, masked, tile, line)) continue;
        for (int lane = 0; lane < kGroup; lane += kLanes) {
            const V per_piece =
                hn::IfThenElseZero(cells_from(mesh, group.column + lane),
                                   hn::Mul(load(shares + lane), set(step_i * step_j)));
            const M drawn = hn::Ne(per_piece, hn::Zero(d));
            if (hn::AllFalse(d, drawn)) continue;
            for (int a = 0; a < group.pieces_i; ++a) {
                const float t = (static_cast<float>(a) + 0.5F) * step_i;
                const Cubic cubic(t);
                float slope[4];
                for (int k = 0; k < 4; ++k) slope[k] = cubic.slope[k] * step_i;
                const V middle_x = weighted(cubic.value, line.x + lane, 1);
                const V middle_y = weighted(cubic.value, line.y + lane, 1);
                if (hn::AllFalse(d, hn::And(drawn, near(tile, middle_x, middle_y)))) continue;
                const V xi = weighted(slope, line.x + lane, 1);
                const V yi = weighted(slope, line.y + lane, 1);
                const V xj = between(t, line.xj + lane + 1, 1);
                const V yj = between(t, line.yj + lane + 1, 1);
                V energy = hn::Mul(per_piece, between(t, line.power + lane + 1, 1));
                energy = hn::NegMulAdd(energy, facet_weight(line, lane, t, tj), energy);
                if (masked) {
                    energy = hn::Mul(energy, light_through(mask, mesh, group, line, lane, t, tj));
                }
                const Overlap x = lay(middle_x, width_of(xi, xj));
                const Overlap y = lay(middle_y, width_of(yi, yj));
                const M kept =
                    hn::And(touching(tile, x.first, y.first), hn::Gt(energy, hn::Zero(d)));
                if (!hn::AllFalse(d, kept)) scatter(tile, x, y, kept, energy);
            }
        }
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(draw);
void draw_pieces(const Mesh& mesh, const MeshGroup& group, const PieceMask& mask,
                 const MeshTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(mesh, group, mask, tile);
}
}  // namespace aureole::lens
#endif
