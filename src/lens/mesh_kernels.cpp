#include "lens/mesh_kernels.h"

#include <algorithm>
#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/ray_iris-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<float, kGroup>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

V set(float value) { return hn::Set(D(), value); }
V load(const float* from) { return hn::LoadU(D(), from); }

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
    HWY_ALIGN float u[kLine];
    HWY_ALIGN float v[kLine];
    HWY_ALIGN float clip[kLine];
    HWY_ALIGN float uj[kLine];
    HWY_ALIGN float vj[kLine];
    HWY_ALIGN float clipj[kLine];
};

// Along the group's line at t between its rows.
HWY_INLINE void interpolate_line(const Mesh& mesh, const MeshGroup& group, float t, bool masked,
                                 Line& line) {
    const D d;
    const Cubic cubic(t);
    const float step_j = 1 / static_cast<float>(group.pieces_j);
    const std::ptrdiff_t s = mesh.stride;
    const std::ptrdiff_t before = (group.row - 1) * s + group.column - 1;
    float slope[4];
    for (int k = 0; k < 4; ++k) slope[k] = cubic.slope[k] * step_j;
    for (int k = 0; k < kLine; k += kLanes) {
        const std::ptrdiff_t at = before + k;
        hn::Store(weighted(cubic.value, mesh.x + at, s), d, line.x + k);
        hn::Store(weighted(cubic.value, mesh.y + at, s), d, line.y + k);
        hn::Store(weighted(slope, mesh.x + at, s), d, line.xj + k);
        hn::Store(weighted(slope, mesh.y + at, s), d, line.yj + k);
        hn::Store(between(t, mesh.power + at + s, s), d, line.power + k);
        if (!masked) continue;
        const auto both = [&](const float* from, float* value, float* change) {
            const V a = load(from + at + s);
            const V difference = hn::Sub(load(from + at + 2 * s), a);
            hn::Store(hn::MulAdd(set(t), difference, a), d, value + k);
            hn::Store(hn::Mul(difference, set(step_j)), d, change + k);
        };
        both(mesh.u, line.u, line.uj);
        both(mesh.v, line.v, line.vj);
        both(mesh.clip, line.clip, line.clipj);
    }
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

HWY_INLINE void scatter(const MeshTile& tile, const Overlap& x, const Overlap& y, V energy) {
    const D d;
    const hn::Rebind<std::int32_t, D> di;
    const M kept = hn::And(hn::And(hn::Ne(energy, hn::Zero(d)),
                                   hn::And(hn::Ge(x.first, set(static_cast<float>(tile.x0 - 1))),
                                           hn::Lt(x.first, set(static_cast<float>(tile.x1))))),
                           hn::And(hn::Ge(y.first, set(static_cast<float>(tile.y0 - 1))),
                                   hn::Lt(y.first, set(static_cast<float>(tile.y1)))));
    const std::size_t count = hn::CountTrue(d, kept);
    if (count == 0) return;
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
    if (count == static_cast<std::size_t>(kLanes)) {
        for (int k = 0; k < 4; ++k) hn::Store(all[k], d, parts[k]);
        hn::Store(at, di, offset);
    } else {
        for (int k = 0; k < 4; ++k) hn::StoreU(hn::Compress(all[k], kept), d, parts[k]);
        hn::StoreU(hn::Compress(at, hn::RebindMask(di, kept)), di, offset);
    }
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

// Is the whole of a line outside [low, high]? Cubics stay within the range of their four vertices
// but for an eighth of it.
HWY_INLINE bool beside(const float* values, float low, float high) {
    V least = load(values);
    V most = least;
    for (int k = kLanes; k + kLanes <= kGroup; k += kLanes) {
        least = hn::Min(least, load(values + k));
        most = hn::Max(most, load(values + k));
    }
    // The last three.
    const V last = load(values + kGroup + 3 - kLanes);
    const float a = hn::GetLane(hn::MinOfLanes(D(), hn::Min(least, last)));
    const float b = hn::GetLane(hn::MaxOfLanes(D(), hn::Max(most, last)));
    const float more = 0.125F * (b - a) + 1.5F;
    return b + more < low || a - more > high;
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
        interpolate_line(mesh, group, tj, masked, line);
        if (beside(line.y, static_cast<float>(tile.y0), static_cast<float>(tile.y1)) ||
            beside(line.x, static_cast<float>(tile.x0), static_cast<float>(tile.x1))) {
            continue;
        }
        for (int lane = 0; lane < kGroup; lane += kLanes) {
            const M exist = hn::FirstN(d, static_cast<std::size_t>(std::clamp(
                                              mesh.columns - 2 - group.column - lane, 0, kLanes)));
            const V per_piece =
                hn::IfThenElseZero(exist, hn::Mul(load(shares + lane), set(step_i * step_j)));
            if (hn::AllTrue(d, hn::Eq(per_piece, hn::Zero(d)))) continue;
            for (int a = 0; a < group.pieces_i; ++a) {
                const float t = (static_cast<float>(a) + 0.5F) * step_i;
                const Cubic cubic(t);
                float slope[4];
                for (int k = 0; k < 4; ++k) slope[k] = cubic.slope[k] * step_i;
                const V x = weighted(cubic.value, line.x + lane, 1);
                const V y = weighted(cubic.value, line.y + lane, 1);
                const V xi = weighted(slope, line.x + lane, 1);
                const V yi = weighted(slope, line.y + lane, 1);
                const V xj = between(t, line.xj + lane + 1, 1);
                const V yj = between(t, line.yj + lane + 1, 1);
                V energy = hn::Mul(per_piece, between(t, line.power + lane + 1, 1));
                if (masked) {
                    energy = hn::Mul(energy, light_through(mask, mesh, group, line, lane, t, tj));
                }
                scatter(tile, lay(x, width_of(xi, xj)), lay(y, width_of(yi, yj)), energy);
            }
        }
    }
}

struct CellBounds {
    V low, high;
    CellBounds(const float* from, std::ptrdiff_t stride) {
        const V a = load(from);
        const V b = load(from + 1);
        const V c = load(from + stride);
        const V e = load(from + stride + 1);
        low = hn::Min(hn::Min(a, b), hn::Min(c, e));
        high = hn::Max(hn::Max(a, b), hn::Max(c, e));
    }
};

// The largest change of a field along a cell: of its parabola, which at a fold goes out and back.
HWY_INLINE V change_along_side(const float* from, std::ptrdiff_t step) {
    const V a = load(from);
    const V b = load(from + step);
    const V bend = hn::Sub(hn::Add(load(from - step), load(from + 2 * step)), hn::Add(a, b));
    return hn::MulAdd(set(0.25F), hn::Abs(bend), hn::Abs(hn::Sub(b, a)));
}
HWY_INLINE V change_along(const float* from, std::ptrdiff_t step, std::ptrdiff_t beside) {
    return hn::Max(change_along_side(from, step), change_along_side(from + beside, step));
}

HWY_INLINE V third_difference(const float* from, std::ptrdiff_t step) {
    const V outer = hn::Sub(load(from + 2 * step), load(from - step));
    const V middle = hn::Sub(load(from + step), load(from));
    return hn::Abs(hn::NegMulAdd(set(3), middle, outer));
}

// Cells wider than this many pixels are refined: most of what they are is elsewhere.
constexpr float kLargestCell = 64;
constexpr float kMostPieces = 128;

int classify(const Mesh& mesh, const ClassifyOptions& options, std::uint8_t* state,
             MeshGroup* groups) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    int count = 0;
    std::fill(state, state + static_cast<std::ptrdiff_t>(mesh.columns) * mesh.rows, kCellDead);
    for (int row = 1; row + 2 < mesh.rows; ++row) {
        for (int column = 1; column + 2 < mesh.columns; column += kGroup) {
            MeshGroup group;
            group.row = static_cast<std::int16_t>(row);
            group.column = static_cast<std::int16_t>(column);
            V along = hn::Zero(d);
            V across = hn::Zero(d);
            V x0 = set(1e9F);
            V y0 = set(1e9F);
            V x1 = set(-1e9F);
            V y1 = set(-1e9F);
            bool any = false;
            for (int lane = 0; lane < kGroup; lane += kLanes) {
                const std::ptrdiff_t at = row * s + column + lane;
                const M exists = hn::FirstN(d, static_cast<std::size_t>(std::clamp(
                                                   mesh.columns - 2 - column - lane, 0, kLanes)));
                const CellBounds clip(mesh.clip + at, s);
                const CellBounds us(mesh.u + at, s);
                const CellBounds vs(mesh.v + at, s);
                // Distances of the iris' axis: at the nearest and farthest corner of the box.
                const V far_u = hn::Max(hn::Abs(us.low), hn::Abs(us.high));
                const V far_v = hn::Max(hn::Abs(vs.low), hn::Abs(vs.high));
                const V near_u = hn::Max(hn::Max(us.low, hn::Neg(us.high)), hn::Zero(d));
                const V near_v = hn::Max(hn::Max(vs.low, hn::Neg(vs.high)), hn::Zero(d));
                const V far = hn::Sqrt(hn::MulAdd(far_u, far_u, hn::Mul(far_v, far_v)));
                const V near = hn::Sqrt(hn::MulAdd(near_u, near_u, hn::Mul(near_v, near_v)));
                const V lost = set(kLostRay);
                const M all_there = hn::Lt(clip.high, lost);
                const V spread = hn::Mul(set(0.25F), hn::Sub(clip.high, clip.low));
                const M passes = hn::And(
                    hn::And(exists, hn::Lt(hn::Sub(clip.low, spread), set(1))),
                    hn::And(hn::Lt(clip.low, lost), hn::Lt(near, set(options.outer_radius))));
                const M corner_missing =
                    hn::AndNot(all_there, hn::And(passes, hn::Lt(clip.low, set(1))));
                const M live = hn::And(passes, all_there);
                // Where it is.
                const CellBounds xs(mesh.x + at, s);
                const CellBounds ys(mesh.y + at, s);
                const V reach_x =
                    hn::MulAdd(set(0.25F), hn::Sub(xs.high, xs.low), set(1.5F + options.blur_px));
                const V reach_y =
                    hn::MulAdd(set(0.25F), hn::Sub(ys.high, ys.low), set(1.5F + options.blur_px));
                const V low_x = hn::Sub(xs.low, reach_x);
                const V low_y = hn::Sub(ys.low, reach_y);
                const V high_x = hn::Add(xs.high, reach_x);
                const V high_y = hn::Add(ys.high, reach_y);
                const M seen = hn::And(
                    hn::And(hn::Gt(high_x, set(options.x0)), hn::Lt(low_x, set(options.x1))),
                    hn::And(hn::Gt(high_y, set(options.y0)), hn::Lt(low_y, set(options.y1))));
                // How far a cubic through these rays may be off (half of t (2 t - 1)(t - 1) / 6 at
                // its largest, per third difference).
                V off = hn::Zero(d);
                for (const std::ptrdiff_t r : {std::ptrdiff_t{0}, s}) {
                    off = hn::Max(off, third_difference(mesh.x + at + r, 1));
                    off = hn::Max(off, third_difference(mesh.y + at + r, 1));
                }
                for (const std::ptrdiff_t r : {std::ptrdiff_t{0}, std::ptrdiff_t{1}}) {
                    off = hn::Max(off, third_difference(mesh.x + at + r, s));
                    off = hn::Max(off, third_difference(mesh.y + at + r, s));
                }
                const V extent = hn::Max(hn::Sub(xs.high, xs.low), hn::Sub(ys.high, ys.low));
                const M rough = hn::Or(hn::Gt(hn::Mul(off, set(0.016F)), set(options.tolerance_px)),
                                       hn::Gt(extent, set(kLargestCell)));
                const M drawn = hn::And(live, seen);
                const M refined = hn::Or(hn::And(drawn, rough), corner_missing);
                hn::StoreU(hn::IfThenElseZero(drawn, set(1)), d, mesh.share + at);
                for (int k = 0; k < kLanes && column + lane + k + 2 < mesh.columns; ++k) {
                    state[static_cast<std::ptrdiff_t>(row) * mesh.columns + column + lane + k] =
                        kCellDead;
                }
                if (!hn::AllFalse(d, hn::Or(drawn, refined))) {
                    HWY_ALIGN float kinds[kLanes];
                    hn::Store(hn::IfThenElse(refined, set(2), hn::IfThenElseZero(drawn, set(1))), d,
                              kinds);
                    for (int k = 0; k < kLanes && column + lane + k + 2 < mesh.columns; ++k) {
                        state[static_cast<std::ptrdiff_t>(row) * mesh.columns + column + lane + k] =
                            static_cast<std::uint8_t>(kinds[k]);
                    }
                }
                if (hn::AllFalse(d, drawn)) continue;
                any = true;
                along = hn::Max(
                    along, hn::IfThenElseZero(drawn, hn::Max(change_along(mesh.x + at, 1, s),
                                                             change_along(mesh.y + at, 1, s))));
                across = hn::Max(
                    across, hn::IfThenElseZero(drawn, hn::Max(change_along(mesh.x + at, s, 1),
                                                              change_along(mesh.y + at, s, 1))));
                x0 = hn::Min(x0, hn::IfThenElse(drawn, low_x, set(1e9F)));
                y0 = hn::Min(y0, hn::IfThenElse(drawn, low_y, set(1e9F)));
                x1 = hn::Max(x1, hn::IfThenElse(drawn, high_x, set(-1e9F)));
                y1 = hn::Max(y1, hn::IfThenElse(drawn, high_y, set(-1e9F)));
                const M cut = hn::Or(hn::Gt(hn::Add(clip.high, spread), set(1)),
                                     hn::Gt(far, set(options.inner_radius)));
                if (!hn::AllFalse(d, hn::And(drawn, cut))) group.masked = true;
            }
            if (!any) continue;
            const auto pieces = [&](V change) {
                const float most = hn::GetLane(hn::MaxOfLanes(d, change));
                return static_cast<std::int16_t>(
                    std::clamp(std::ceil(1.05F * most), 1.0F, kMostPieces));
            };
            group.pieces_i = pieces(along);
            group.pieces_j = pieces(across);
            group.x0 = hn::GetLane(hn::MinOfLanes(d, x0));
            group.y0 = hn::GetLane(hn::MinOfLanes(d, y0));
            group.x1 = hn::GetLane(hn::MaxOfLanes(d, x1));
            group.y1 = hn::GetLane(hn::MaxOfLanes(d, y1));
            groups[count++] = group;
        }
    }
    return count;
}

