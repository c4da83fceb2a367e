#include "lens/mesh_pieces.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_pieces.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_mask-inl.h"
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
    // Two pixels of a row at a time.
    HWY_ALIGN float pairs[2][4 * kGroup];
    HWY_ALIGN std::int32_t offset[2 * kGroup];
    const auto store_pairs = [&](V left, V both, float* to) {
        left = hn::Compress(left, kept);
        hn::StoreInterleaved2(left, hn::Sub(hn::Compress(both, kept), left), d, to);
    };
    store_pairs(upper_left, upper, pairs[0]);
    store_pairs(lower_left, lower, pairs[1]);
    hn::StoreU(hn::Compress(at, hn::RebindMask(di, kept)), di, offset);
    const hn::CappedTag<float, 2> d2;
    for (std::size_t k = 0; k < count; ++k) {
        float* to = tile.sums + offset[k];
        for (int row_pair = 0; row_pair < 2; ++row_pair, to += tile.stride) {
            if constexpr (hn::MaxLanes(d2) == 2) {
                const auto pair = hn::Load(d2, pairs[row_pair] + 2 * k);
                hn::StoreU(hn::Add(hn::LoadU(d2, to), pair), d2, to);
            } else {
                to[0] += pairs[row_pair][2 * k];
                to[1] += pairs[row_pair][2 * k + 1];
            }
        }
    }
}

// How wide a piece is drawn along one axis: so many times as wide as a rectangle with the same
// second moment, and no wider than a pixel.
HWY_INLINE V width_of(V change_i, V change_j, float times) {
    const V own = hn::Sqrt(hn::MulAdd(change_i, change_i, hn::Mul(change_j, change_j)));
    return hn::Min(hn::Max(hn::Mul(set(times), own), set(1e-3F)), set(1));
}

// Cells of few pieces: a lane for each cell, one piece of each at a time.
void draw_cells(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
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
                const Overlap x = lay(middle_x, width_of(xi, xj, 2));
                const Overlap y = lay(middle_y, width_of(yi, yj, 2));
                const M kept =
                    hn::And(touching(tile, x.first, y.first), hn::Gt(energy, hn::Zero(d)));
                if (!hn::AllFalse(d, kept)) scatter(tile, x, y, kept, energy);
            }
        }
    }
}

// Weights of the four vertices before and after places t in [0, 1], and their derivatives.
struct Cubics {
    V value[4];
    V slope[4];
    explicit Cubics(V t) {
        const V half = set(0.5F);
        const V t2 = hn::Mul(t, t);
        const V rest = hn::Sub(set(1), t);
        const V rest2 = hn::Mul(rest, rest);
        // -t (1 - t)^2 / 2 and -t^2 (1 - t) / 2 outside; the inner two follow from the sums of
        // weights and of first moments.
        value[0] = hn::Neg(hn::Mul(half, hn::Mul(t, rest2)));
        value[3] = hn::Neg(hn::Mul(half, hn::Mul(t2, rest)));
        value[2] = hn::Sub(hn::Add(t, value[0]), hn::Add(value[3], value[3]));
        value[1] = hn::Sub(hn::Sub(set(1), value[2]), hn::Add(value[0], value[3]));
        slope[0] = hn::Mul(half, hn::Mul(rest, hn::MulSub(set(3), t, set(1))));
        slope[3] = hn::Mul(half, hn::Mul(t, hn::MulSub(set(3), t, set(2))));
        slope[2] = hn::Sub(hn::Add(set(1), slope[0]), hn::Add(slope[3], slope[3]));
        slope[1] = hn::Neg(hn::Add(slope[2], hn::Add(slope[0], slope[3])));
    }
};

HWY_INLINE V sum_of(const V weights[4], const V values[4]) {
    return hn::MulAdd(
        weights[0], values[0],
        hn::MulAdd(weights[1], values[1],
                   hn::MulAdd(weights[2], values[2], hn::Mul(weights[3], values[3]))));
}

