#include "aureole/color/tone_curve.h"

#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "color/tone_kernels.h"

namespace aureole::color {
namespace {

// Pixels that are gathered into contiguous memory, mapped and scattered again: strides cost
// nothing in between, and the compiler vectorises the arithmetic.
constexpr int kBlock = 256;

struct Block {
    alignas(64) float r[kBlock];
    alignas(64) float g[kBlock];
    alignas(64) float b[kBlock];
};

void load(const float* from, std::ptrdiff_t stride, int count, float scale, float* to) {
    for (int i = 0; i < count; ++i) to[i] = kernels::clean(scale * from[i * stride]);
}

void encode(const float* from, int count, float* to, std::ptrdiff_t stride) {
    for (int i = 0; i < count; ++i) to[i * stride] = kernels::fast_srgb_encode(from[i]);
}

void apply(ToneCurve curve, int count, Block& block) {
    switch (curve) {
        case ToneCurve::kNone:
            for (float* plane : {block.r, block.g, block.b}) {
                for (int i = 0; i < count; ++i) plane[i] = kernels::clip(plane[i]);
            }
            break;
        case ToneCurve::kNarkowicz:
            for (float* plane : {block.r, block.g, block.b}) {
                for (int i = 0; i < count; ++i) plane[i] = kernels::narkowicz(plane[i]);
            }
            break;
        case ToneCurve::kHill:
            for (int i = 0; i < count; ++i) kernels::hill(block.r[i], block.g[i], block.b[i]);
            break;
        case ToneCurve::kXyz:
            for (int i = 0; i < count; ++i) {
                kernels::hue_preserving(block.r[i], block.g[i], block.b[i]);
            }
            break;
        case ToneCurve::kUnity:
            for (int i = 0; i < count; ++i) kernels::unity(block.r[i], block.g[i], block.b[i]);
            break;
    }
}

}  // namespace

ToneCurve tone_curve_from_name(std::string_view name) {
    if (name == "none") return ToneCurve::kNone;
    if (name == "narkowicz") return ToneCurve::kNarkowicz;
    if (name == "hill") return ToneCurve::kHill;
    if (name == "xyz") return ToneCurve::kXyz;
    if (name == "unity") return ToneCurve::kUnity;
    throw InvalidArgument("tone curve", std::string(name),
                          "must be none, narkowicz, hill, xyz or unity");
}

Rgbf tone_map(ToneCurve curve, const Rgbf& rgb) {
    float r = kernels::clean(rgb[0]);
    float g = kernels::clean(rgb[1]);
    float b = kernels::clean(rgb[2]);
    switch (curve) {
        case ToneCurve::kNone:
            return {kernels::clip(r), kernels::clip(g), kernels::clip(b)};
        case ToneCurve::kNarkowicz:
            return {kernels::narkowicz(r), kernels::narkowicz(g), kernels::narkowicz(b)};
        case ToneCurve::kHill:
            kernels::hill(r, g, b);
            break;
        case ToneCurve::kXyz:
            kernels::hue_preserving(r, g, b);
            break;
        case ToneCurve::kUnity:
            kernels::unity(r, g, b);
            break;
    }
    return {r, g, b};
}

Rgbf hue_preserving(const Rgbf& rgb) { return tone_map(ToneCurve::kXyz, rgb); }

void tone_map_to_srgb(ToneCurve curve, float exposure_scale, const ConstImageView& rgb,
                      const ImageView& out) {
    if (rgb.channels != 3 || out.channels != 3 || rgb.width != out.width ||
        rgb.height != out.height) {
        throw InvalidArgument("pictures to tone-map",
                              std::to_string(rgb.width) + "x" + std::to_string(rgb.height) + "x" +
                                  std::to_string(rgb.channels) + " and " +
                                  std::to_string(out.width) + "x" + std::to_string(out.height) +
                                  "x" + std::to_string(out.channels),
                              "must have equal size and 3 channels");
    }
    parallel_for(static_cast<std::size_t>(rgb.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        Block block;
        for (int x = 0; x < rgb.width; x += kBlock) {
            const int count = std::min(kBlock, rgb.width - x);
            const float* from = rgb.data + rgb.offset(x, y, 0);
            load(from, rgb.pixel_stride, count, exposure_scale, block.r);
            load(from + rgb.channel_stride, rgb.pixel_stride, count, exposure_scale, block.g);
            load(from + 2 * rgb.channel_stride, rgb.pixel_stride, count, exposure_scale, block.b);
            apply(curve, count, block);
            float* to = &out.at(x, y, 0);
            encode(block.r, count, to, out.pixel_stride);
            encode(block.g, count, to + out.channel_stride, out.pixel_stride);
            encode(block.b, count, to + 2 * out.channel_stride, out.pixel_stride);
        }
    });
}

}  // namespace aureole::color
