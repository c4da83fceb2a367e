// Transforms of V lines at once, V the number of SIMD lanes: lane l of every vector belongs to
// line l, so that butterflies need no shuffles and twiddle factors are scalars. An element is
// 2 V floats: V real parts, V imaginary parts.
//
// Decimation in frequency forward (output in LinePlan's order), decimation in time inverse (input
// in that order), both in place: convolution needs no reordering (Gentleman & Sande 1966).
// Passes recurse depth-first, so that sub-blocks stay in cache.
//
// Included once per instruction set through hwy/foreach_target.h.

#include <hwy/highway.h>

#include "fourier/line_plan.h"

#if defined(AUREOLE_LINE_TRANSFORM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LINE_TRANSFORM_INL
#undef AUREOLE_LINE_TRANSFORM_INL
#else
#define AUREOLE_LINE_TRANSFORM_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace aureole::fourier::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using Vec = hn::Vec<D>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
inline constexpr std::size_t kElement = 2 * kLanes;  // floats per element

struct Complex {
    Vec re;
    Vec im;
};

HWY_INLINE Complex load(const float* element) {
    const D d;
    return {hn::Load(d, element), hn::Load(d, element + kLanes)};
}
HWY_INLINE void store(const Complex& value, float* element) {
    const D d;
    hn::Store(value.re, d, element);
    hn::Store(value.im, d, element + kLanes);
}
HWY_INLINE Complex zero() { return {hn::Zero(D()), hn::Zero(D())}; }
HWY_INLINE Complex add(const Complex& a, const Complex& b) {
    return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)};
}
HWY_INLINE Complex sub(const Complex& a, const Complex& b) {
    return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
HWY_INLINE Complex scale(const Complex& a, float s) {
    const Vec v = hn::Set(D(), s);
    return {hn::Mul(a.re, v), hn::Mul(a.im, v)};
}
// a + s b
HWY_INLINE Complex add_scaled(const Complex& a, const Complex& b, float s) {
    const Vec v = hn::Set(D(), s);
    return {hn::MulAdd(b.re, v, a.re), hn::MulAdd(b.im, v, a.im)};
}

// A constant of a butterfly as the sum of two floats. Rounded to one float it would be wrong by the
// same 2e-8 for every line, and every light would have faint ghosts a third or a fifth of the
// padded picture away, which show in the dark around the sun.
struct Constant {
    constexpr Constant(double value)  // NOLINT(google-explicit-constructor)
        : high(static_cast<float>(value)), low(static_cast<float>(value - high)) {}
    float high;
    float low;
};
HWY_INLINE Complex scale(const Complex& a, Constant s) {
    return add_scaled(scale(a, s.low), a, s.high);
}
HWY_INLINE Complex add_scaled(const Complex& a, const Complex& b, Constant s) {
    return add_scaled(add_scaled(a, b, s.low), b, s.high);
}
HWY_INLINE Complex sub_scaled(const Complex& a, const Complex& b, Constant s) {
    return add_scaled(add_scaled(a, b, -s.low), b, -s.high);
}

HWY_INLINE Complex multiply(const Complex& a, const Complex& b) {
    return {hn::NegMulAdd(a.im, b.im, hn::Mul(a.re, b.re)),
            hn::MulAdd(a.re, b.im, hn::Mul(a.im, b.re))};
}
// a * (c + i s), or its conjugate
template <bool kConjugate>
HWY_INLINE Complex twiddle(const Complex& a, const float* cos_sin) {
    const D d;
    const Vec c = hn::Set(d, cos_sin[0]);
    const Vec s = hn::Set(d, cos_sin[1]);
    if constexpr (kConjugate) {
        return {hn::MulAdd(a.im, s, hn::Mul(a.re, c)), hn::NegMulAdd(a.re, s, hn::Mul(a.im, c))};
    } else {
        return {hn::NegMulAdd(a.im, s, hn::Mul(a.re, c)), hn::MulAdd(a.re, s, hn::Mul(a.im, c))};
    }
}
// a * (-i) forward, a * (+i) inverse
template <bool kInverse>
HWY_INLINE Complex rotate(const Complex& a) {
    if constexpr (kInverse) {
        return {hn::Neg(a.im), a.re};
    } else {
        return {a.im, hn::Neg(a.re)};
    }
}

template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[2]) {
    const Complex a = x[0];
    x[0] = add(a, x[1]);
    x[1] = sub(a, x[1]);
}

