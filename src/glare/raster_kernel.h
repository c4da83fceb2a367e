// The kernel of a coarse raster.
#pragma once

#include "aureole/image/image.h"

namespace aureole::glare {

// The kernel K on the raster for which B K B^T (raster.h) is as near to far as can be: of all
// squares of the difference, over all pixels and all places of the source, the sum is the least.
//     K = G^-1 (B^T far B) G^-1,   G = B^T B,
// axis by axis. B has equal sums, so that scale^2 times the sum of K is that of far.
// Node (x, y) is `scale` (x - width / 2, y - height / 2) pixels from the source. Beyond far's
// border there is nothing; the result has some nodes more, in which the ringing of G^-1 fades.
Image raster_kernel(const Image& far, int scale);

}  // namespace aureole::glare
