// Iris::distance in SIMD. Included once per instruction set.
#if defined(AUREOLE_LENS_RAY_IRIS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_RAY_IRIS_INL_H_
#undef AUREOLE_LENS_RAY_IRIS_INL_H_
#else
#define AUREOLE_LENS_RAY_IRIS_INL_H_
#endif

#include <hwy/highway.h>

#include "lens/ray_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

template <class D, class V = hn::Vec<D>>
HWY_INLINE V iris_distance(D d, const IrisField& iris, V u, V v) {
    const V one = hn::Set(d, 1.0F);
    if (iris.blades == 0) {
        const V r = hn::Sqrt(hn::MulAdd(u, u, hn::Mul(v, v)));
        return hn::Sub(r, hn::Set(d, iris.offset));
    }
    V first = hn::Set(d, -1e30F);
    V second = first;
    const V back = hn::Set(d, iris.blade_radius - iris.apothem);
    for (int b = 0; b < iris.blades; ++b) {
        const V nu = hn::Set(d, iris.normals[2 * b]);
        const V nv = hn::Set(d, iris.normals[2 * b + 1]);
        V distance;
        if (iris.blade_radius == 0) {
            distance = hn::Add(hn::MulAdd(nu, u, hn::Mul(nv, v)), hn::Set(d, 1 - iris.apothem));
        } else {
            const V cu = hn::MulAdd(back, nu, u);
            const V cv = hn::MulAdd(back, nv, v);
            distance = hn::Add(hn::Sqrt(hn::MulAdd(cu, cu, hn::Mul(cv, cv))),
                               hn::Set(d, 1 - iris.blade_radius));
        }
        second = hn::Max(second, hn::Min(first, distance));
        first = hn::Max(first, distance);
    }
    if (iris.smoothing <= 0) return first;
    const V k = hn::Set(d, iris.smoothing);
    const V half = hn::Set(d, 0.5F);
    const V apart = hn::Sub(first, second);
    const V h = hn::Min(hn::MulAdd(apart, hn::Div(half, k), half), one);
    return hn::MulAdd(h, hn::MulAdd(k, hn::Sub(one, h), apart), second);
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
