// Floats of 16 bits and less with a 5-bit exponent of bias 15 (IEEE 754 binary16 without its sign;
// R11G11B10): nearest value, ties to even, subnormals kept.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace aureole {

inline constexpr int kHalfMantissaBits = 10;

constexpr float largest_small_float(int mantissa_bits) {
    return 32768.0F *
           (2.0F - 1.0F / static_cast<float>(1U << static_cast<unsigned>(mantissa_bits)));
}
static_assert(largest_small_float(kHalfMantissaBits) == 65504.0F);

constexpr float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23U);
}

// `value` in [0, largest_small_float()].
inline std::uint32_t encode_small_float(float value, int mantissa_bits) {
    auto bits = std::bit_cast<std::uint32_t>(value);
    if (value < 0x1p-14F) {  // subnormal: a multiple of 2^-(14 + mantissa_bits)
        return static_cast<std::uint32_t>(std::lrint(value * power_of_two(14 + mantissa_bits)));
    }
    // A mantissa that rounds up beyond its bits carries into the exponent, as it should.
    const auto dropped = static_cast<unsigned>(23 - mantissa_bits);
    bits += (1U << (dropped - 1)) - 1U + ((bits >> dropped) & 1U);
    return (bits >> dropped) - (112U << static_cast<unsigned>(mantissa_bits));
}

inline float decode_small_float(std::uint32_t code, int mantissa_bits) {
    const auto m = static_cast<unsigned>(mantissa_bits);
    const std::uint32_t exponent = code >> m;
    const std::uint32_t mantissa = code & ((1U << m) - 1U);
    if (exponent == 0) return static_cast<float>(mantissa) * power_of_two(-14 - mantissa_bits);
    const std::uint32_t widened = exponent == 31 ? 255 : exponent + 112;
    return std::bit_cast<float>(widened << 23U | mantissa << (23U - m));
}

// Half precision; |value| <= 65504.
inline std::uint16_t encode_half(float value) {
    const std::uint32_t sign = std::signbit(value) ? 0x8000U : 0U;
    return static_cast<std::uint16_t>(sign |
                                      encode_small_float(std::abs(value), kHalfMantissaBits));
}

inline float decode_half(std::uint16_t code) {
    const float value = decode_small_float(code & 0x7fffU, kHalfMantissaBits);
    return (code & 0x8000U) != 0 ? -value : value;
}

}  // namespace aureole
