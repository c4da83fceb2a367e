// The kernel that a grey picture sees.
#pragma once

#include "aureole/image/image.h"

namespace aureole::glare {

// One channel from three, by luminance.
Image luminance_kernel(const Image& kernel);

}  // namespace aureole::glare
