// Texels that a horizon cuts: SIMD shared by exact filtering and irradiance. Included once per
// instruction set.
#if defined(AUREOLE_IBL_CUT_TEXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_IBL_CUT_TEXEL_INL_H
#undef AUREOLE_IBL_CUT_TEXEL_INL_H
#else
#define AUREOLE_IBL_CUT_TEXEL_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// 16 lanes at most, whatever the machine offers.
using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

HWY_INLINE V set(float value) { return hn::Set(D(), value); }

// 1 / a to float precision: x86 begins with at least 11 bits, ARM with 8.
HWY_INLINE V reciprocal(V a) {
    V r = hn::ApproximateReciprocal(a);
    for (int i = 0; i < (HWY_ARCH_X86 ? 1 : 2); ++i) r = hn::Mul(r, hn::NegMulAdd(a, r, set(2)));
    return r;
}

// max(0, x)^3
HWY_INLINE V cubed_above_zero(V x) {
    const V above = hn::Max(x, hn::Zero(D()));
    return hn::Mul(above, hn::Mul(above, above));
}

// Over a texel, mu = N.L is nearly `mu` + g u + h v with u and v even in [-1, 1]; g >= h >= 0. The
// mean of max(0, mu) over one that the horizon cuts, |mu| < g + h, is a sum of four cubes over
// 24 g h. An h of less than g / 10 counts as that: the mean changes by less than g / 1000, and the
// cubes do not cancel each other.
HWY_INLINE V mean_above_zero(V mu, V g, V h) {
    const V narrow = hn::Max(h, hn::Mul(g, set(0.1F)));
    const V outer = hn::Add(g, narrow);
    const V inner = hn::Sub(g, narrow);
    const V cubes = hn::Sub(
        hn::Add(cubed_above_zero(hn::Add(mu, outer)), cubed_above_zero(hn::Sub(mu, outer))),
        hn::Add(cubed_above_zero(hn::Add(mu, inner)), cubed_above_zero(hn::Sub(mu, inner))));
    return hn::Max(hn::Zero(D()), hn::Mul(cubes, reciprocal(hn::Mul(set(24), hn::Mul(g, narrow)))));
}

}  // namespace
}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
