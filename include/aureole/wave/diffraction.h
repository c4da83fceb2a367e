// Fraunhofer, defocus and Fresnel diffraction of an aperture, by one Fourier transform each.
//
// Unit energy: the intensities of a pattern, times solid angle, sum to 1 over all directions in
// the band. In direction cosines (alpha, beta) = (k, l) lambda / L a sample covers (lambda / L)^2,
// and d Omega = d alpha d beta / cos(theta).
#pragma once

#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/fourier/fft.h"
#include "aureole/wave/aperture.h"

namespace aureole::wave {

// Energy per sample in centred order: sample (N/2, N/2) is the axis; sums to 1.
struct Pattern {
    ApertureGrid grid;
    Buffer energy;

    // Direction cosine between neighbouring samples: lambda / extent.
    double step(double wavelength_nm) const;
    // Intensity at sample (k, l) from the axis, sr^-1: energy * cos(theta) / step^2. 0 for
    // evanescent samples (alpha^2 + beta^2 >= 1).
    double intensity_per_sr(int k, int l, double wavelength_nm) const;
};

// Transforms the field in place (unshifted order: frequency 0 at index 0; relative to a transform
// about the axis, sample (k, l) carries the sign (-1)^(k + l), which no intensity sees). Columns
// that hold no light are not transformed. Returns sum |field|^2 * N^2 of the aperture, by which
// |F|^2 is divided to make energy per sample.
// `fft` must have the size of the grid. Throws InvalidArgument if it has not, or if the field is
// zero everywhere ("the mask has no opening").
double transform(Field& field, fourier::Fft2d& fft);

// |F{field}|^2 in angles (Goodman, "Introduction to Fourier Optics", eq. 4-25), scaled to a sum
// of 1. A sample of a field is the mean of the light over its square (that is how masks are
// drawn), which dims the ends of the band; the known factors sinc^2(pi k / N) sinc^2(pi l / N) are
// divided out, unless Field::box_filtered says otherwise. The field is consumed: it holds the
// transform afterwards. Throws as transform() does.
Pattern fraunhofer(Field& field, fourier::Fft2d& fft);

// Multiplies the field by exp(i pi D r^2 / lambda): residual defocus of D dioptres (1/m).
// Unless D is 0 the samples are no means any more: clears Field::box_filtered.
void add_defocus(Field& field, double defocus_dioptres, double wavelength_nm);

// Longitudinal chromatic aberration of the eye relative to 580 nm, in dioptres: Thibos et al.
// 1992, "The chromatic eye": 1.7312 - 0.63346 / (lambda_um - 0.21410).
double chromatic_defocus_dioptres(double wavelength_nm);

// The literal Fresnel term of the thesis, eq. 2.12: exp(i pi r^2 / (lambda d)), an eye *without* a
// lens whose retina is at distance d. The same as add_defocus with D = 1000 / d_mm.
void add_fresnel_term(Field& field, double distance_mm, double wavelength_nm);

// Largest spacing (mm) that samples the quadratic phase of D dioptres without aliasing up to
// radius r: lambda / (2 |D| r).
double max_spacing_for_defocus_mm(double defocus_dioptres, double radius_mm, double wavelength_nm);

// ---- Rings: sets of samples at equal rounded distance from the axis, in samples ----

// Ring r holds the samples with r - 1/2 < sqrt(k^2 + l^2) <= r + 1/2. Rings reach the corners:
// there are round(N / sqrt(2)) + 1 of them.
int ring_count(int samples);
// Mean over each ring of a transform (unshifted order) of |F|^2, freed from the sample's box filter
// as in fraunhofer().
std::vector<double> ring_means(const Field& transform);

}  // namespace aureole::wave
