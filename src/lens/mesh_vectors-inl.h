// What the mesh kernels share. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_VECTORS_INL_H_
#undef AUREOLE_LENS_MESH_VECTORS_INL_H_
#else
#define AUREOLE_LENS_MESH_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lens/mesh_types.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kGroup>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

HWY_INLINE V set(float value) { return hn::Set(D(), value); }
HWY_INLINE V load(const float* from) { return hn::LoadU(D(), from); }
HWY_INLINE float lowest(V v) { return hn::GetLane(hn::MinOfLanes(D(), v)); }
HWY_INLINE float highest(V v) { return hn::GetLane(hn::MaxOfLanes(D(), v)); }

// Which lanes are cells of the mesh that are not on its rim, from a column on.
HWY_INLINE M cells_from(const Mesh& mesh, int column) {
    return hn::FirstN(D(),
                      static_cast<std::size_t>(std::clamp(mesh.columns - 2 - column, 0, kLanes)));
}

// Of a field at the four corners of cells.
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

// The largest change of a field over cells, along one direction, on the nearer and the farther of
// their sides: that of the parabola, which at a fold goes out and back.
HWY_INLINE V largest_changes(const float* from, std::ptrdiff_t step, std::ptrdiff_t beside) {
    const auto on_side = [&](const float* at) {
        const V a = load(at);
        const V b = load(at + step);
        const V bend = hn::Sub(hn::Add(load(at - step), load(at + 2 * step)), hn::Add(a, b));
        return hn::MulAdd(set(0.25F), hn::Abs(bend), hn::Abs(hn::Sub(b, a)));
    };
    return hn::Max(on_side(from), on_side(from + beside));
}

// Into how many pieces a cell's side of this length is divided.
HWY_INLINE int pieces_for(float length_px, float per_px, float most) {
    return static_cast<int>(std::clamp(std::ceil(per_px * length_px), 1.0F, most));
}

// Pieces stand as rectangles for parallelograms, which makes a pattern. In small cells, which may
// be smooth, they are at most half a pixel wide, and drawn twice as wide as they are: they overlap
// evenly to 2 % of the brightness at most angles, 4 % at 45 deg. Large cells are pieces only where
// they are so uneven that the pattern of wider pieces, up to 9 %, is lost in their gradient.
inline constexpr float kPiecesPerPx = 2;
inline constexpr float kCoarsePiecesPerPx = 1.4142F;

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