template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[3]) {
    constexpr Constant kSin = 0.86602540378443864676;
    const Complex sum = add(x[1], x[2]);
    const Complex turn = scale(rotate<kInverse>(sub(x[1], x[2])), kSin);
    const Complex middle = add_scaled(x[0], sum, -0.5F);
    x[0] = add(x[0], sum);
    x[1] = add(middle, turn);
    x[2] = sub(middle, turn);
}

template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[4]) {
    const Complex a = add(x[0], x[2]);
    const Complex b = sub(x[0], x[2]);
    const Complex c = add(x[1], x[3]);
    const Complex e = rotate<kInverse>(sub(x[1], x[3]));
    x[0] = add(a, c);
    x[1] = add(b, e);
    x[2] = sub(a, c);
    x[3] = sub(b, e);
}

// cos(2 pi / 5) and cos(4 pi / 5) are -1/4 +- sqrt(5)/4 (Winograd 1978).
template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[5]) {
    constexpr Constant kRoot = 0.55901699437494742410;
    constexpr Constant kSin1 = 0.95105651629515357212;
    constexpr Constant kSin2 = 0.58778525229247312917;
    const Complex sum1 = add(x[1], x[4]);
    const Complex sum2 = add(x[2], x[3]);
    const Complex dif1 = rotate<kInverse>(sub(x[1], x[4]));
    const Complex dif2 = rotate<kInverse>(sub(x[2], x[3]));
    const Complex sum = add(sum1, sum2);
    const Complex middle = add_scaled(x[0], sum, -0.25F);
    const Complex split = scale(sub(sum1, sum2), kRoot);
    const Complex even1 = add(middle, split);
    const Complex even2 = sub(middle, split);
    const Complex odd1 = add_scaled(scale(dif1, kSin1), dif2, kSin2);
    const Complex odd2 = sub_scaled(scale(dif1, kSin2), dif2, kSin1);
    x[0] = add(x[0], sum);
    x[1] = add(even1, odd1);
    x[2] = add(even2, odd2);
    x[3] = sub(even2, odd2);
    x[4] = sub(even1, odd1);
}

template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[7]) {
    constexpr Constant kCos1 = 0.62348980185873353053;
    constexpr Constant kCos2 = -0.22252093395631440429;
    constexpr Constant kCos3 = -0.90096886790241912624;
    constexpr Constant kSin1 = 0.78183148246802980871;
    constexpr Constant kSin2 = 0.97492791218182360702;
    constexpr Constant kSin3 = 0.43388373911755812048;
    const Complex sum1 = add(x[1], x[6]);
    const Complex sum2 = add(x[2], x[5]);
    const Complex sum3 = add(x[3], x[4]);
    const Complex dif1 = rotate<kInverse>(sub(x[1], x[6]));
    const Complex dif2 = rotate<kInverse>(sub(x[2], x[5]));
    const Complex dif3 = rotate<kInverse>(sub(x[3], x[4]));
    const auto even = [&](Constant c1, Constant c2, Constant c3) HWY_ATTR {
        return add_scaled(add_scaled(add_scaled(x[0], sum1, c1), sum2, c2), sum3, c3);
    };
    const Complex even1 = even(kCos1, kCos2, kCos3);
    const Complex even2 = even(kCos2, kCos3, kCos1);
    const Complex even3 = even(kCos3, kCos1, kCos2);
    const Complex odd1 = add_scaled(add_scaled(scale(dif1, kSin1), dif2, kSin2), dif3, kSin3);
    const Complex odd2 = sub_scaled(sub_scaled(scale(dif1, kSin2), dif2, kSin3), dif3, kSin1);
    const Complex odd3 = add_scaled(sub_scaled(scale(dif1, kSin3), dif2, kSin1), dif3, kSin2);
    x[0] = add(x[0], add(sum1, add(sum2, sum3)));
    x[1] = add(even1, odd1);
    x[2] = add(even2, odd2);
    x[3] = add(even3, odd3);
    x[4] = sub(even3, odd3);
    x[5] = sub(even2, odd2);
    x[6] = sub(even1, odd1);
}

