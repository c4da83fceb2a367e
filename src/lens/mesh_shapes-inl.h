// Areas of cells, and where they reach. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_SHAPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_SHAPES_INL_H_
#undef AUREOLE_LENS_MESH_SHAPES_INL_H_
#else
#define AUREOLE_LENS_MESH_SHAPES_INL_H_
#endif

#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// Where a field of pixels may be between the corners, and a pixel around it.
struct Reach {
    V low, high;
    explicit Reach(const CellBounds& bounds) {
        const V more = hn::MulAdd(set(0.25F), hn::Sub(bounds.high, bounds.low), set(1.5F));
        low = hn::Sub(bounds.low, more);
        high = hn::Add(bounds.high, more);
    }
};

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

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
