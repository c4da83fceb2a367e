// The tone curves as branch-free arithmetic on one colour, shared by the pixel and picture forms.
// Every input is finite: clean() comes first.
#pragma once

#include <algorithm>
#include <cmath>

#include "aureole/color/rgb.h"

namespace aureole::color::kernels {

// No curve tells values above this from white; large enough that hue_preserving() still sees the
// ratios of anything physical (the sun is 1.6e9 cd/m2), small enough that squares stay finite.
inline constexpr float kLargest = 1e15F;

// NaN becomes 0, infinities the largest value.
inline float clean(float v) {
    return v > -kLargest ? (v < kLargest ? v : kLargest) : (v <= -kLargest ? -kLargest : 0.0F);
}

inline float clip(float v) { return std::min(std::max(v, 0.0F), 1.0F); }

// Narkowicz 2016. Its numerator and denominator have roots at negative x, between which it is
// negative and beyond which it rises again: only x >= 0 is meant.
inline float narkowicz(float v) {
    const float x = std::max(0.6F * v, 0.0F);
    return clip(x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F));
}

// The curve of Stephen Hill's fit, in the space of the RRT. It has a minimum near v = -0.2 and
// rises to 1 on the far negative side, where it would turn strong out-of-gamut colours bright.
inline float hill_curve(float v) {
    const float x = std::max(v, 0.0F);
    return (x * (x + 0.0245786F) - 0.000090537F) / (x * (0.983729F * x + 0.432951F) + 0.238081F);
}

// The last coefficient of the output matrix is published as 1.07602, with which its row sums to
// .99999 and greys turn yellow by 1e-5; here the rows sum to 1.
inline void hill(float& r, float& g, float& b) {
    const float x = hill_curve(0.59719F * r + 0.35458F * g + 0.04823F * b);
    const float y = hill_curve(0.07600F * r + 0.90834F * g + 0.01566F * b);
    const float z = hill_curve(0.02840F * r + 0.13383F * g + 0.83777F * b);
    r = clip(1.60475F * x - 0.53108F * y - 0.07367F * z);
    g = clip(-0.10208F * x + 1.10813F * y - 0.00605F * z);
    b = clip(-0.00327F * x - 0.07276F * y + 1.07603F * z);
}

// From the RRT's desaturation to the ODT's in ACEScg (primaries AP1; its white comes from D65 by
// Bradford's transform). A dim surround raises luminance to the power .9811, chromaticity kept.
inline void unity(float& r, float& g, float& b) {
    const auto luminance = [](float x, float y, float z) {
        return 0.272229F * x + 0.674082F * y + 0.053689F * z;
    };
    const auto saturate = [&](float& x, float& y, float& z, float saturation) {
        const float grey = luminance(x, y, z);
        x = grey + saturation * (x - grey);
        y = grey + saturation * (y - grey);
        z = grey + saturation * (z - grey);
    };
    const auto curve = [](float v) {
        return v * (278.5085F * v + 10.7772F) / (v * (293.6045F * v + 88.7122F) + 80.6889F);
    };
    float x = std::max(0.613097F * r + 0.339523F * g + 0.047380F * b, 0.0F);
    float y = std::max(0.070194F * r + 0.916354F * g + 0.013452F * b, 0.0F);
    float z = std::max(0.020616F * r + 0.109570F * g + 0.869814F * b, 0.0F);
    saturate(x, y, z, 0.96F);
    x = curve(x);
    y = curve(y);
    z = curve(z);
    const float dim = std::pow(std::max(luminance(x, y, z), 1e-6F), 0.9811F - 1.0F);
    x *= dim;
    y *= dim;
    z *= dim;
    saturate(x, y, z, 0.93F);
    r = clip(1.705051F * x - 0.621792F * y - 0.083259F * z);
    g = clip(-0.130256F * x + 1.140805F * y - 0.010549F * z);
    b = clip(-0.024003F * x - 0.128969F * y + 1.152972F * z);
}

// The formula is in aureole/color/tone_curve.h.
inline void hue_preserving(float& r, float& g, float& b) {
    constexpr auto kR = static_cast<float>(kLuminanceWeights[0]);
    constexpr auto kG = static_cast<float>(kLuminanceWeights[1]);
    constexpr auto kB = static_cast<float>(kLuminanceWeights[2]);
    if (std::min(std::min(r, g), b) < 0) {  // only then can X, Y or Z be negative
        const Xyz xyz = xyz_from_rgb({r, g, b});
        if (std::min(std::min(xyz[0], xyz[1]), xyz[2]) < 0) {
            const Rgb clipped =
                rgb_from_xyz({std::max(xyz[0], 0.0), std::max(xyz[1], 0.0), std::max(xyz[2], 0.0)});
            r = static_cast<float>(clipped[0]);
            g = static_cast<float>(clipped[1]);
            b = static_cast<float>(clipped[2]);
        }
    }
    const float m = std::max(std::max(r, g), b);
    if (m > 1) {
        r /= m;  // dividing, not scaling by 1 / m: the largest becomes exactly 1
        g /= m;
        b /= m;
        const float edge = kR * r + kG * g + kB * b;  // Y / m, the luminance at the gamut's edge
        const float missing = std::min(edge * m, 1.0F) - edge;
        // 1 - edge vanishes for greys, where c is white already and t does not matter.
        const float t = clip(missing / std::max(1 - edge, 1e-6F));
        r += t * (1 - r);
        g += t * (1 - g);
        b += t * (1 - b);
    }
    const float low = std::min(std::min(r, g), b);
    if (low < 0) {
        const float grey = std::max(kR * r + kG * g + kB * b, 0.0F);
        const float keep = grey / (grey - low);
        r = grey + keep * (r - grey);
        g = grey + keep * (g - grey);
        b = grey + keep * (b - grey);
    }
    r = clip(r);
    g = clip(g);
    b = clip(b);
}

// srgb_encode() for x in [0, 1], within 2e-6 (1/2000 of an 8-bit step): the power 1/2.4 is the
// power 5/3 of the fourth root, and that is so smooth that a minimax polynomial of degree 6 over
// the curved part [0.0031308, 1] does.
inline float fast_srgb_encode(float x) {
    const float q = std::sqrt(std::sqrt(x));
    const float curved =
        (((((0.0682075F * q - 0.31841425F) * q + 0.65718574F) * q - 0.85295554F) * q +
          1.36592028F) *
             q +
         0.13960429F) *
            q -
        0.05954662F;
    return x <= 0.0031308F ? 12.92F * x : std::min(curved, 1.0F);
}

}  // namespace aureole::color::kernels
