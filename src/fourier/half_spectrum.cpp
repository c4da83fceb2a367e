#include "aureole/fourier/half_spectrum.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/small_float.h"
#include "fourier/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fourier/half_spectrum.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::fourier::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void add_halves(const std::uint16_t* halves, std::size_t count, float factor, float* sum) {
    const hn::ScalableTag<float> d;
    const hn::Rebind<std::uint16_t, decltype(d)> bits;
    const hn::Rebind<hwy::float16_t, decltype(d)> half;
    const auto scale = hn::Set(d, factor);
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto value = hn::PromoteTo(d, hn::BitCast(half, hn::LoadU(bits, halves + i)));
        hn::StoreU(hn::MulAdd(value, scale, hn::LoadU(d, sum + i)), d, sum + i);
    }
    for (; i < count; ++i) sum[i] += factor * decode_half(halves[i]);
}

}  // namespace

auto make_add_halves() { return &add_halves; }

}  // namespace aureole::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::fourier {

HWY_EXPORT(make_add_halves);

float encode_spectrum(std::span<const float> values, std::uint16_t* halves) {
    float largest = 0;
    for (const float value : values) largest = std::max(largest, std::abs(value));
    if (largest == 0) {
        std::fill_n(halves, values.size(), std::uint16_t{0});
        return 0;
    }
    constexpr int kLargestExponent = 15;  // of the largest magnitude, below 2^15
    const float scale = std::ldexp(1.0F, std::ilogb(largest) + 1 - kLargestExponent);
    std::transform(values.begin(), values.end(), halves,
                   [scale](float value) { return encode_half(value / scale); });
    return scale;
}

void add_spectrum(std::span<const std::uint16_t> halves, float factor, float* sum) noexcept {
    HWY_DYNAMIC_DISPATCH(make_add_halves)()(halves.data(), halves.size(), factor, sum);
}

}  // namespace aureole::fourier
#endif
