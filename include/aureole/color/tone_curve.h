// From linear scene values to what a display shows.
#pragma once

#include <array>
#include <string_view>

#include "aureole/image/image.h"

namespace aureole::color {

enum class ToneCurve {
    kNone,       // clip to [0, 1]
    kNarkowicz,  // Narkowicz 2016, "ACES Filmic Tone Mapping Curve", with the exposure factor 0.6
                 // of the original curve; per channel, so bright hues shift
    kHill,       // Stephen Hill's fit of the ACES RRT and ODT (BakingLab): through the RRT's space,
                 // so bright colours turn white
    kXyz,        // hue-preserving: see hue_preserving() below
    kUnity,      // the fit of ACES in Unity's Post Processing Stack v2, without its glow and red
                 // modifier: in ACEScg, for a dim surround; 1 becomes .80 on a display, and white
                 // is .95 of the display's light
};

// The names used on the command line: none, narkowicz, hill, xyz, unity.
// Throws InvalidArgument for any other.
ToneCurve tone_curve_from_name(std::string_view name);

using Rgbf = std::array<float, 3>;

// Linear sRGB, any values -> display-linear sRGB in [0, 1] (before srgb_encode).
Rgbf tone_map(ToneCurve curve, const Rgbf& rgb);

// Keeps hue at any exposure (after Sikachev, Tisevich & Ignatenko, "Quad-trees for glare",
// section 3.3, made continuous). In CIE XYZ, negative components are clipped; Y is the luminance
// and m the largest of the linear R, G, B:
//   m <= 1: unchanged;
//   m > 1:  c = rgb / m reaches the edge of the display's gamut with hue and saturation kept, at
//           luminance Y / m; what luminance is missing up to min(Y, 1) is made up by white:
//           out = c + t (1 - c),  t = (min(Y, 1) - Y/m) / (1 - Y/m).
// Components below 0 after the conversion (outside the gamut) are lifted to 0 by mixing in the
// grey of equal luminance.
Rgbf hue_preserving(const Rgbf& rgb);

// Tone-maps three channels and encodes them as sRGB. `rgb` and `out` have 3 channels and equal
// size, and may be the same memory. `exposure_scale` multiplies the input first (2^EV).
// Throws InvalidArgument for other shapes.
void tone_map_to_srgb(ToneCurve curve, float exposure_scale, const ConstImageView& rgb,
                      const ImageView& out);

}  // namespace aureole::color