// A coordinate over one cell from the 16 vertices around it, and its changes over a piece.
struct PiecePosition {
    V value, along, across;
    // `field` at the cell's first vertex; (i, j) at pieces of a cell divided as given.
    PiecePosition(const float* field, std::ptrdiff_t stride, const Cubics& i, const Cubics& j,
                  V step_i, V step_j) {
        V at[4];
        V across_at[2];  // of the inner columns, which is enough for the size of a piece
        for (int k = 0; k < 4; ++k) {
            V column[4];
            for (int m = 0; m < 4; ++m) column[m] = set(field[(m - 1) * stride + k - 1]);
            at[k] = sum_of(j.value, column);
            if (k == 1 || k == 2) across_at[k - 1] = sum_of(j.slope, column);
        }
        value = sum_of(i.value, at);
        along = hn::Mul(step_i, sum_of(i.slope, at));
        const V inner = hn::Add(i.value[1], i.value[2]);
        across = hn::Mul(hn::Div(step_j, inner),
                         hn::MulAdd(i.value[1], across_at[0], hn::Mul(i.value[2], across_at[1])));
    }
};

// Bilinear over a cell, and its changes over a piece.
HWY_INLINE MaskField bilinear(const float* field, std::ptrdiff_t stride, V i, V j, V step_i,
                              V step_j) {
    const V a = set(field[0]);
    const V right = set(field[1] - field[0]);
    const V down = set(field[stride] - field[0]);
    const V both = set(field[stride + 1] - field[stride] - field[1] + field[0]);
    const V along = hn::MulAdd(both, j, right);
    return {hn::MulAdd(along, i, hn::MulAdd(down, j, a)), hn::Mul(step_i, along),
            hn::Mul(step_j, hn::MulAdd(both, i, down))};
}

// The weight of the facets, linear over the two triangles of a cell.
HWY_INLINE V facet_weight(const float* smooth, std::ptrdiff_t stride, V i, V j) {
    const float ends = smooth[stride + 1] - smooth[0];
    const V low = hn::Min(i, j);
    const V beside = hn::IfThenElse(hn::Gt(i, j), set(smooth[1]), set(smooth[stride]));
    // Along the diagonal by the smaller of the two, then towards the third corner.
    const V on_diagonal = hn::MulAdd(low, set(ends), set(smooth[0]));
    const V apart = hn::Abs(hn::Sub(i, j));
    return hn::MulAdd(apart, hn::Sub(beside, set(smooth[0])), on_diagonal);
}

// Some of the pieces of a cell that is divided into so many.
struct CellPart {
    int row = 0, column = 0;
    int pieces_i = 1, pieces_j = 1;
    int first_i = 0, first_j = 0, count_i = 0, count_j = 0;
};

// Is all that a part draws outside the tile? It stays near the four corners of itself.
bool is_outside(const Mesh& mesh, const CellPart& part, const MeshTile& tile) {
    const auto outside = [&](const float* field, int low, int high) {
        float least = 1e9F;
        float most = -1e9F;
        for (const int corner : {0, 1, 2, 3}) {
            const Cubic i(static_cast<float>(part.first_i + (corner % 2) * part.count_i) /
                          static_cast<float>(part.pieces_i));
            const Cubic j(static_cast<float>(part.first_j + (corner / 2) * part.count_j) /
                          static_cast<float>(part.pieces_j));
            const float* before = field + (part.row - 1) * mesh.stride + part.column - 1;
            float sum = 0;
            for (int m = 0; m < 4; ++m) {
                const float* at = before + m * mesh.stride;
                sum += j.value[m] * (i.value[0] * at[0] + i.value[1] * at[1] + i.value[2] * at[2] +
                                     i.value[3] * at[3]);
            }
            least = std::min(least, sum);
            most = std::max(most, sum);
        }
        const float more = 0.5F * (most - least) + 1.5F;
        return most + more < static_cast<float>(low) || least - more > static_cast<float>(high);
    };
    return outside(mesh.y, tile.y0, tile.y1) || outside(mesh.x, tile.x0, tile.x1);
}

