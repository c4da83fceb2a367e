// starburst_psf() for anything that stands before the iris.
#pragma once

#include "aureole/lens/starburst.h"
#include "lens/starburst_aperture.h"

namespace aureole::lens {

wave::Psf starburst_behind(const Iris& iris, double pupil_diameter_mm, const wave::KernelGrid& grid,
                           const StarburstOptions& options, const Obstacles& obstacles,
                           Progress* progress = nullptr);

}  // namespace aureole::lens
