// Where light comes from is its elevation e over the surface and half its azimuth from the mirror
// direction, s = sin(phi / 2); e_v is the elevation of the view. With c = cos((e_v - e) / 2) and
// g = sin((e_v + e) / 2), both free of cancellation,
//
//     |v + l|^2 = 4 (v.h)^2 = 4 (g^2 + (c^2 - g^2) s^2),     N.h = 2 g c / |v + l|,
//
// and 1 - (1 - a^2) (N.h)^2 = (4 g^2 (sin^2((e_v - e) / 2) + a^2 c^2) + k s^2) / |v + l|^2: a peak
// at e = e_v, s = 0 that can be very narrow. So both variables are graded by hyperbolic sines,
// which spread the neighbourhood of the peak over many scales (the sinh transformation of Johnston
// & Elliott 2005, "A sinh transformation for evaluating nearly singular boundary element
// integrals"), and Gauss-Legendre rules converge as they do for smooth functions.
#include "ibl/brdf_kernels.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/brdf_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
static_assert(kElevations % kLanes == 0);

HWY_INLINE V set(double value) { return hn::Set(D(), static_cast<float>(value)); }
HWY_INLINE V square(V x) { return hn::Mul(x, x); }

// width sinh(u) at the nodes from u_first to u_last, and their weights.
struct Graded {
    V place, weight;
};
HWY_INLINE Graded graded(const BrdfNodes& nodes, int first, double width, double u_first,
                         double u_last) {
    const D d;
    const V node = hn::Load(d, nodes.elevation.data() + first);
    const V weight = hn::Load(d, nodes.elevation_weight.data() + first);
    const V sinh = hn::Sinh(d, hn::MulAdd(set(u_last - u_first), node, set(u_first)));
    const V cosh = hn::Sqrt(hn::MulAdd(sinh, sinh, set(1)));
    return {hn::Mul(set(width), sinh),
            hn::Mul(hn::Mul(set(width * (u_last - u_first)), weight), cosh)};
}

// What follows from elevations e of light, for one of the view.
struct Elevations {
    V cosine, n_dot_l;  // of e; its sine
    V c2, g2;           // as above, squared
    V away2, up2;       // 1 - c^2, 1 - g^2
};
HWY_INLINE Elevations elevations_at(double view, V view_minus_light) {
    const D d;
    const V half = hn::Mul(set(0.5), view_minus_light);
    const V light = hn::Sub(set(view), view_minus_light);
    const V middle = hn::Sub(set(view), half);
    return {hn::Cos(d, light),        hn::Max(hn::Sin(d, light), set(1e-20)),
            square(hn::Cos(d, half)), square(hn::Sin(d, middle)),
            square(hn::Sin(d, half)), square(hn::Cos(d, middle))};
}

// Sums over the azimuth on both sides; what a function of s^2 adds up to, times its weight. The
// peak is `width` wide. s = 2 t / (1 + t^2) with t = tan(phi / 4) = width / 2 sinh(p).
template <class Add>
HWY_INLINE void over_azimuths(const BrdfNodes& nodes, V width, const Add& add) {
    const D d;
    const V half = hn::Mul(set(0.5), width);
    const V p_last = hn::Asinh(d, hn::Div(set(1), half));
    const V scale = hn::Mul(set(8), hn::Mul(half, p_last));
    for (std::size_t i = 0; i < kAzimuths; ++i) {
        const V sinh = hn::Sinh(d, hn::Mul(p_last, set(nodes.azimuth[i])));
        const V cosh = hn::Sqrt(hn::MulAdd(sinh, sinh, set(1)));
        const V t = hn::Mul(half, sinh);
        const V r = hn::Div(set(1), hn::MulAdd(t, t, set(1)));
        const V s2 = square(hn::Mul(hn::Add(t, t), r));
        add(s2, hn::Mul(hn::Mul(scale, set(nodes.azimuth_weight[i])), hn::Mul(cosh, r)));
    }
}

