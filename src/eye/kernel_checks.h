// What every kernel of an eye asks of its grids, and its energy.
#pragma once

#include <array>

#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// Throws InvalidArgument unless the size is odd and the pitch in (0, 90) deg.
void check_kernel(const wave::KernelGrid& grid);
// Throws InvalidArgument unless 64 to 16384 samples over 10 to 100 mm.
void check_aperture(const wave::ApertureGrid& grid);

// Sum of each of three channels, row by row.
std::array<double, 3> plane_sums(const Image& image);
// 1 - plane_sums.
std::array<double, 3> energy_outside(const Image& image);

}  // namespace aureole::eye
