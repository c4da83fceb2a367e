// Where the light of a picture goes.
#pragma once

#include <vector>

#include "aureole/image/image.h"
#include "aureole/wave/psf.h"

namespace aureole::glare {

// Sums over pixels and colour channels of value * weight, the weight being the pixel's solid angle
// (sr) in a perspective picture and 1 otherwise. in + from_surround + added == out + off_picture,
// up to rounding.
struct Energy {
    double in = 0;
    double out = 0;
    double off_picture = 0;    // scattered beyond the picture's border or a truncated kernel, and
                               // what approximate methods cut off
    double from_surround = 0;  // scattered in from beyond the border; 0 for Surround::kDark
    double added = 0;          // glare that was not taken from the picture (GlareOptions::added)
};

// For every pixel, the share of its light that a kernel leaves inside the picture:
//   m(s) = sum over x inside the picture of k(x - s),
// by running sums in double precision: exact, and independent of how the picture is convolved.
// One plane per kernel channel. Any kernel size.
Image share_inside(int width, int height, const ConstImageView& kernel);

}  // namespace aureole::glare
