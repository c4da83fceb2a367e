#include "ibl/exact_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/exact_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kOutputBlock>;
using V = hn::Vec<D>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));

V set(float value) { return hn::Set(D(), value); }

// 1 / a to float precision: x86 begins with at least 11 bits, ARM with 8.
HWY_INLINE V reciprocal(V a) {
    V r = hn::ApproximateReciprocal(a);
    for (int i = 0; i < (HWY_ARCH_X86 ? 1 : 2); ++i) r = hn::Mul(r, hn::NegMulAdd(a, r, set(2)));
    return r;
}

HWY_INLINE V dot3(const float* a, V x, V y, V z) {
    return hn::MulAdd(set(a[0]), x, hn::MulAdd(set(a[1]), y, hn::Mul(set(a[2]), z)));
}

// The sums of one vector of outputs. Float while a batch of texels lasts, double between them.
struct Rgb {
    V r, g, b;

    HWY_INLINE void add(V weight, const float* light) {
        r = hn::MulAdd(weight, set(light[0]), r);
        g = hn::MulAdd(weight, set(light[1]), g);
        b = hn::MulAdd(weight, set(light[2]), b);
    }
    HWY_INLINE void add_to(LobeSums& sums, int first) const {
        alignas(64) float lanes[kLanes];
        const V channels[3] = {r, g, b};
        for (int c = 0; c < 3; ++c) {
            hn::Store(channels[c], D(), lanes);
            for (int i = 0; i < kLanes; ++i) sums.rgb[c][first + i] += lanes[i];
        }
    }
};

HWY_INLINE Rgb zero() { return {hn::Zero(D()), hn::Zero(D()), hn::Zero(D())}; }

// What the moments of a texel say about mu = N.L over it, for some outputs N.
struct Normals {
    V n[3];
    V square[6];

    HWY_INLINE Normals(const LobeOutputs& outputs, int first) {
        for (int i = 0; i < 3; ++i) n[i] = hn::Load(D(), outputs.normal[i] + first);
        for (int i = 0; i < 6; ++i) square[i] = hn::Load(D(), outputs.square[i] + first);
    }
    HWY_INLINE V mean(const TexelMoments& texel) const {
        return dot3(texel.mean, n[0], n[1], n[2]);
    }
    HWY_INLINE V variance(const TexelMoments& texel) const {
        const V own = dot3(texel.covariance, square[0], square[1], square[2]);
        return hn::Add(own, dot3(texel.covariance + 3, square[3], square[4], square[5]));
    }
};

// f = mu / q^2, q = a^2 + b (1 - mu), and its second derivative (4 b q + 6 b^2 mu) / q^4: the mean
// of f is f + f'' variance / 2.
HWY_INLINE V mean_weight(const LobeOutputs& outputs, V mu, V variance) {
    const V b = set(outputs.b);
    const V r = reciprocal(hn::NegMulAdd(b, mu, set(outputs.a2 + outputs.b)));
    const V br = hn::Mul(b, r);
    const V bent = hn::Mul(br, hn::MulAdd(hn::Mul(set(3), br), mu, set(2)));
    return hn::Mul(hn::Mul(r, r), hn::MulAdd(variance, bent, mu));
}

void whole(const LobeOutputs& outputs, const TexelMoments* texels, const float* light, int count,
           LobeSums& sums) {
    for (int first = 0; first < outputs.count; first += kLanes) {
        const Normals normals(outputs, first);
        Rgb sum = zero();
        for (int i = 0; i < count; ++i) {
            const V mu = normals.mean(texels[i]);
            sum.add(mean_weight(outputs, mu, normals.variance(texels[i])), light + 3 * i);
        }
        sum.add_to(sums, first);
    }
}

// max(0, x)^3
HWY_INLINE V cubed_above_zero(V x) {
    const V above = hn::Max(x, hn::Zero(D()));
    return hn::Mul(above, hn::Mul(above, above));
}

