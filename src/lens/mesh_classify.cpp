#include "lens/mesh_classify.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_classify.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// Cells are refined whose cubics may be farther off than this (pixels), or that are larger than
// that, if their area also changes by more than this factor between corners: near folds. Elsewhere
// an error of position does not show.
constexpr float kRough = 0.25F;
constexpr float kLargestCell = 64;
constexpr float kRoughStretch = 2;
// Of a cell that is drawn by pieces; beyond, they no longer touch each other.
constexpr float kMostPieces = 128;
// Facets: cells with at least so many pixels between opposite sides, and areas that differ at most
// by so much between corners.
constexpr float kThinnestFacet = 1.5F;
constexpr float kMostStretch = 1.6F;

HWY_INLINE V third_difference(const float* from, std::ptrdiff_t step) {
    const V outer = hn::Sub(load(from + 2 * step), load(from - step));
    const V middle = hn::Sub(load(from + step), load(from));
    return hn::Abs(hn::NegMulAdd(set(3), middle, outer));
}

// How far cubics along the sides of cells may be off: t (2 t - 1) (t - 1) / 6 of the third
// difference, at its largest.
HWY_INLINE V cubic_error(const float* from, std::ptrdiff_t s) {
    const V along = hn::Max(third_difference(from, 1), third_difference(from + s, 1));
    const V across = hn::Max(third_difference(from, s), third_difference(from + 1, s));
    return hn::Mul(set(0.016F), hn::Max(along, across));
}

// Where a field of pixels may be between the corners, and a pixel around it.
struct Reach {
    V low, high;
    explicit Reach(const CellBounds& bounds) {
        const V more = hn::MulAdd(set(0.25F), hn::Sub(bounds.high, bounds.low), set(1.5F));
        low = hn::Sub(bounds.low, more);
        high = hn::Add(bounds.high, more);
    }
};

HWY_INLINE M meets(const Reach& reach, float low, float high) {
    return hn::And(hn::Gt(reach.high, set(low)), hn::Lt(reach.low, set(high)));
}

// Later ones win.
void store_states(M open, M masked, M refined, int count, std::uint8_t* to) {
    const D d;
    HWY_ALIGN float kinds[kLanes];
    V kind = hn::IfThenElseZero(open, set(kCellOpen));
    kind = hn::IfThenElse(masked, set(kCellMasked), kind);
    kind = hn::IfThenElse(refined, set(kCellRefined), kind);
    hn::Store(kind, d, kinds);
    for (int k = 0; k < count; ++k) {
        if (to[k] != kCellRefined) to[k] = static_cast<std::uint8_t>(kinds[k]);
    }
}

// Signed area that a cell would have if it were as around the vertex.
HWY_INLINE V area_around(const Mesh& mesh, std::ptrdiff_t at) {
    const std::ptrdiff_t s = mesh.stride;
    const auto change = [&](const float* field, std::ptrdiff_t step) {
        return hn::Sub(load(field + at + step), load(field + at - step));
    };
    const V cross = hn::MulSub(change(mesh.x, 1), change(mesh.y, s),
                               hn::Mul(change(mesh.y, 1), change(mesh.x, s)));
    return hn::Mul(set(0.25F), cross);
}

// Is an area, which has these bounds over cells, of one sign and much the same?
HWY_INLINE M is_even(V low, V high, float least, float most_ratio) {
    const auto positive = [&](V from, V to) {
        return hn::And(hn::Ge(from, set(least)), hn::Le(to, hn::Mul(from, set(most_ratio))));
    };
    return hn::Or(positive(low, high), positive(hn::Neg(high), hn::Neg(low)));
}

// At the corners of cells.
HWY_INLINE M is_nearly_even(const Mesh& mesh, std::ptrdiff_t at) {
    const V a = area_around(mesh, at);
    const V b = area_around(mesh, at + 1);
    const V c = area_around(mesh, at + mesh.stride);
    const V e = area_around(mesh, at + mesh.stride + 1);
    return is_even(hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Max(hn::Max(a, b), hn::Max(c, e)), 0,
                   kRoughStretch);
}

