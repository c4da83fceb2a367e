// Fraunhofer, defocus and Fresnel diffraction of an aperture, by one Fourier transform each.
//
// Unit energy: the intensities of a pattern, times solid angle, sum to 1 over all directions in
// the band. In direction cosines (alpha, beta) = (k, l) lambda / L a sample covers (lambda / L)^2,
// and d Omega = d alpha d beta / cos(theta).
#pragma once

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

// |F{field}|^2 / (sum |field|^2 * N^2): Goodman, "Introduction to Fourier Optics", eq. 4-25 in
// angles. The field is consumed: it holds the transform (in unshifted order) afterwards.
// `fft` must have the size of the grid. Throws InvalidArgument if the field is zero everywhere
// ("the mask has no opening").
Pattern fraunhofer(Field& field, fourier::Fft2d& fft);

// Multiplies the field by exp(i pi D r^2 / lambda): residual defocus of D dioptres (1/m).
void add_defocus(Field& field, double defocus_dioptres, double wavelength_nm);

// Longitudinal chromatic aberration of the eye relative to 580 nm, in dioptres: Thibos et al.
// 1992, "The chromatic eye": 1.7312 - 0.63346 / (lambda_um - 0.21410).
double chromatic_defocus_dioptres(double wavelength_nm);

// The literal Fresnel term of the thesis, eq. 2.12: exp(i pi r^2 / (lambda d)), an eye *without* a
// lens whose retina is at distance d. The same as add_defocus with D = 1000 / d_mm.
void add_fresnel_term(Field& field, double distance_mm, double wavelength_nm);

// Largest spacing (mm) that samples the quadratic phase of D dioptres without aliasing up to
// radius r: lambda / (2 |D| r).
double max_spacing_for_defocus_mm(double defocus_dioptres, double radius_mm,
                                  double wavelength_nm);

}  // namespace aureole::wave
