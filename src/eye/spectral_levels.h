// How many wavelengths each part of a kernel needs.
//
// A ray of a diffraction pattern at radius r moves by r d(ln lambda) from one band to the next.
// Bands further apart than about a pixel leave dots where there should be a continuous ray; bands
// closer than that are work for nothing. So the count doubles from ring to ring outwards.
#pragma once

#include <vector>

#include "aureole/color/spectrum.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/wave/spectral_psf.h"

namespace aureole::eye {

struct SpectralLevel {
    wave::AngleRange range;
    std::vector<color::SpectralBand> bands;
};

// Levels from the centre to the end of the kernel, without gaps. Throws InvalidArgument for a
// sampling outside its ranges, and one by colour.
std::vector<SpectralLevel> spectral_levels(const SpectralSampling& sampling,
                                           const wave::KernelGrid& grid);

// The same for each light that a kernel has channels for: one, or the primaries by colour. Throws
// InvalidArgument for a sampling outside its ranges.
std::vector<std::vector<SpectralLevel>> levels_of_lights(const SpectralSampling& sampling,
                                                         const wave::KernelGrid& grid);

// wave::add_spectral for each level; the pattern must be symmetric under a half turn.
void add_spectral(const wave::PatternIntegral& pattern, double extent_mm, wave::PixelRule rule,
                  const std::vector<SpectralLevel>& levels, const wave::KernelGrid& grid,
                  const ImageView& out);

// Longest wavelength that carries weight, nm.
double longest_wavelength_nm(const std::vector<std::vector<SpectralLevel>>& lights);

}  // namespace aureole::eye
