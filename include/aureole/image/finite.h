// The policy for values that are not numbers. One NaN or infinity would spread over the whole
// picture in a convolution, so they are replaced before anything else is done and counted, never
// passed over in silence. Negative values are legitimate (renderer filters with negative lobes,
// wide-gamut colours) and stay.
#pragma once

#include <cstddef>

#include "aureole/image/image.h"

namespace aureole {

// Replaces every NaN and infinity by 0 and leaves everything else untouched, bit for bit. Returns
// the number of pixels that had at least one. To treat some channels only (colour, but not a depth
// channel whose background is legitimately infinite), pass view.channel_range(first, count).
std::size_t replace_nonfinite(const ImageView& view);

}  // namespace aureole
