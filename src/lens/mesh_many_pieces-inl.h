// Cells of many pieces: a lane for each piece of a cell. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_MANY_PIECES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_MANY_PIECES_INL_H_
#undef AUREOLE_LENS_MESH_MANY_PIECES_INL_H_
#else
#define AUREOLE_LENS_MESH_MANY_PIECES_INL_H_
#endif

#include "lens/mesh_cubics-inl.h"
#include "lens/mesh_mask-inl.h"
#include "lens/mesh_scatter-inl.h"
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// A field that is bilinear over a cell.
struct Bilinear {
    float first, right, down, both;
    Bilinear(const float* field, std::ptrdiff_t stride)
        : first(field[0]),
          right(field[1] - field[0]),
          down(field[stride] - field[0]),
          both(field[stride + 1] - field[stride] - right) {}

    HWY_INLINE V at(V i, V j) const {
        const V along = hn::MulAdd(set(both), j, set(right));
        return hn::MulAdd(along, i, hn::MulAdd(set(down), j, set(first)));
    }
    // With its changes over a piece.
    HWY_INLINE MaskField over_piece(V i, V j, V step_i, V step_j) const {
        return {at(i, j), hn::Mul(step_i, hn::MulAdd(set(both), j, set(right))),
                hn::Mul(step_j, hn::MulAdd(set(both), i, set(down)))};
    }
};

// The weight of the facets, linear over the two triangles of a cell.
struct FacetWeight {
    float first, last, right, down;  // at the vertices
    FacetWeight(const float* smooth, std::ptrdiff_t stride)
        : first(smooth[0]), last(smooth[stride + 1]), right(smooth[1]), down(smooth[stride]) {}

    bool is_zero() const { return first == 0 && last == 0 && right == 0 && down == 0; }
    HWY_INLINE V at(V i, V j) const {
        // Along the diagonal by the smaller of the two, then towards the third corner.
        const V on_diagonal = hn::MulAdd(hn::Min(i, j), set(last - first), set(first));
        const V to = hn::IfThenElse(hn::Gt(i, j), set(right - first), set(down - first));
        return hn::MulAdd(hn::Abs(hn::Sub(i, j)), to, on_diagonal);
    }
};

// Pieces in a row of a cell that are drawn together.
inline constexpr int kPart = 24;

// Do places within these bounds, which are those of corners, and what lies between and around them
// miss [low, high)?
HWY_INLINE M misses(V least, V most, int low, int high) {
    const V more = hn::MulAdd(set(0.5F), hn::Sub(most, least), set(1.5F));
    return hn::Or(hn::Lt(hn::Add(most, more), set(static_cast<float>(low))),
                  hn::Gt(hn::Sub(least, more), set(static_cast<float>(high))));
}

// The cells of a group that are drawn by many pieces.
class ManyPieces {
  public:
    ManyPieces(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask, const MeshTile& tile)
        : mesh_(mesh),
          mask_(mask),
          tile_(tile),
          row_(group.row),
          column_(group.column),
          first_(group.row * mesh.stride + group.column),
          x_(mesh.x + first_, mesh.stride),
          y_(mesh.y + first_, mesh.stride) {}

    // One cell, divided as given; in parts, of which a large cell has most elsewhere.
    void draw(int cell, int pieces_i, int pieces_j) const {
        Part part{.cell = cell, .pieces_i = pieces_i, .pieces_j = pieces_j};
        HWY_ALIGN float outside[kMostParts];
        for (part.first_j = 0; part.first_j < pieces_j; part.first_j += kPart) {
            part.count_j = std::min(kPart, pieces_j - part.first_j);
            const bool several = pieces_i > kPart || pieces_j > kPart;
            if (several) mark_outside(part, outside);
            for (part.first_i = 0; part.first_i < pieces_i; part.first_i += kPart) {
                part.count_i = std::min(kPart, pieces_i - part.first_i);
                if (!several || outside[part.first_i / kPart] == 0) draw_part(part);
            }
        }
    }

  private:
    static constexpr int kMostParts = kGroup;

    // Some of the pieces of a cell that is divided into so many.
    struct Part {
        int cell = 0;
        int pieces_i = 1, pieces_j = 1;
        int first_i = 0, first_j = 0, count_i = 0, count_j = 0;
    };

    // Of the parts side by side in the lines of `part`: 1 for those of which nothing falls into the
    // tile.
    void mark_outside(const Part& part, float* outside) const {
        const D d;
        const V upper = set(static_cast<float>(part.first_j) / static_cast<float>(part.pieces_j));
        const V lower = set(static_cast<float>(part.first_j + part.count_j) /
                            static_cast<float>(part.pieces_j));
        const V width = set(static_cast<float>(kPart) / static_cast<float>(part.pieces_i));
        for (int k = 0; k < kMostParts && k * kPart < part.pieces_i; k += kLanes) {
            const V left = hn::Min(hn::Mul(hn::Iota(d, static_cast<float>(k)), width), set(1));
            const V right = hn::Min(hn::Add(left, width), set(1));
            const auto miss = [&](const GroupCubics& cubics, int low, int high) {
                V least = set(1e9F);
                V most = set(-1e9F);
                for (const V j : {upper, lower}) {
                    V of_i[4];
                    line_at(cubics, part.cell, j, of_i);
                    for (const V i : {left, right}) {
                        const V value = hn::MulAdd(
                            hn::MulAdd(hn::MulAdd(of_i[3], i, of_i[2]), i, of_i[1]), i, of_i[0]);
                        least = hn::Min(least, value);
                        most = hn::Max(most, value);
                    }
                }
                return misses(least, most, low, high);
            };
            const M out = hn::Or(miss(y_, tile_.y0, tile_.y1), miss(x_, tile_.x0, tile_.x1));
            hn::Store(hn::IfThenElseZero(out, set(1)), d, outside + k);
        }
    }

