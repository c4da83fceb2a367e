// From one monochromatic diffraction pattern to a coloured kernel on a pixel grid.
//
// A Fraunhofer pattern depends on wavelength only through its scale: sample k of the transform of
// an aperture of extent L is the direction cosine k lambda / L, and the energy of a sample does
// not change. (Densities therefore obey PSF_l(theta) = (l0/l)^2 PSF_l0(theta l0/l).) A pixel
// covers tens of samples near the axis, so it must be integrated, never point-sampled: the
// pattern is held as a summed-area table (Crow 1984), from which any rectangle of samples,
// fractional edges included, is four look-ups.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "aureole/color/spectrum.h"
#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::wave {

// The integral of an N x N pattern in centred order: sample (N/2, N/2) is the axis, each sample
// is a unit square around its index.
class PatternIntegral {
  public:
    // `pattern` has samples * samples values in centred order; it is not kept.
    PatternIntegral(const float* pattern, int samples);

    int samples() const { return samples_; }
    // Sum of the pattern over [u0, u1] x [v0, v1], in samples relative to the axis (0 is the
    // centre of the axis sample); parts outside the pattern count as 0.
    double sum(double u0, double u1, double v0, double v1) const;

  private:
    int samples_;
    std::vector<double> table_;  // (samples + 1)^2, row-major
};

// What a pixel receives from a pattern.
enum class PixelRule {
    kEnergy,  // the sum over its footprint: for patterns of energy
    kMean,    // that sum divided by the footprint's area in samples: for textures, whose values
              // are relative (what lies outside the band counts as 0)
};

// Pixels whose centre is at least min_deg and less than max_deg away from the kernel's centre.
struct AngleRange {
    double min_deg = 0;
    double max_deg = 180;
};

// Adds sum_b rgb_b * pixel(pattern at wavelength_b) to every pixel of `out` (3 channels, the size
// of the grid). `extent_mm` is that of the aperture. Directions: pixel (x, y) of the grid looks
// along direction cosines (alpha, beta), image x to the right = aperture x, image y down =
// aperture -y. Pixels outside `range` are left alone.
void add_spectral(const PatternIntegral& pattern, double extent_mm, PixelRule rule,
                  std::span<const color::SpectralBand> bands, const KernelGrid& grid,
                  AngleRange range, const ImageView& out);

}  // namespace aureole::wave
