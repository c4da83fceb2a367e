// Pictures of transmission, averaged over squares of any size.
#pragma once

#include "aureole/image/image.h"
#include "aureole/lens/iris.h"

namespace aureole::lens {

// The transmission of a picture, one channel: the first of two or fewer, else the mean of three,
// clamped to [0, 1]; NaN counts as 0. `what` names it in the InvalidArgument for an empty one.
Image transmission_of(const ConstImageView& picture, const char* what);

// Halves it until one pixel is left. Texel (i, j) of level l is the mean over pixels
// [i 2^l, (i + 1) 2^l); beyond the picture they count as `outside`.
TransmissionPyramid transmission_pyramid(Image level_0, float outside);

// Around continuous pixel position (x, y) of level 0, averaged over a square of side
// `footprint_px`: bilinear within and linear between the two levels whose texels enclose it.
float sample(const TransmissionPyramid& pyramid, float x, float y, float footprint_px,
             float outside) noexcept;

}  // namespace aureole::lens