template <bool kInverse>
HWY_INLINE void butterfly(Complex (&x)[8]) {
    constexpr Constant kHalfRoot = 0.70710678118654752440;
    Complex even[4] = {x[0], x[2], x[4], x[6]};
    Complex odd[4] = {x[1], x[3], x[5], x[7]};
    butterfly<kInverse>(even);
    butterfly<kInverse>(odd);
    const Complex turn1 = scale(add(odd[1], rotate<kInverse>(odd[1])), kHalfRoot);
    const Complex turn2 = rotate<kInverse>(odd[2]);
    const Complex turn3 = scale(sub(rotate<kInverse>(odd[3]), odd[3]), kHalfRoot);
    x[0] = add(even[0], odd[0]);
    x[4] = sub(even[0], odd[0]);
    x[1] = add(even[1], turn1);
    x[5] = sub(even[1], turn1);
    x[2] = add(even[2], turn2);
    x[6] = sub(even[2], turn2);
    x[3] = add(even[3], turn3);
    x[7] = sub(even[3], turn3);
}

// One forward pass from `source` to `x` (may be equal). Pruned: only `valid` elements of the source
// exist, zeros follow.
template <int R, bool kPruned>
void forward_pass(const float* source, int valid, float* x, int stride, const float* twiddles) {
    const std::size_t step = static_cast<std::size_t>(stride) * kElement;
    for (int j = 0; j < stride; ++j, twiddles += 2 * (R - 1), source += kElement, x += kElement) {
        Complex t[R];
        for (unsigned i = 0; i < R; ++i) {
            const bool exists = !kPruned || j + static_cast<int>(i) * stride < valid;
            t[i] = exists ? load(source + i * step) : zero();
        }
        butterfly<false>(t);
        store(t[0], x);
        for (unsigned i = 1; i < R; ++i) {
            store(twiddle<false>(t[i], twiddles + 2 * (i - 1)), x + i * step);
        }
    }
}

// One inverse pass from `x` to `destination` (may be equal). Pruned: only the first `valid`
// elements are stored.
template <int R, bool kPruned>
void inverse_pass(const float* x, float* destination, int valid, int stride,
                  const float* twiddles) {
    const std::size_t step = static_cast<std::size_t>(stride) * kElement;
    for (int j = 0; j < stride;
         ++j, twiddles += 2 * (R - 1), x += kElement, destination += kElement) {
        Complex t[R];
        t[0] = load(x);
        for (unsigned i = 1; i < R; ++i) {
            t[i] = twiddle<true>(load(x + i * step), twiddles + 2 * (i - 1));
        }
        butterfly<true>(t);
        for (unsigned i = 0; i < R; ++i) {
            if (!kPruned || j + static_cast<int>(i) * stride < valid) {
                store(t[i], destination + i * step);
            }
        }
    }
}

// The last pass of a line (stride 1, no twiddles) on `count` neighbouring blocks.
template <int R, bool kInverse>
void leaf_pass(float* x, int count) {
    for (int block = 0; block < count; ++block, x += R * kElement) {
        Complex t[R];
        for (unsigned i = 0; i < R; ++i) t[i] = load(x + i * kElement);
        butterfly<kInverse>(t);
        for (unsigned i = 0; i < R; ++i) store(t[i], x + i * kElement);
    }
}

// A kernel's spectrum: complex, or real with one vector used of each element.
enum class Spectrum { kComplex, kReal };

