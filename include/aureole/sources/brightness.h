// How bright the pixels of a picture are, row by row: what decides which of them count as light.
#pragma once

#include "aureole/image/image.h"

namespace aureole::sources {

// out[x] = the largest |value| of the channels of pixel (x, y); `out` has room for view.width
// floats. `y` is within the picture. Allocates nothing.
void largest_channel_row(const ConstImageView& view, int y, float* out) noexcept;

// Of a pixel whose largest channel is `value`, the share that counts as bright: 0 up to
// `dim_limit`, 1 from `full_limit` on, smooth between; a step if full_limit <= dim_limit.
inline float bright_share(float value, float dim_limit, float full_limit) noexcept {
    if (value <= dim_limit) return 0;
    if (value >= full_limit) return 1;
    const float t = (value - dim_limit) / (full_limit - dim_limit);
    return t * t * (3 - 2 * t);
}

// Whether any of `count` values is above `limit`.
bool any_above(const float* values, int count, float limit) noexcept;

}  // namespace aureole::sources
