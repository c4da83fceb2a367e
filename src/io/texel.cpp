#include "io/texel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/small_float.h"
#include "aureole/color/rgb.h"

namespace aureole::io {
namespace {

// Files hold the low byte first, and so do all machines that this is built for.
static_assert(std::endian::native == std::endian::little);

// The small floats of GPUs (Vulkan 1.3 specification, 2.7.2 to 2.7.4) share an exponent of 5 bits
// with bias 15 and differ in their mantissas: 10 bits in half precision, which also has a sign, 6
// and 5 in R11G11B10.
constexpr std::array<int, 3> kPackedMantissa = {6, 6, 5};
constexpr std::array<unsigned, 3> kPackedShift = {0, 11, 22};

// RGB9E5 (Vulkan 1.3 specification, 16.1.6): mantissas of 9 bits without a hidden one, value =
// mantissa 2^(exponent - 24).
constexpr float kLargestShared = 511.0F / 512.0F * 65536.0F;

using Rgb = std::array<float, 3>;

std::uint32_t encode_packed(const Rgb& rgb) {
    std::uint32_t code = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        code |= encode_small_float(std::abs(rgb[c]), kPackedMantissa[c]) << kPackedShift[c];
    }
    return code;
}

Rgb decode_packed(std::uint32_t code) {
    return {decode_small_float(code & 0x7ffU, kPackedMantissa[0]),
            decode_small_float(code >> 11U & 0x7ffU, kPackedMantissa[1]),
            decode_small_float(code >> 22U, kPackedMantissa[2])};
}

// The smallest exponent at which the rounded mantissa of the largest of the three fits.
std::uint32_t encode_shared(const Rgb& rgb) {
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    const auto binade = static_cast<int>(std::bit_cast<std::uint32_t>(std::abs(largest)) >> 23U);
    int exponent = std::max(0, binade - 127 + 16);
    if (std::lrint(largest * power_of_two(24 - exponent)) == 512) ++exponent;
    const float scale = power_of_two(24 - exponent);
    std::uint32_t code = static_cast<std::uint32_t>(exponent) << 27U;
    for (std::size_t c = 0; c < 3; ++c) {
        code |= static_cast<std::uint32_t>(std::lrint(rgb[c] * scale)) << 9U * c;
    }
    return code;
}

Rgb decode_shared(std::uint32_t code) {
    const float scale = power_of_two(static_cast<int>(code >> 27U) - 24);
    return {static_cast<float>(code & 511U) * scale, static_cast<float>(code >> 9U & 511U) * scale,
            static_cast<float>(code >> 18U & 511U) * scale};
}

struct Range {
    float lowest = 0;
    float highest = 0;
};

Range range_of(Sample sample, int channel) {
    switch (sample) {
        case Sample::kHalf:
            return {-largest_small_float(kHalfMantissaBits),
                    largest_small_float(kHalfMantissaBits)};
        case Sample::kFloat:
            return {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max()};
        case Sample::kR11G11B10:
            return {0, largest_small_float(kPackedMantissa[static_cast<std::size_t>(channel)])};
        case Sample::kRgb9e5:
            return {0, kLargestShared};
        default:
            return {0, 1};
    }
}

float clamped(float value, const Range& range, TextureReport& report) {
    if (std::isnan(value)) {
        ++report.not_numbers;
        return 0;
    }
    report.largest = std::max(report.largest, value);
    if (value > range.highest) {
        ++report.too_large;
        return range.highest;
    }
    if (value < range.lowest) {
        ++(range.lowest < 0 ? report.too_large : report.negative);
        return range.lowest;
    }
    return value;
}

template <class T>
void store(std::byte* bytes, T value) {
    std::memcpy(bytes, &value, sizeof value);
}

template <class T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

bool is_packed(Sample sample) { return sample == Sample::kR11G11B10 || sample == Sample::kRgb9e5; }

std::size_t sample_bytes(Sample sample) {
    if (sample == Sample::kHalf) return 2;
    return sample == Sample::kFloat ? 4 : 1;
}

float decode_sample(Sample sample, const std::byte* bytes, bool alpha) {
    switch (sample) {
        case Sample::kHalf:
            return decode_half(load<std::uint16_t>(bytes));
        case Sample::kFloat:
            return load<float>(bytes);
        default: {
            const float value = static_cast<float>(load<std::uint8_t>(bytes)) / 255.0F;
            return sample == Sample::kSrgbByte && !alpha ? color::srgb_decode(value) : value;
        }
    }
}

}  // namespace