void flush(float* sums, int count, const float weight[3], float* const planes[3]) {
    const D d;
    const V r = set(weight[0]);
    const V g = set(weight[1]);
    const V b = set(weight[2]);
    int x = 0;
    for (; x + kLanes <= count; x += kLanes) {
        const V sum = load(sums + x);
        hn::StoreU(hn::MulAdd(r, sum, load(planes[0] + x)), d, planes[0] + x);
        hn::StoreU(hn::MulAdd(g, sum, load(planes[1] + x)), d, planes[1] + x);
        hn::StoreU(hn::MulAdd(b, sum, load(planes[2] + x)), d, planes[2] + x);
        hn::StoreU(hn::Zero(d), d, sums + x);
    }
    for (; x < count; ++x) {
        for (int c = 0; c < 3; ++c) planes[c][x] += weight[c] * sums[x];
        sums[x] = 0;
    }
}

void blur(const float* from, const float* weights, int taps, int count, float* to) {
    const D d;
    int x = 0;
    for (; x + 4 * kLanes <= count; x += 4 * kLanes) {
        V sum[4];
        for (int k = 0; k < 4; ++k) sum[k] = load(to + x + k * kLanes);
        for (int t = 0; t < taps; ++t) {
            const V w = set(weights[t]);
            for (int k = 0; k < 4; ++k) {
                sum[k] = hn::MulAdd(w, load(from + x + t + k * kLanes), sum[k]);
            }
        }
        for (int k = 0; k < 4; ++k) hn::StoreU(sum[k], d, to + x + k * kLanes);
    }
    for (; x < count; ++x) {
        for (int t = 0; t < taps; ++t) to[x] += weights[t] * from[x + t];
    }
}

}  // namespace

MeshKernels make_mesh_kernels() { return {&classify, &draw, &flush, &blur}; }

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(make_mesh_kernels);
const MeshKernels& mesh_kernels() {
    static const MeshKernels kernels = HWY_DYNAMIC_DISPATCH(make_mesh_kernels)();
    return kernels;
}
}  // namespace aureole::lens
#endif