std::array<double, 2> ggx(const BrdfNodes& nodes, double n_dot_v, double alpha) {
    const D d;
    const double view = std::asin(n_dot_v);
    const double a2 = alpha * alpha;
    // Elevations from pi / 2 down to 0.
    const double u_first = std::asinh((view - kPi / 2) / alpha);
    const double u_last = std::asinh(view / alpha);
    V sum = hn::Zero(d);
    V fresnel_sum = hn::Zero(d);
    for (int first = 0; first < kElevations; first += kLanes) {
        const Graded away = graded(nodes, first, alpha, u_first, u_last);
        const Elevations at = elevations_at(view, away.place);
        // Four times less than in the text above: it cancels.
        const V near = hn::Mul(at.g2, hn::MulAdd(set(a2), at.c2, at.away2));
        const V far = hn::Mul(at.c2, hn::MulAdd(set(a2), at.g2, at.up2));
        const V turn = hn::Sub(far, near);
        const V view_turn = hn::Sub(at.c2, at.g2);
        V inner = hn::Zero(d);
        V fresnel_inner = hn::Zero(d);
        over_azimuths(nodes, hn::Sqrt(hn::Div(near, far)), [&](V s2, V weight) {
            const V v_dot_h2 = hn::MulAdd(view_turn, s2, at.g2);
            const V ratio = hn::Div(v_dot_h2, hn::MulAdd(turn, s2, near));
            const V value = hn::Mul(weight, square(ratio));
            const V from_one = hn::Max(hn::Zero(d), hn::Sub(set(1), hn::Sqrt(v_dot_h2)));
            const V fresnel = hn::Mul(from_one, square(square(from_one)));
            inner = hn::Add(inner, value);
            fresnel_inner = hn::MulAdd(value, fresnel, fresnel_inner);
        });
        const V l = at.n_dot_l;
        const V masked_view =
            hn::Mul(set(n_dot_v), hn::Sqrt(hn::MulAdd(set(1 - a2), square(l), set(a2))));
        const V masked_light = hn::Mul(l, set(std::sqrt(a2 + (1 - a2) * n_dot_v * n_dot_v)));
        const V visible = hn::Div(set(0.5), hn::Add(masked_view, masked_light));
        const V outer = hn::Mul(hn::Mul(away.weight, at.cosine), hn::Mul(visible, l));
        sum = hn::MulAdd(outer, inner, sum);
        fresnel_sum = hn::MulAdd(outer, fresnel_inner, fresnel_sum);
    }
    const double scale = a2 / kPi;
    return {scale * hn::GetLane(hn::SumOfLanes(d, sum)),
            scale * hn::GetLane(hn::SumOfLanes(d, fresnel_sum))};
}

// No peak at the mirror direction, but D ends there, and both D and V change fast near the horizon.
std::array<double, 2> cloth(const BrdfNodes& nodes, double n_dot_v, double alpha) {
    const D d;
    const double view = std::asin(n_dot_v);
    V sum = hn::Zero(d);
    for (int first = 0; first < kElevations; first += kLanes) {
        const Graded light = graded(nodes, first, view, 0, std::asinh(kPi / 2 / view));
        const Elevations at = elevations_at(view, hn::Sub(set(view), light.place));
        const V view_turn = hn::Sub(at.c2, at.g2);
        const V top = hn::Mul(at.c2, at.g2);
        V inner = hn::Zero(d);
        over_azimuths(nodes, hn::Sqrt(hn::Div(at.g2, at.c2)), [&](V s2, V weight) {
            // Not up to 1, whose logarithm is infinite.
            const V n_dot_h2 =
                hn::Min(hn::Div(top, hn::MulAdd(view_turn, s2, at.g2)), set(1 - 1e-7));
            const V power = hn::Mul(set(1 / (2 * alpha)), hn::Log1p(d, hn::Neg(n_dot_h2)));
            inner = hn::MulAdd(weight, hn::Exp(d, power), inner);
        });
        const V l = at.n_dot_l;
        const V visible = hn::Div(set(0.25), hn::MulAdd(set(1 - n_dot_v), l, set(n_dot_v)));
        const V outer = hn::Mul(hn::Mul(light.weight, at.cosine), hn::Mul(visible, l));
        sum = hn::MulAdd(outer, inner, sum);
    }
    return {(2 + 1 / alpha) / (2 * kPi) * hn::GetLane(hn::SumOfLanes(d, sum)), 0};
}

}  // namespace

BrdfKernels make_brdf_kernels() { return {&ggx, &cloth}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_brdf_kernels);
const BrdfKernels& brdf_kernels() {
    static const BrdfKernels kernels = HWY_DYNAMIC_DISPATCH(make_brdf_kernels)();
    return kernels;
}
}  // namespace aureole::ibl
#endif