void classify(const Mesh& mesh, const ClassifyOptions& options) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    const std::ptrdiff_t cells = static_cast<std::ptrdiff_t>(mesh.columns) * mesh.rows;
    if (options.upsampled) {
        for (std::ptrdiff_t k = 0; k < cells; ++k) {
            if (mesh.state[k] != kCellRefined) mesh.state[k] = kCellDead;
        }
    } else {
        std::fill(mesh.state, mesh.state + cells, kCellDead);
    }
    for (int row = 1; row + 2 < mesh.rows; ++row) {
        for (int column = 1; column + 2 < mesh.columns; column += kLanes) {
            const std::ptrdiff_t at = row * s + column;
            const V lost = set(kLostRay);
            const CellBounds clip(mesh.clip + at, s);
            const CellBounds us(mesh.u + at, s);
            const CellBounds vs(mesh.v + at, s);
            // The nearest and the farthest that the cell comes to the axis of the iris.
            const V far_u = hn::Max(hn::Abs(us.low), hn::Abs(us.high));
            const V far_v = hn::Max(hn::Abs(vs.low), hn::Abs(vs.high));
            const V near_u = hn::Max(hn::Max(us.low, hn::Neg(us.high)), hn::Zero(d));
            const V near_v = hn::Max(hn::Max(vs.low, hn::Neg(vs.high)), hn::Zero(d));
            const V far = hn::Sqrt(hn::MulAdd(far_u, far_u, hn::Mul(far_v, far_v)));
            const V near = hn::Sqrt(hn::MulAdd(near_u, near_u, hn::Mul(near_v, near_v)));
            const V spread = hn::Mul(set(0.25F), hn::Sub(clip.high, clip.low));
            M passes = hn::And(cells_from(mesh, column), hn::Lt(clip.low, lost));
            passes = hn::And(passes, hn::Lt(near, set(options.outer_radius)));
            const M there = hn::Lt(clip.high, lost);
            // With a corner missing: refined if what is left of it passes.
            const M broken = hn::AndNot(there, hn::And(passes, hn::Lt(clip.low, set(1))));
            passes = hn::And(hn::And(passes, there), hn::Lt(hn::Sub(clip.low, spread), set(1)));

            const CellBounds xs(mesh.x + at, s);
            const CellBounds ys(mesh.y + at, s);
            const M drawn = hn::And(passes, hn::And(meets(Reach(xs), options.x0, options.x1),
                                                    meets(Reach(ys), options.y0, options.y1)));
            if (hn::AllFalse(d, hn::Or(drawn, broken))) continue;
            M refined = hn::FirstN(d, 0);
            if (!options.upsampled) {
                const V off = hn::Max(cubic_error(mesh.x + at, s), cubic_error(mesh.y + at, s));
                const V size = hn::Max(hn::Sub(xs.high, xs.low), hn::Sub(ys.high, ys.low));
                const M rough = hn::Or(hn::Gt(off, set(kRough)), hn::Gt(size, set(kLargestCell)));
                refined =
                    hn::Or(hn::AndNot(is_nearly_even(mesh, at), hn::And(drawn, rough)), broken);
            }
            M cut = hn::Or(hn::Gt(hn::Add(clip.high, spread), set(1)),
                           hn::Gt(far, set(options.inner_radius)));
            if (options.all_masked) cut = drawn;
            store_states(drawn, hn::And(drawn, cut), refined,
                         std::min(kLanes, mesh.columns - 2 - column),
                         mesh.state + static_cast<std::ptrdiff_t>(row) * mesh.columns + column);
        }
    }
}

// Is the shorter height of a parallelogram with these bounds of its area and its sides long enough?
HWY_INLINE M is_thick(const Mesh& mesh, std::ptrdiff_t at, V least_area) {
    const std::ptrdiff_t s = mesh.stride;
    const auto side2 = [&](std::ptrdiff_t step) {
        const V x = hn::Sub(load(mesh.x + at + step), load(mesh.x + at));
        const V y = hn::Sub(load(mesh.y + at + step), load(mesh.y + at));
        return hn::MulAdd(x, x, hn::Mul(y, y));
    };
    const V longer2 = hn::Max(side2(1), side2(s));
    return hn::Ge(hn::Mul(least_area, least_area),
                  hn::Mul(set(kThinnestFacet * kThinnestFacet), longer2));
}

