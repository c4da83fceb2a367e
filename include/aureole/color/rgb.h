// Linear RGB with the primaries of sRGB / Rec. 709 and white D65: the working space.
#pragma once

#include <array>

namespace aureole::color {

using Rgb = std::array<double, 3>;
using Xyz = std::array<double, 3>;

// Relative luminance of linear sRGB (the Y row of IEC 61966-2-1).
inline constexpr Rgb kLuminanceWeights = {0.2126, 0.7152, 0.0722};

constexpr double luminance(const Rgb& rgb) {
    return kLuminanceWeights[0] * rgb[0] + kLuminanceWeights[1] * rgb[1] +
           kLuminanceWeights[2] * rgb[2];
}

// IEC 61966-2-1 matrices; xyz_from_rgb is the exact inverse of rgb_from_xyz.
Rgb rgb_from_xyz(const Xyz& xyz);
Xyz xyz_from_rgb(const Rgb& rgb);

// CIE 1931 chromaticity (x, y) of linear sRGB. Undefined for X + Y + Z == 0.
std::array<double, 2> chromaticity(const Rgb& rgb);

// sRGB transfer functions (IEC 61966-2-1), extended to negative values by symmetry.
float srgb_encode(float linear);
float srgb_decode(float encoded);

}  // namespace aureole::color