// Over a texel that is cut, mu = mu_0 + g u + h v with u and v even in [-1, 1] (g >= h >= 0). The
// mean of max(0, mu) is the sum of four cubes over 24 g h; 1 / q^2 hardly changes and is taken in
// the middle of the lit part. h of less than g / 10 counts as that: the mean changes by less than
// g / 1000, and the four cubes do not cancel each other.
HWY_INLINE V cut_weight(const LobeOutputs& outputs, V mu, V g, V h) {
    const V zero = hn::Zero(D());
    const V narrow = hn::Max(h, hn::Mul(g, set(0.1F)));
    const V outer = hn::Add(g, narrow);
    const V inner = hn::Sub(g, narrow);
    const V cubes = hn::Sub(
        hn::Add(cubed_above_zero(hn::Add(mu, outer)), cubed_above_zero(hn::Sub(mu, outer))),
        hn::Add(cubed_above_zero(hn::Add(mu, inner)), cubed_above_zero(hn::Sub(mu, inner))));
    const V mean = hn::Mul(cubes, reciprocal(hn::Mul(set(24), hn::Mul(g, narrow))));
    const V lit = hn::Max(mu, hn::Mul(set(0.5F), hn::Add(mu, outer)));
    const V r = reciprocal(hn::NegMulAdd(set(outputs.b), lit, set(outputs.a2 + outputs.b)));
    return hn::Max(zero, hn::Mul(mean, hn::Mul(r, r)));
}

void cut(const LobeOutputs& outputs, const TexelMoments* texels, const TexelSpread* spreads,
         const float* light, int count, LobeSums& sums) {
    for (int first = 0; first < outputs.count; first += kLanes) {
        const Normals normals(outputs, first);
        Rgb sum = zero();
        for (int i = 0; i < count; ++i) {
            const V mu = normals.mean(texels[i]);
            const V* n = normals.n;
            const V s = hn::Abs(dot3(spreads[i].along_s, n[0], n[1], n[2]));
            const V t = hn::Abs(dot3(spreads[i].along_t, n[0], n[1], n[2]));
            const V reach = hn::Add(s, t);
            const V uncut = mean_weight(outputs, mu, normals.variance(texels[i]));
            const V lit = hn::IfThenElse(hn::Ge(mu, reach), uncut,
                                         cut_weight(outputs, mu, hn::Max(s, t), hn::Min(s, t)));
            sum.add(hn::IfThenElseZero(hn::Gt(mu, hn::Neg(reach)), lit), light + 3 * i);
        }
        sum.add_to(sums, first);
    }
}

// 1 - mu = |N - L|^2 / 2, which stays precise in the middle of a narrow lobe.
void points(const LobeOutputs& outputs, const LobePoint* points, int count, LobeSums& sums) {
    const D d;
    const V a2 = set(outputs.a2);
    const V b = set(outputs.b);
    const V half = set(0.5F);
    for (int first = 0; first < outputs.count; first += kLanes) {
        const V nx = hn::Load(d, outputs.offset[0] + first);
        const V ny = hn::Load(d, outputs.offset[1] + first);
        const V nz = hn::Load(d, outputs.offset[2] + first);
        Rgb sum = zero();
        for (int i = 0; i < count; ++i) {
            const V x = hn::Sub(set(points[i].offset[0]), nx);
            const V y = hn::Sub(set(points[i].offset[1]), ny);
            const V z = hn::Sub(set(points[i].offset[2]), nz);
            const V away =
                hn::Mul(half, hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));  // 1 - mu
            const V mu = hn::Max(hn::Zero(d), hn::Sub(set(1), away));
            const V r = reciprocal(hn::MulAdd(b, away, a2));
            sum.add(hn::Mul(mu, hn::Mul(r, r)), points[i].light);
        }
        sum.add_to(sums, first);
    }
}

}  // namespace

ExactKernels make_exact_kernels() { return {&whole, &cut, &points}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_exact_kernels);
const ExactKernels& exact_kernels() {
    static const ExactKernels kernels = HWY_DYNAMIC_DISPATCH(make_exact_kernels)();
    return kernels;
}
}  // namespace aureole::ibl
#endif