std::size_t texel_bytes(const TexelLayout& layout) {
    if (is_packed(layout.sample)) return 4;
    return sample_bytes(layout.sample) * static_cast<std::size_t>(layout.stored);
}

const NamedLayout& written_layout(TexelFormat format, int channels) {
    const bool packed = format == TexelFormat::kR11G11B10 || format == TexelFormat::kRgb9e5;
    if (channels != 3 && (packed || (channels != 2 && channels != 4))) {
        throw InvalidArgument("channels of a texture", std::to_string(channels),
                              packed ? "this texel format holds 3" : "must be 2, 3 or 4");
    }
    const int stored = !packed && channels == 3 ? 4 : channels;
    const Sample sample = format == TexelFormat::kHalf        ? Sample::kHalf
                          : format == TexelFormat::kFloat     ? Sample::kFloat
                          : format == TexelFormat::kR11G11B10 ? Sample::kR11G11B10
                                                              : Sample::kRgb9e5;
    return *std::find_if(kNamedLayouts.begin(), kNamedLayouts.end(), [&](const NamedLayout& named) {
        return named.layout == TexelLayout{sample, stored, stored};
    });
}

void encode_row(const TexelLayout& layout, const Image& image, int y, std::byte* bytes,
                TextureReport& report) {
    const std::size_t pitch = texel_bytes(layout);
    const int given = std::min(image.channels(), layout.channels);
    if (is_packed(layout.sample)) {
        for (int x = 0; x < image.width(); ++x, bytes += pitch) {
            Rgb rgb{};
            for (int c = 0; c < 3; ++c) {
                rgb[static_cast<std::size_t>(c)] =
                    clamped(image.row(y, c)[x], range_of(layout.sample, c), report);
            }
            store(bytes,
                  layout.sample == Sample::kRgb9e5 ? encode_shared(rgb) : encode_packed(rgb));
        }
        return;
    }
    for (int c = 0; c < layout.stored; ++c) {
        const float* row = c < given ? image.row(y, c) : nullptr;
        std::byte* to = bytes + sample_bytes(layout.sample) * static_cast<std::size_t>(c);
        for (int x = 0; x < image.width(); ++x, to += pitch) {
            const float value =
                row == nullptr ? 1.0F : clamped(row[x], range_of(layout.sample, c), report);
            if (layout.sample == Sample::kHalf) {
                store(to, encode_half(value));
            } else {
                store(to, value);
            }
        }
    }
}

void decode_row(const TexelLayout& layout, const std::byte* bytes, Image& image, int y) {
    const std::size_t pitch = texel_bytes(layout);
    if (is_packed(layout.sample)) {
        for (int x = 0; x < image.width(); ++x, bytes += pitch) {
            const auto code = load<std::uint32_t>(bytes);
            const Rgb rgb =
                layout.sample == Sample::kRgb9e5 ? decode_shared(code) : decode_packed(code);
            for (int c = 0; c < 3; ++c) image.row(y, c)[x] = rgb[static_cast<std::size_t>(c)];
        }
        return;
    }
    for (int c = 0; c < layout.channels; ++c) {
        const int place = layout.blue_first && c < 3 ? 2 - c : c;
        const std::byte* from =
            bytes + sample_bytes(layout.sample) * static_cast<std::size_t>(place);
        float* row = image.row(y, c);
        for (int x = 0; x < image.width(); ++x, from += pitch) {
            row[x] = decode_sample(layout.sample, from, c == 3);
        }
    }
}

}  // namespace aureole::io
