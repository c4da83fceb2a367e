#include "ibl/exact_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/exact_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "ibl/cut_texel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

static_assert(kOutputBlock % kLanes == 0);

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

// The mean weight over a texel that is cut, as mean_above_zero: 1 / q^2 hardly changes and is taken
// in the middle of the lit part.
HWY_INLINE V cut_weight(const LobeOutputs& outputs, V mu, V g, V h) {
    const V lit = hn::Max(mu, hn::Mul(set(0.5F), hn::Add(mu, hn::Add(g, h))));
    const V r = reciprocal(hn::NegMulAdd(set(outputs.b), lit, set(outputs.a2 + outputs.b)));
    return hn::Mul(mean_above_zero(mu, g, h), hn::Mul(r, r));
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
