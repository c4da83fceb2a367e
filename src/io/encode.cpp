#include "io/encode.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/picture_metadata.h"

namespace aureole::io {
namespace {

constexpr float kHalfMax = 65504;

template <class T>
void store(std::byte* out, T value) {
    std::memcpy(out, &value, sizeof value);
}

half to_half(float value, std::size_t& clipped) {
    if (std::isfinite(value) && std::abs(value) > kHalfMax) {
        ++clipped;
        return half(std::copysign(kHalfMax, value));
    }
    return half(value);
}

std::uint32_t to_uint(float value, const std::uint32_t* exact) {
    if (exact != nullptr && static_cast<float>(*exact) == value) return *exact;
    if (!(value > 0)) return 0;
    return value >= 4294967040.0F ? 0xffffffffU : static_cast<std::uint32_t>(std::lround(value));
}

std::uint8_t to_display(float value) {
    if (!(value > 0)) return 0;  // NaN too
    return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0F) * 255.0F));
}

// The encoder of HDR files cuts mantissas off instead of rounding them, which loses up to 1 / 128
// of a channel's light, on average 1 / 400. Values that are already rounded pass it unchanged.
void round_to_rgbe(float* rgb, std::size_t& clipped) {
    for (int c = 0; c < 3; ++c) {
        if (rgb[c] >= 0) continue;
        rgb[c] = 0;
        ++clipped;
    }
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    if (!(largest > 1e-32F) || !std::isfinite(largest)) return;  // the format's own limits
    int exponent = 0;
    std::frexp(largest, &exponent);
    float step = std::ldexp(1.0F, exponent - 8);
    // A mantissa that rounds up to 256 moves all three to the next exponent.
    if (std::lround(largest / step) == 256) step *= 2;
    for (int c = 0; c < 3; ++c) {
        rgb[c] = static_cast<float>(std::lround(rgb[c] / step)) * step;
    }
}

}  // namespace

RowEncoder::RowEncoder(const Picture& picture, Encoding encoding, const std::vector<int>& channels,
                       const OIIO::ImageSpec& spec, const Window& window)
    : picture_(picture),
      encoding_(encoding),
      channels_(channels),
      spec_(spec),
      window_(window),
      pixel_bytes_(spec.pixel_bytes(true)),
      row_bytes_(pixel_bytes_ * static_cast<std::size_t>(window.width)) {}

std::size_t RowEncoder::encode(int y, std::byte* out) const {
    const PictureMetadata& metadata = PictureAccess::metadata(picture_);
    const Image& image = picture_.image();
    const Window data = picture_.data_window();
    const int source_y = window_.y + y - data.y;
    const int shift = window_.x - data.x;
    std::memset(out, 0, row_bytes_);
    if (source_y < 0 || source_y >= image.height()) return 0;
    const int begin = std::max(0, -shift);
    const int end = std::min(window_.width, image.width() - shift);

    std::size_t clipped = 0;
    std::size_t offset = 0;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const OIIO::TypeDesc type = spec_.channelformat(static_cast<int>(c));
        const float* row = image.row(source_y, channels_[c]);
        const auto& exact = metadata.storage[static_cast<std::size_t>(channels_[c])].exact;
        const std::size_t first =
            static_cast<std::size_t>(source_y) * static_cast<std::size_t>(image.width());
        for (int x = begin; x < end; ++x) {
            const float value = row[x + shift];
            std::byte* to = out + static_cast<std::size_t>(x) * pixel_bytes_ + offset;
            if (type == OIIO::TypeFloat) {
                store(to, value);
            } else if (type == OIIO::TypeHalf) {
                store(to, to_half(value, clipped));
            } else if (type == OIIO::TypeUInt32) {
                const std::size_t at = first + static_cast<std::size_t>(x + shift);
                store(to, to_uint(value, exact ? exact->data() + at : nullptr));
            } else {
                store(to, to_display(value));
            }
        }
        offset += type.size();
    }
    if (encoding_ == Encoding::kRgbe) {
        for (int x = begin; x < end; ++x) {
            float rgb[3];
            std::byte* pixel = out + static_cast<std::size_t>(x) * pixel_bytes_;
            std::memcpy(rgb, pixel, sizeof rgb);
            round_to_rgbe(rgb, clipped);
            std::memcpy(pixel, rgb, sizeof rgb);
        }
    }
    return clipped;
}

}  // namespace aureole::io
