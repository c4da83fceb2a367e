// Sums over the rows of a strip of a picture, column by column.
#pragma once

#include "aureole/image/image.h"

namespace aureole::sources {

// Adds row `y` to columns: energy[x] += weights[x] * sum over channels of |value|, and largest[x] =
// the largest |value| so far. `weights`: of the row, null for 1. Arrays of view.width floats.
void add_brightness_row(const ConstImageView& view, const float* weights, int y, float* energy,
                        float* largest) noexcept;

}  // namespace aureole::sources
