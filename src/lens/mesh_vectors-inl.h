// What the mesh kernels share. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_VECTORS_INL_H_
#undef AUREOLE_LENS_MESH_VECTORS_INL_H_
#else
#define AUREOLE_LENS_MESH_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "lens/mesh_types.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kGroup>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

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

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