// Weights of vertices: 1 where all is fit for facets, whether light passes or not, so that no
// aperture's edge is a border between the two ways of drawing; falling to 0 over some cells, since
// pieces are blurred by a pixel and facets are not. area[] by vertex receives that around it; fit[]
// is scratch.
void weigh_facets(const Mesh& mesh, float* area, float* fit) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    const auto for_vertices = [&](auto&& visit) {
        for (int row = 1; row + 1 < mesh.rows; ++row) {
            for (int column = 1; column + 1 < mesh.columns; column += kLanes) {
                visit(row * s + column);
            }
        }
    };
    for_vertices([&](std::ptrdiff_t at) { hn::StoreU(area_around(mesh, at), d, area + at); });
    std::fill(fit, fit + s * mesh.rows, 0.0F);
    for (int row = 1; row + 2 < mesh.rows; ++row) {
        const std::uint8_t* states = mesh.state + static_cast<std::ptrdiff_t>(row) * mesh.columns;
        for (int column = 1; column + 2 < mesh.columns; column += kLanes) {
            const std::ptrdiff_t at = row * s + column;
            const CellBounds areas(area + at, s);
            M fits = hn::And(is_even(areas.low, areas.high, 1e-3F, kMostStretch),
                             hn::Lt(CellBounds(mesh.clip + at, s).high, set(kLostRay)));
            const V least = hn::Min(hn::Abs(areas.low), hn::Abs(areas.high));
            fits = hn::And(fits, is_thick(mesh, at, least));
            hn::StoreU(hn::IfThenElseZero(hn::And(fits, cells_from(mesh, column)), set(1)), d,
                       fit + at);
        }
        for (int column = 1; column + 2 < mesh.columns; ++column) {
            if (states[column] == kCellRefined) fit[row * s + column] = 0;
        }
    }
    for_vertices([&](std::ptrdiff_t at) {
        const V all = hn::Mul(hn::Mul(load(fit + at), load(fit + at - 1)),
                              hn::Mul(load(fit + at - s), load(fit + at - s - 1)));
        hn::StoreU(all, d, mesh.smooth + at);
    });
    // Twice the mean with the neighbours, where it is not 0 anyway.
    for (int round = 0; round < 2; ++round) {
        std::copy(mesh.smooth, mesh.smooth + s * mesh.rows, fit);
        for_vertices([&](std::ptrdiff_t at) {
            const V own = load(fit + at);
            const auto of_row = [&](std::ptrdiff_t k) {
                return hn::Add(load(fit + k), hn::Add(load(fit + k - 1), load(fit + k + 1)));
            };
            const V mean = hn::Mul(hn::Add(of_row(at), hn::Add(of_row(at - s), of_row(at + s))),
                                   set(1.0F / 9));
            // Exactly 1 in the middle of ones.
            const V weight = hn::IfThenElse(hn::Ge(mean, set(0.9999F)), set(1), mean);
            hn::StoreU(hn::IfThenElseZero(hn::Gt(own, hn::Zero(d)), weight), d, mesh.smooth + at);
        });
    }
}

