// Pictures of another size.
#pragma once

#include "aureole/image/image.h"

namespace aureole {

// The mean of each block of `factor` x `factor` pixels: what a pixel that large sees, so that the
// light of a picture stays the same. Summed in double precision; finite samples.
// Throws InvalidArgument unless factor is at least 1 and divides both sides.
Image area_average(const ConstImageView& picture, int factor);

}  // namespace aureole
