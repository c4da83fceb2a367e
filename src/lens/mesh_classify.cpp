#include "lens/mesh_classify.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_classify.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_shapes-inl.h"
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

// At the corners of cells.
HWY_INLINE M is_nearly_even(const Mesh& mesh, std::ptrdiff_t at) {
    const V a = area_around(mesh, at);
    const V b = area_around(mesh, at + 1);
    const V c = area_around(mesh, at + mesh.stride);
    const V e = area_around(mesh, at + mesh.stride + 1);
    return is_even(hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Max(hn::Max(a, b), hn::Max(c, e)), 0,
                   kRoughStretch);
}

void find_states(const Mesh& mesh, const ClassifyOptions& options) {
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

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(find_states);
void classify(const Mesh& mesh, const ClassifyOptions& options) {
    HWY_DYNAMIC_DISPATCH(find_states)(mesh, options);
}
}  // namespace aureole::lens
#endif
