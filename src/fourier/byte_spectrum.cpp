#include "aureole/fourier/byte_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "aureole/base/small_float.h"
#include "fourier/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fourier/byte_spectrum.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::fourier::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void add_row(const std::uint16_t* scales, const std::int8_t* numbers, std::size_t count,
             float factor, float* sum) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> whole;
    const hn::Rebind<std::int8_t, decltype(d)> byte;
    const hn::Rebind<std::uint16_t, decltype(d)> bits;
    const hn::Rebind<hwy::float16_t, decltype(d)> half;
    const auto of_all = hn::Set(d, factor);
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto scale = hn::PromoteTo(d, hn::BitCast(half, hn::LoadU(bits, scales + i)));
        const auto number = hn::ConvertTo(d, hn::PromoteTo(whole, hn::LoadU(byte, numbers + i)));
        hn::StoreU(hn::MulAdd(number, hn::Mul(scale, of_all), hn::LoadU(d, sum + i)), d, sum + i);
    }
    for (; i < count; ++i) {
        sum[i] += static_cast<float>(numbers[i]) * (decode_half(scales[i]) * factor);
    }
}

}  // namespace

auto make_add_row() { return &add_row; }

}  // namespace aureole::fourier::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::fourier {
namespace {

constexpr float kLargest = 127;

std::size_t scale_count(int rows, int columns) {
    return static_cast<std::size_t>((rows + kBlockRows - 1) / kBlockRows) *
           static_cast<std::size_t>(columns);
}

}  // namespace

HWY_EXPORT(make_add_row);

float encode_spectrum(std::span<const float> values, int columns, std::byte* bytes) {
    const auto width = static_cast<std::size_t>(columns);
    const auto rows = static_cast<int>(values.size() / width);
    std::vector<float> steps(scale_count(rows, columns));
    for (std::size_t i = 0; i < values.size(); ++i) {
        float& step = steps[i / (kBlockRows * width) * width + i % width];
        step = std::max(step, std::abs(values[i]) / kLargest);
    }
    const float largest = *std::max_element(steps.begin(), steps.end());
    auto* scales = reinterpret_cast<std::uint16_t*>(bytes);
    auto* numbers = reinterpret_cast<std::int8_t*>(bytes + 2 * steps.size());
    if (largest == 0) {
        std::fill_n(bytes, byte_spectrum_size(rows, columns), std::byte{0});
        return 0;
    }
    constexpr int kLargestExponent = 15;  // of the largest scale, below 2^15
    const float scale = std::ldexp(1.0F, std::ilogb(largest) + 1 - kLargestExponent);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        scales[i] = encode_half(steps[i] / scale);
        steps[i] = decode_half(scales[i]) * scale;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float step = steps[i / (kBlockRows * width) * width + i % width];
        const float number = step > 0 ? std::nearbyint(values[i] / step) : 0;
        numbers[i] = static_cast<std::int8_t>(std::clamp(number, -kLargest, kLargest));
    }
    return scale;
}

void add_spectrum(const std::byte* bytes, int rows, int columns, int first_row, int end_row,
                  float factor, float* sum) noexcept {
    const auto width = static_cast<std::size_t>(columns);
    const auto* scales = reinterpret_cast<const std::uint16_t*>(bytes);
    const auto* numbers =
        reinterpret_cast<const std::int8_t*>(bytes + 2 * scale_count(rows, columns));
    const auto add_row = HWY_DYNAMIC_DISPATCH(make_add_row)();
    for (int row = first_row; row < end_row; ++row) {
        add_row(scales + static_cast<std::size_t>(row / kBlockRows) * width,
                numbers + static_cast<std::size_t>(row) * width, width, factor,
                sum + static_cast<std::size_t>(row - first_row) * width);
    }
}

bool scales_are_finite(const std::byte* bytes, int rows, int columns) noexcept {
    constexpr unsigned kExponent = 0x7c00;
    const auto* scales = reinterpret_cast<const std::uint16_t*>(bytes);
    return std::all_of(scales, scales + scale_count(rows, columns),
                       [](unsigned half) { return (half & kExponent) != kExponent; });
}

}  // namespace aureole::fourier
#endif
