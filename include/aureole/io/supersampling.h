// Pictures that hold several samples for each pixel that they are to have: rendered at twice the
// size, say, to be seen at one.
#pragma once

#include "aureole/io/picture.h"

namespace aureole::io {

// Replaces a picture by one of 1/n of its width and height. Colour and alpha are the means of n x n
// samples, finite ones; of other channels (depth, ids) one sample is kept, the middle one. Both
// windows shrink alike.
// Throws InvalidArgument unless n is positive and both windows lie on multiples of n, and if other
// parts, whose size would stay, travel with the picture.
void average_samples(Picture& picture, int n);

}  // namespace aureole::io
