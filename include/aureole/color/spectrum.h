// Wavelengths and the colours they make.
#pragma once

#include <vector>

#include "aureole/color/illuminant.h"
#include "aureole/color/rgb.h"

namespace aureole::color {

// CIE 1931 2-degree colour matching functions, by the multi-lobe fit of Wyman, Sloan & Shirley
// 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", table 1
// (maximum error .015 / .008 / .024).
Xyz cie_1931_observer(double wavelength_nm);

enum class WavelengthSpacing {
    kLogarithmic,  // equal ratios: a diffraction pattern scales with wavelength, so equal ratios
                   // shift its rings by equal fractions of their radius
    kLinear,       // equal steps, as in the thesis (32 of them)
};

// One band of the visible spectrum.
struct SpectralBand {
    double wavelength_nm = 0;  // centre of the band
    Rgb rgb = {};              // linear sRGB weight; over all bands each component sums to 1
    double y = 0;              // luminance weight; over all bands sums to 1
};

struct SpectralRange {
    double low_nm = 380;
    double high_nm = 770;
};

// The spectrum cut into `count` bands, weighted by observer and illuminant. The weights of each
// RGB component sum to 1, so that a source with the illuminant's spectrum keeps its colour
// whatever diffraction does to its wavelengths (that of D65 stays neutral). Weights may be
// negative: spectral colours lie outside the sRGB gamut.
// Each weight is an integral over its band, not a sample. Every line of the illuminant is a band of
// its own, at its exact wavelength, in addition to `count`; bands without light are left out.
// A component that the source all but lacks, where positive and negative weights cancel to less
// than a tenth of their magnitude (the blue of kHighPressureSodium), takes the weights of
// luminance.
// Throws InvalidArgument unless count >= 1, 0 < low < high and the range holds light of every RGB
// component.
std::vector<SpectralBand> sample_spectrum(
    int count, WavelengthSpacing spacing = WavelengthSpacing::kLogarithmic,
    Illuminant illuminant = Illuminant::kD65, SpectralRange range = {});

// A single wavelength with unit weight in every component: monochromatic patterns.
std::vector<SpectralBand> single_wavelength(double wavelength_nm);

}  // namespace aureole::color
