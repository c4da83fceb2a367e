// What a coarse raster gets wrong.
#pragma once

#include "aureole/image/image.h"

namespace aureole::glare {

// How far B K B^T is from far: the sum of |difference| over what a source of 1 becomes, the largest
// over channels and over 2 x 2 places of the source within a node. Returns as soon as that is known
// to be more than `enough`.
double raster_error(const Image& far, const Image& kernel, int scale, double enough);

}  // namespace aureole::glare