int divide(const Mesh& mesh, MeshGroup* groups) {
    const D d;
    const std::ptrdiff_t s = mesh.stride;
    std::fill(mesh.smooth, mesh.smooth + s * mesh.rows, 0.0F);
    std::fill(mesh.radiance, mesh.radiance + s * mesh.rows, 0.0F);
    weigh_facets(mesh, mesh.radiance, mesh.share);

    // Radiance of facets, and what makes their energy that of the cells.
    V wanted = hn::Zero(d);
    V given = hn::Zero(d);
    for (int row = 1; row + 1 < mesh.rows; ++row) {
        for (int column = 1; column + 1 < mesh.columns; column += kLanes) {
            const std::ptrdiff_t at = row * s + column;
            const V smooth = load(mesh.smooth + at);
            const V area = hn::Max(hn::Abs(load(mesh.radiance + at)), set(1e-6F));
            hn::StoreU(hn::Div(hn::Mul(smooth, load(mesh.power + at)), area), d,
                       mesh.radiance + at);
        }
    }
    // Energy of a triangle of each cell, as it is drawn and as it should be; twice and three times.
    const auto sum_triangle = [&](std::ptrdiff_t a, std::ptrdiff_t b, std::ptrdiff_t c, M which) {
        const auto x = [&](std::ptrdiff_t k) {
            return hn::Sub(load(mesh.x + k), load(mesh.x + a));
        };
        const auto y = [&](std::ptrdiff_t k) {
            return hn::Sub(load(mesh.y + k), load(mesh.y + a));
        };
        const auto sum = [&](auto&& value) {
            return hn::Add(value(a), hn::Add(value(b), value(c)));
        };
        const V area = hn::Abs(hn::MulSub(x(b), y(c), hn::Mul(x(c), y(b))));
        const V radiance = sum([&](std::ptrdiff_t k) { return load(mesh.radiance + k); });
        const V power = sum(
            [&](std::ptrdiff_t k) { return hn::Mul(load(mesh.smooth + k), load(mesh.power + k)); });
        given = hn::Add(given, hn::IfThenElseZero(which, hn::Mul(area, radiance)));
        wanted = hn::Add(wanted, hn::IfThenElseZero(which, power));
    };
    int count = 0;
    for (int row = 1; row + 2 < mesh.rows; ++row) {
        const std::uint8_t* states = mesh.state + static_cast<std::ptrdiff_t>(row) * mesh.columns;
        for (int column = 1; column + 2 < mesh.columns; column += kGroup) {
            MeshGroup pieces;
            pieces.row = static_cast<std::int16_t>(row);
            pieces.column = static_cast<std::int16_t>(column);
            MeshGroup facets = pieces;
            V along = hn::Zero(d);
            V across = hn::Zero(d);
            V x0 = set(1e9F);
            V y0 = set(1e9F);
            V x1 = set(-1e9F);
            V y1 = set(-1e9F);
            bool any_pieces = false;
            bool any_facets = false;
            for (int lane = 0; lane < kGroup; lane += kLanes) {
                const int first = column + lane;
                const int cells = std::min(kLanes, mesh.columns - 2 - first);
                HWY_ALIGN float kinds[kLanes] = {};
                for (int k = 0; k < cells; ++k) kinds[k] = states[first + k];
                const V kind = hn::Load(d, kinds);
                const std::ptrdiff_t at = row * s + first;
                const M drawn =
                    hn::Or(hn::Eq(kind, set(kCellOpen)), hn::Eq(kind, set(kCellMasked)));
                const CellBounds smooth(mesh.smooth + at, s);
                const M faceted = hn::And(drawn, hn::Gt(smooth.high, hn::Zero(d)));
                const M pieced = hn::And(drawn, hn::Lt(smooth.low, set(1)));
                hn::StoreU(hn::IfThenElseZero(pieced, set(1)), d, mesh.share + at);
                if (hn::AllFalse(d, drawn)) continue;
                if (!hn::AllFalse(d, faceted)) {
                    any_facets = true;
                    sum_triangle(at, at + 1, at + s + 1, faceted);
                    sum_triangle(at, at + s, at + s + 1, faceted);
                }
                if (!hn::AllFalse(d, pieced)) {
                    any_pieces = true;
                    const auto largest = [&](std::ptrdiff_t step, std::ptrdiff_t beside) {
                        const V x = largest_changes(mesh.x + at, step, beside);
                        const V y = largest_changes(mesh.y + at, step, beside);
                        return hn::IfThenElseZero(pieced,
                                                  hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y))));
                    };
                    along = hn::Max(along, largest(1, s));
                    across = hn::Max(across, largest(s, 1));
                }
                if (!hn::AllFalse(d, hn::Eq(kind, set(kCellMasked)))) {
                    facets.masked = pieces.masked = true;
                }
                const Reach x(CellBounds(mesh.x + at, s));
                const Reach y(CellBounds(mesh.y + at, s));
                x0 = hn::Min(x0, hn::IfThenElse(drawn, x.low, set(1e9F)));
                y0 = hn::Min(y0, hn::IfThenElse(drawn, y.low, set(1e9F)));
                x1 = hn::Max(x1, hn::IfThenElse(drawn, x.high, set(-1e9F)));
                y1 = hn::Max(y1, hn::IfThenElse(drawn, y.high, set(-1e9F)));
            }
            if (!any_pieces && !any_facets) continue;
            facets.x0 = pieces.x0 = lowest(x0);
            facets.y0 = pieces.y0 = lowest(y0);
            facets.x1 = pieces.x1 = highest(x1);
            facets.y1 = pieces.y1 = highest(y1);
            if (any_facets) groups[count++] = facets;
            if (any_pieces) {
                const auto parts = [](V change) {
                    return static_cast<std::int16_t>(
                        pieces_for(highest(change), kPiecesPerPx, kMostPieces));
                };
                pieces.pieces_i = parts(along);
                pieces.pieces_j = parts(across);
                groups[count++] = pieces;
            }
        }
    }
    const float sum = hn::GetLane(hn::SumOfLanes(d, given));
    const float scale = sum > 0 ? hn::GetLane(hn::SumOfLanes(d, wanted)) / sum : 1;
    for (std::ptrdiff_t k = 0; k < s * mesh.rows; k += kLanes) {
        hn::StoreU(hn::Mul(set(scale), load(mesh.radiance + k)), d, mesh.radiance + k);
    }
    return count;
}

}  // namespace

MeshClassifier make_mesh_classifier() { return {&classify, &divide}; }

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(make_mesh_classifier);
const MeshClassifier& mesh_classifier() {
    static const MeshClassifier classifier = HWY_DYNAMIC_DISPATCH(make_mesh_classifier)();
    return classifier;
}
}  // namespace aureole::lens
#endif
