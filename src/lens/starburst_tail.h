// Light of a starburst beyond the raster of its pattern, pixel by pixel.
#pragma once

#include <span>

#include "aureole/color/spectrum.h"
#include "aureole/wave/psf.h"
#include "lens/starburst_pattern.h"

namespace aureole::lens {

// Adds the law p(phi) / rho^3, where the raster has handed over to it, for all bands.
void add_beyond(const StarburstPattern& pattern, std::span<const color::SpectralBand> bands,
                const wave::KernelGrid& grid, Image& out);

}  // namespace aureole::lens