// Cells of many pieces, one cell at a time: a lane for each piece.
void draw_part(const Mesh& mesh, const CellPart& part, const MeshMask& mask, const MeshTile& tile) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    const std::ptrdiff_t at = part.row * s + part.column;
    const bool masked =
        mesh.state[static_cast<std::ptrdiff_t>(part.row) * mesh.columns + part.column] ==
        kCellMasked;
    const auto pieces = static_cast<float>(part.pieces_i * part.pieces_j);
    const V step_i = set(1 / static_cast<float>(part.pieces_i));
    const V step_j = set(1 / static_cast<float>(part.pieces_j));
    const V per_line = set(1 / static_cast<float>(part.count_i));
    const V per_piece = set(mesh.share[at] / pieces);
    const int count = part.count_i * part.count_j;
    for (int first = 0; first < count; first += kLanes) {
        const V index = hn::Iota(d, static_cast<float>(first) + 0.5F);
        const V line = hn::Floor(hn::Mul(index, per_line));
        const V in_line = hn::NegMulAdd(line, set(static_cast<float>(part.count_i)), index);
        const V i = hn::Mul(hn::Add(in_line, set(static_cast<float>(part.first_i))), step_i);
        const V j = hn::Mul(hn::Add(line, set(static_cast<float>(part.first_j) + 0.5F)), step_j);
        const Cubics cubic_i(i);
        const Cubics cubic_j(j);
        const PiecePosition y(mesh.y + at, s, cubic_i, cubic_j, step_i, step_j);
        const PiecePosition x(mesh.x + at, s, cubic_i, cubic_j, step_i, step_j);
        const M exist = hn::FirstN(d, static_cast<std::size_t>(std::min(kLanes, count - first)));
        if (hn::AllFalse(d, hn::And(exist, near(tile, x.value, y.value)))) continue;
        V energy = hn::Mul(per_piece, bilinear(mesh.power + at, s, i, j, step_i, step_j).value);
        energy = hn::NegMulAdd(energy, facet_weight(mesh.smooth + at, s, i, j), energy);
        if (masked) {
            MaskPlace place;
            place.u = bilinear(mesh.u + at, s, i, j, step_i, step_j);
            place.v = bilinear(mesh.v + at, s, i, j, step_i, step_j);
            place.clip = bilinear(mesh.clip + at, s, i, j, step_i, step_j);
            place.entrance_x = hn::MulAdd(hn::Add(i, set(static_cast<float>(part.column))),
                                          set(mesh.entrance_step_x), set(mesh.entrance_x));
            place.entrance_y = hn::MulAdd(hn::Add(j, set(static_cast<float>(part.row))),
                                          set(mesh.entrance_step_y), set(mesh.entrance_y));
            place.entrance_width = std::sqrt(mesh.entrance_step_x * mesh.entrance_step_y / pieces);
            energy = hn::Mul(energy, light_at(mask, place));
        }
        const Overlap on_x = lay(x.value, width_of(x.along, x.across, 1));
        const Overlap on_y = lay(y.value, width_of(y.along, y.across, 1));
        const M kept = hn::And(hn::And(exist, hn::Gt(energy, hn::Zero(d))),
                               touching(tile, on_x.first, on_y.first));
        if (!hn::AllFalse(d, kept)) scatter(tile, on_x, on_y, kept, energy);
    }
}

// In parts, most of which a large cell has elsewhere.
void draw_cell(const Mesh& mesh, int row, int column, int pieces_i, int pieces_j,
               const MeshMask& mask, const MeshTile& tile) {
    constexpr int kPart = 24;  // pieces
    CellPart part{.row = row, .column = column, .pieces_i = pieces_i, .pieces_j = pieces_j};
    for (part.first_j = 0; part.first_j < pieces_j; part.first_j += kPart) {
        part.count_j = std::min(kPart, pieces_j - part.first_j);
        for (part.first_i = 0; part.first_i < pieces_i; part.first_i += kPart) {
            part.count_i = std::min(kPart, pieces_i - part.first_i);
            if (!is_outside(mesh, part, tile)) draw_part(mesh, part, mask, tile);
        }
    }
}

void draw(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile) {
    constexpr int kFewPieces = 9;
    if (group.pieces_i * group.pieces_j <= kFewPieces) {
        draw_cells(mesh, group, mask, tile);
        return;
    }
    const std::ptrdiff_t s = mesh.stride;
    const int last = std::min(group.column + kGroup, mesh.columns - 2);
    for (int column = group.column; column < last; ++column) {
        const std::ptrdiff_t at = group.row * s + column;
        if (mesh.share[at] == 0) continue;
        const auto pieces = [&](std::ptrdiff_t step, std::ptrdiff_t beside, int most) {
            const float length = std::hypot(largest_change(mesh.x + at, step, beside),
                                            largest_change(mesh.y + at, step, beside));
            return pieces_for(length, kCoarsePiecesPerPx, static_cast<float>(most));
        };
        draw_cell(mesh, group.row, column, pieces(1, s, group.pieces_i),
                  pieces(s, 1, group.pieces_j), mask, tile);
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(draw);
void draw_pieces(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                 const MeshTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(mesh, group, mask, tile);
}
}  // namespace aureole::lens
#endif
