#include "lens/mesh_divide.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_divide.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_shapes-inl.h"
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// Of a cell that is drawn by pieces; beyond, they no longer touch each other.
constexpr float kMostPieces = 128;
// Facets: cells with at least so many pixels between opposite sides, and areas that differ at most
// by so much between corners.
constexpr float kThinnestFacet = 1.5F;
constexpr float kMostStretch = 1.6F;

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

int find_groups(const Mesh& mesh, MeshGroup* groups) {
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
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(find_groups);
int divide(const Mesh& mesh, MeshGroup* groups) {
    return HWY_DYNAMIC_DISPATCH(find_groups)(mesh, groups);
}
}  // namespace aureole::lens
#endif
