// Kernels of fewer channels than a PSF has (wave/psf.h).
#pragma once

#include "aureole/image/image.h"

namespace aureole::glare {

// What a grey picture sees: one channel from three or from a matrix, by the luminance of white.
Image luminance_kernel(const Image& kernel);

// Where the light of each primary goes, whatever becomes of its colour: three channels from three
// or from a matrix.
Image kernel_of_primaries(const Image& kernel);

}  // namespace aureole::glare
