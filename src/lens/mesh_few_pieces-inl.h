// Cells of few pieces: a lane for each cell of a group. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_FEW_PIECES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_FEW_PIECES_INL_H_
#undef AUREOLE_LENS_MESH_FEW_PIECES_INL_H_
#else
#define AUREOLE_LENS_MESH_FEW_PIECES_INL_H_
#endif

#include "lens/mesh_mask-inl.h"
#include "lens/mesh_scatter-inl.h"
#include "lens/mesh_vectors-inl.h"

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
inline constexpr int kLine = ((kGroup + 3 + kLanes - 1) / kLanes) * kLanes;

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

HWY_INLINE V light_through(const MeshMask& mask, const Mesh& mesh, const MeshGroup& group,
                           const Line& line, int lane, float t, float tj) {
    const D d;
    const float step_i = 1 / static_cast<float>(group.pieces_i);
    const auto value = [&](const float* from) { return between(t, from + lane + 1, 1); };
    const auto change = [&](const float* from) {
        return hn::Mul(set(step_i), hn::Sub(load(from + lane + 2), load(from + lane + 1)));
    };
    MaskPlace at;
    at.u = {value(line.u), change(line.u), value(line.uj)};
    at.v = {value(line.v), change(line.v), value(line.vj)};
    at.clip = {value(line.clip), change(line.clip), value(line.clipj)};
    const V column = hn::Iota(d, static_cast<float>(group.column + lane) + t);
    at.entrance_x = hn::MulAdd(column, set(mesh.entrance_step_x), set(mesh.entrance_x));
    at.entrance_y =
        set(mesh.entrance_y + (static_cast<float>(group.row) + tj) * mesh.entrance_step_y);
    const float pieces = static_cast<float>(group.pieces_i) * static_cast<float>(group.pieces_j);
    at.entrance_width = std::sqrt(mesh.entrance_step_x * mesh.entrance_step_y / pieces);
    return light_at(mask, at);
}

// The weight of the facets at (t, tj) of cells: linear over the same triangles.
HWY_INLINE V facet_weight(const Line& line, int lane, float t, float tj) {
    const float* upper = line.upper_smooth + lane + 1;
    const float* lower = line.lower_smooth + lane + 1;
    const V ends = hn::MulAdd(set(1 - std::max(t, tj)), load(upper),
                              hn::Mul(set(std::min(t, tj)), load(lower + 1)));
    return hn::MulAdd(set(std::abs(t - tj)), load(t > tj ? upper + 1 : lower), ends);
}

// Cells of few pieces: a lane for each cell, one piece of each at a time.
inline void draw_few(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                     const MeshTile& tile) {
    const D d;
    Line line;
    const bool masked = group.masked;
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
                scatter(tile, lay(middle_x, xi, xj, 2), lay(middle_y, yi, yj, 2), drawn, energy);
            }
        }
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
