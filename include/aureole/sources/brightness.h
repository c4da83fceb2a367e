// How bright the pixels of a picture are, row by row: what decides which of them count as light.
#pragma once

#include "aureole/image/image.h"

namespace aureole::sources {

// out[x] = the largest |value| of the channels of pixel (x, y); `out` has room for view.width
// floats. `y` is within the picture. Allocates nothing.
void largest_channel_row(const ConstImageView& view, int y, float* out) noexcept;

// Whether any of `count` values is above `limit`.
bool any_above(const float* values, int count, float limit) noexcept;

}  // namespace aureole::sources
