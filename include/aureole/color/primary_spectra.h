// Spectra for colours: what light a colour is most likely made of.
//
// A linear sRGB colour (r, g, b) is taken for D65 behind a filter,
//     L(lambda) = D65(lambda) (r p_r(lambda) + g p_g(lambda) + b p_b(lambda)),
// p_j being the smoothest three curves with sum 1, none below 0, with which the light of each
// primary has the primary's colour (Mallett & Yuksel 2019, "Spectral Primary Decomposition for
// Rendering with sRGB Reflectance"). So white is D65, colours add up, no light is negative, and
// every spectrum has the colour it came from.
#pragma once

#include <array>
#include <vector>

#include "aureole/color/rgb.h"
#include "aureole/color/spectrum.h"

namespace aureole::color {

// (p_r, p_g, p_b), each 0 to 1, with sum 1. Linear between nodes every 5 nm, constant outside 380
// to 770 nm.
Rgb primary_shares(double wavelength_nm);

// One band of the visible spectrum, 380 to 770 nm.
struct PrimaryBand {
    double wavelength_nm = 0;         // centre of the band
    std::array<Rgb, 3> primary = {};  // linear sRGB weight of the light of the primary red, green,
                                      // blue; over all bands, component c of primary j sums to 1 if
                                      // j == c, to 0 else (within 1e-5)
};

// D65 cut into `count` bands as by sample_spectrum(), and each of them shared among the primaries:
// the sum of a band over the primaries is its weight there. Throws InvalidArgument unless count >=
// 1.
std::vector<PrimaryBand> sample_primaries(
    int count, WavelengthSpacing spacing = WavelengthSpacing::kLogarithmic);

}  // namespace aureole::color