    void draw_part(const Part& part) const {
        const D d;
        const std::ptrdiff_t s = mesh_.stride;
        const std::ptrdiff_t at = first_ + part.cell;
        const int column = column_ + part.cell;
        const bool masked =
            mesh_.state[static_cast<std::ptrdiff_t>(row_) * mesh_.columns + column] == kCellMasked;
        const auto pieces = static_cast<float>(part.pieces_i * part.pieces_j);
        const V step_i = set(1 / static_cast<float>(part.pieces_i));
        const V step_j = set(1 / static_cast<float>(part.pieces_j));
        const V per_line = set(1 / static_cast<float>(part.count_i));
        const V per_piece = set(mesh_.share[at] / pieces);
        const int count = part.count_i * part.count_j;
        const Bilinear power(mesh_.power + at, s);
        const FacetWeight faceted(mesh_.smooth + at, s);
        const bool some_faceted = !faceted.is_zero();
        const Bilinear u(mesh_.u + at, s);
        const Bilinear v(mesh_.v + at, s);
        const Bilinear clip(mesh_.clip + at, s);
        for (int first = 0; first < count; first += kLanes) {
            const V index = hn::Iota(d, static_cast<float>(first) + 0.5F);
            const V line = hn::Floor(hn::Mul(index, per_line));
            const V in_line = hn::NegMulAdd(line, set(static_cast<float>(part.count_i)), index);
            const V i = hn::Mul(hn::Add(in_line, set(static_cast<float>(part.first_i))), step_i);
            const V j =
                hn::Mul(hn::Add(line, set(static_cast<float>(part.first_j) + 0.5F)), step_j);
            const PiecePosition y(y_, part.cell, i, j, step_i, step_j);
            const PiecePosition x(x_, part.cell, i, j, step_i, step_j);
            const M exist =
                hn::FirstN(d, static_cast<std::size_t>(std::min(kLanes, count - first)));
            const M seen = hn::And(exist, near(tile_, x.value, y.value));
            if (hn::AllFalse(d, seen)) continue;
            V energy = hn::Mul(per_piece, power.at(i, j));
            if (some_faceted) energy = hn::NegMulAdd(energy, faceted.at(i, j), energy);
            if (masked) {
                MaskPlace place;
                place.u = u.over_piece(i, j, step_i, step_j);
                place.v = v.over_piece(i, j, step_i, step_j);
                place.clip = clip.over_piece(i, j, step_i, step_j);
                place.entrance_x = hn::MulAdd(hn::Add(i, set(static_cast<float>(column))),
                                              set(mesh_.entrance_step_x), set(mesh_.entrance_x));
                place.entrance_y = hn::MulAdd(hn::Add(j, set(static_cast<float>(row_))),
                                              set(mesh_.entrance_step_y), set(mesh_.entrance_y));
                place.entrance_width =
                    std::sqrt(mesh_.entrance_step_x * mesh_.entrance_step_y / pieces);
                energy = hn::Mul(energy, light_at(mask_, place));
            }
            scatter(tile_, lay(x.value, x.along, x.across, 1), lay(y.value, y.along, y.across, 1),
                    seen, energy);
        }
    }

    const Mesh& mesh_;
    const MeshMask& mask_;
    const MeshTile& tile_;
    int row_, column_;
    std::ptrdiff_t first_;  // vertex
    GroupCubics x_, y_;
};

// Draws each cell of a group, at most divided as the group is.
inline void draw_many(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                      const MeshTile& tile) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    const std::ptrdiff_t first = group.row * s + group.column;
    // 0 for cells that are not drawn here.
    HWY_ALIGN float along[kGroup];
    HWY_ALIGN float across[kGroup];
    bool some = false;
    for (int cell = 0; cell < kGroup; cell += kLanes) {
        const std::ptrdiff_t at = first + cell;
        const auto pieces = [&](std::ptrdiff_t step, std::ptrdiff_t side, int most) {
            const V cx = largest_changes(mesh.x + at, step, side);
            const V cy = largest_changes(mesh.y + at, step, side);
            const V length = hn::Sqrt(hn::MulAdd(cx, cx, hn::Mul(cy, cy)));
            const V count = hn::Ceil(hn::Mul(set(kCoarsePiecesPerPx), length));
            return hn::Min(hn::Max(count, set(1)), set(static_cast<float>(most)));
        };
        const V pieces_i = pieces(1, s, group.pieces_i);
        const V pieces_j = pieces(s, 1, group.pieces_j);
        const M one_part = hn::Le(hn::Max(pieces_i, pieces_j), set(kPart));
        const CellBounds x(mesh.x + at, s);
        const CellBounds y(mesh.y + at, s);
        const M beside = hn::And(one_part, hn::Or(misses(x.low, x.high, tile.x0, tile.x1),
                                                  misses(y.low, y.high, tile.y0, tile.y1)));
        const M drawn = hn::AndNot(beside, hn::And(cells_from(mesh, group.column + cell),
                                                   hn::Ne(load(mesh.share + at), hn::Zero(d))));
        some = some || !hn::AllFalse(d, drawn);
        hn::Store(hn::IfThenElseZero(drawn, pieces_i), d, along + cell);
        hn::Store(pieces_j, d, across + cell);
    }
    if (!some) return;
    const ManyPieces pieces(mesh, group, mask, tile);
    for (int cell = 0; cell < kGroup; ++cell) {
        if (along[cell] == 0) continue;
        pieces.draw(cell, static_cast<int>(along[cell]), static_cast<int>(across[cell]));
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