// Forward leaf, product with the kernel's spectrum, inverse leaf: while in registers.
template <int R, Spectrum kSpectrum>
void leaf_product(float* x, const float* kernel, int count) {
    for (int block = 0; block < count; ++block, x += R * kElement, kernel += R * kElement) {
        Complex t[R];
        for (unsigned i = 0; i < R; ++i) t[i] = load(x + i * kElement);
        butterfly<false>(t);
        for (unsigned i = 0; i < R; ++i) {
            if constexpr (kSpectrum == Spectrum::kReal) {
                const Vec factor = hn::Load(D(), kernel + i * kElement);
                t[i] = {hn::Mul(t[i].re, factor), hn::Mul(t[i].im, factor)};
            } else {
                t[i] = multiply(t[i], load(kernel + i * kElement));
            }
        }
        butterfly<true>(t);
        for (unsigned i = 0; i < R; ++i) store(t[i], x + i * kElement);
    }
}

// Calls `function.template operator()<R>()` for the radix found at run time.
template <class Function>
HWY_INLINE void with_radix(int radix, const Function& function) {
    switch (radix) {
        case 2:
            return function.template operator()<2>();
        case 3:
            return function.template operator()<3>();
        case 4:
            return function.template operator()<4>();
        case 5:
            return function.template operator()<5>();
        case 7:
            return function.template operator()<7>();
        default:
            return function.template operator()<8>();
    }
}

// The passes after pass `level` on `count` neighbouring blocks of that pass's stride.
inline void forward_rest(const LinePlan& plan, std::size_t level, float* x, int count);
inline void inverse_rest(const LinePlan& plan, std::size_t level, float* x, int count);
template <Spectrum kSpectrum>
void product_rest(const LinePlan& plan, std::size_t level, float* x, const float* kernel,
                  int count);

inline void forward_rest(const LinePlan& plan, std::size_t level, float* x, int count) {
    if (level + 1 == plan.passes.size()) return;
    const LinePass& pass = plan.passes[level + 1];
    if (pass.stride == 1) {
        with_radix(pass.radix, [&]<int R>() HWY_ATTR { leaf_pass<R, false>(x, count); });
        return;
    }
    for (int block = 0; block < count; ++block) {
        with_radix(pass.radix, [&]<int R>() HWY_ATTR {
            forward_pass<R, false>(x, pass.length, x, pass.stride, pass.twiddles.data());
        });
        forward_rest(plan, level + 1, x, pass.radix);
        x += static_cast<std::size_t>(pass.length) * kElement;
    }
}

inline void inverse_rest(const LinePlan& plan, std::size_t level, float* x, int count) {
    if (level + 1 == plan.passes.size()) return;
    const LinePass& pass = plan.passes[level + 1];
    if (pass.stride == 1) {
        with_radix(pass.radix, [&]<int R>() HWY_ATTR { leaf_pass<R, true>(x, count); });
        return;
    }
    for (int block = 0; block < count; ++block) {
        inverse_rest(plan, level + 1, x, pass.radix);
        with_radix(pass.radix, [&]<int R>() HWY_ATTR {
            inverse_pass<R, false>(x, x, pass.length, pass.stride, pass.twiddles.data());
        });
        x += static_cast<std::size_t>(pass.length) * kElement;
    }
}

template <Spectrum kSpectrum>
void product_rest(const LinePlan& plan, std::size_t level, float* x, const float* kernel,
                  int count) {
    const LinePass& pass = plan.passes[level + 1];
    if (pass.stride == 1) {
        with_radix(pass.radix,
                   [&]<int R>() HWY_ATTR { leaf_product<R, kSpectrum>(x, kernel, count); });
        return;
    }
    for (int block = 0; block < count; ++block) {
        with_radix(pass.radix, [&]<int R>() HWY_ATTR {
            forward_pass<R, false>(x, pass.length, x, pass.stride, pass.twiddles.data());
        });
        product_rest<kSpectrum>(plan, level + 1, x, kernel, pass.radix);
        with_radix(pass.radix, [&]<int R>() HWY_ATTR {
            inverse_pass<R, false>(x, x, pass.length, pass.stride, pass.twiddles.data());
        });
        x += static_cast<std::size_t>(pass.length) * kElement;
        kernel += static_cast<std::size_t>(pass.length) * kElement;
    }
}

