// From one monochromatic diffraction pattern to a coloured kernel on a pixel grid.
//
// A Fraunhofer pattern depends on wavelength only through its scale: sample k of the transform of
// an aperture of extent L is the direction cosine k lambda / L, and the energy of a sample does
// not change. (Densities therefore obey PSF_l(theta) = (l0/l)^2 PSF_l0(theta l0/l).) A pixel
// covers tens of samples near the axis, so it must be integrated, never point-sampled: the
// pattern is held as a summed-area table (Crow 1984), from which any rectangle of samples,
// fractional edges included, is four look-ups.
#pragma once

#include <span>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/color/spectrum.h"
#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::wave {

// A value per ring of samples (diffraction.h) that turns the squared modulus of a transform into a
// pattern: value = |F|^2 scale[ring] + offset[ring]. An empty offset is 0; rings beyond the end of
// `scale` give 0.
struct RingWeights {
    std::vector<float> scale;
    std::vector<float> offset;
};

// The integral of an N x N pattern in centred order: sample (N/2, N/2) is the axis, each sample
// is a unit square around its index.
class PatternIntegral {
  public:
    // `pattern` has samples * samples values in centred order; it is not kept.
    PatternIntegral(const float* pattern, int samples);
    // From a transform in unshifted order, without an intermediate plane; |F|^2 is freed from the
    // sample's box filter as in fraunhofer(). Throws InvalidArgument
    // if offset is neither empty nor as long as scale.
    static PatternIntegral from_transform(const Field& transform, const RingWeights& weights);
    // The same with one scale for all samples. 1 / (what transform() returned) makes it energy to
    // within the share of edge samples and of light beyond the band (some 1e-3); to have exactly 1,
    // divide by total().
    static PatternIntegral from_transform(const Field& transform, double scale);

    int samples() const { return samples_; }
    // Sum of the pattern over [u0, u1] x [v0, v1], in samples relative to the axis (0 is the
    // centre of the axis sample); parts outside the pattern count as 0.
    double sum(double u0, double u1, double v0, double v1) const;
    // Sum of the whole pattern.
    double total() const;

    // The summed-area table: (samples + 1)^2 values, row-major; entry (i, j) is the sum of all
    // samples with indices below i and j. In doubles: a pixel in the wings holds 1e-10 of the sum.
    const double* table() const { return reinterpret_cast<const double*>(memory_.data()); }

  private:
    explicit PatternIntegral(int samples);
    template <class RowSource>
    void integrate(const RowSource& source);
    double* table() { return reinterpret_cast<double*>(memory_.data()); }

    int samples_;
    Buffer memory_;  // of floats for its alignment and huge pages; holds doubles
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

// Whether the pattern is known to look the same after a half turn, as those of all real apertures
// do: then half of the pixels are computed and the others are their mirror images.
enum class Symmetry { kNone, kHalfTurn };

// Adds sum_b rgb_b * pixel(pattern at wavelength_b) to every pixel of `out` (3 channels, the size
// of the grid). `extent_mm` is that of the aperture. Directions: pixel (x, y) of the grid looks
// along direction cosines (alpha, beta), image x to the right = aperture x, image y down =
// aperture -y. Pixels outside `range` are left alone.
void add_spectral(const PatternIntegral& pattern, double extent_mm, PixelRule rule,
                  std::span<const color::SpectralBand> bands, const KernelGrid& grid,
                  AngleRange range, const ImageView& out, Symmetry symmetry = Symmetry::kNone);

}  // namespace aureole::wave
