// What every kernel of an eye asks of its grids, and its energy.
#pragma once

#include <array>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// Throws InvalidArgument unless the size is odd and the pitch in (0, 90) deg.
void check_kernel(const wave::KernelGrid& grid);
// Throws InvalidArgument unless 64 to 16384 samples over 10 to 100 mm.
void check_aperture(const wave::ApertureGrid& grid);

// Whether a channel of a kernel, one of 3 or of a matrix of 9 (wave/psf.h), holds what light
// becomes in its own colour.
constexpr bool is_own_colour(int channel, int channels) {
    return channels == 3 || channel / 3 == channel % 3;
}

// Sum of each channel, row by row.
std::vector<double> plane_sums(const Image& image);
// What white light lacks in each of three colours.
std::array<double, 3> energy_outside(const Image& kernel);

}  // namespace aureole::eye