// Forward transform of `valid` elements followed by zeros, from `source` to `x` (may be equal).
// Output in the plan's order.
inline void forward_line(const LinePlan& plan, const float* source, int valid, float* x) {
    if (plan.passes.empty()) {
        store(load(source), x);
        return;
    }
    const LinePass& first = plan.passes.front();
    with_radix(first.radix, [&]<int R>() HWY_ATTR {
        forward_pass<R, true>(source, valid, x, first.stride, first.twiddles.data());
    });
    forward_rest(plan, 0, x, first.radix);
}

// Unscaled inverse of forward_line; `x` is destroyed, the first `valid` elements are stored to
// `destination` (may be x).
inline void inverse_line(const LinePlan& plan, float* x, float* destination, int valid) {
    if (plan.passes.empty()) {
        store(load(x), destination);
        return;
    }
    const LinePass& first = plan.passes.front();
    inverse_rest(plan, 0, x, first.radix);
    with_radix(first.radix, [&]<int R>() HWY_ATTR {
        inverse_pass<R, true>(x, destination, valid, first.stride, first.twiddles.data());
    });
}

// Circular convolution with a spectrum given in the plan's order; the plan has two passes or
// more. `source` holds `valid` elements followed by zeros, the first `wanted` of the result are
// stored to `destination` (may be the source); `x` is scratch.
template <Spectrum kSpectrum>
void convolve_line(const LinePlan& plan, const float* source, int valid, float* destination,
                   int wanted, const float* kernel, float* x) {
    const LinePass& first = plan.passes.front();
    with_radix(first.radix, [&]<int R>() HWY_ATTR {
        forward_pass<R, true>(source, valid, x, first.stride, first.twiddles.data());
    });
    product_rest<kSpectrum>(plan, 0, x, kernel, first.radix);
    with_radix(first.radix, [&]<int R>() HWY_ATTR {
        inverse_pass<R, true>(x, destination, wanted, first.stride, first.twiddles.data());
    });
}

// In-place transpose of a kLanes x kLanes tile: lane i of vector j and lane j of vector i.
HWY_INLINE void transpose(Vec (&a)[kLanes]) {
#if HWY_TARGET == HWY_SCALAR
    (void)a;  // one lane: nothing to exchange
#else
    const D d;
    const hn::Repartition<double, D> pairs;  // two neighbouring lanes as one
    for (int base = 0; base < kLanes; base += 4) {
        const auto q0 = hn::BitCast(pairs, hn::InterleaveLower(d, a[base], a[base + 1]));
        const auto q1 = hn::BitCast(pairs, hn::InterleaveUpper(d, a[base], a[base + 1]));
        const auto q2 = hn::BitCast(pairs, hn::InterleaveLower(d, a[base + 2], a[base + 3]));
        const auto q3 = hn::BitCast(pairs, hn::InterleaveUpper(d, a[base + 2], a[base + 3]));
        a[base] = hn::BitCast(d, hn::InterleaveLower(pairs, q0, q2));
        a[base + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, q0, q2));
        a[base + 2] = hn::BitCast(d, hn::InterleaveLower(pairs, q1, q3));
        a[base + 3] = hn::BitCast(d, hn::InterleaveUpper(pairs, q1, q3));
    }
    if constexpr (kLanes == 16) {
        for (int i = 0; i < 16; ++i) {
            if ((i & 4) != 0) continue;
            const Vec p = a[i];
            const Vec q = a[i + 4];
            a[i] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(q), p);
            a[i + 4] = hn::OddEvenBlocks(q, hn::SwapAdjacentBlocks(p));
        }
    }
    if constexpr (kLanes >= 8) {
        constexpr int kHalf = kLanes / 2;
        for (int i = 0; i < kHalf; ++i) {
            const Vec p = a[i];
            const Vec q = a[i + kHalf];
            a[i] = hn::ConcatLowerLower(d, q, p);
            a[i + kHalf] = hn::ConcatUpperUpper(d, q, p);
        }
    }
#endif
}

}  // namespace aureole::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
