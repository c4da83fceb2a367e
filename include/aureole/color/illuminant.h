// The spectra of lamps and of daylight.
#pragma once

#include <span>
#include <string_view>

#include "aureole/color/rgb.h"

namespace aureole::color {

// A light source by its spectrum. Where CIE 1931 chromaticities are given, they are what this
// module gets, with the published value behind them.
enum class Illuminant {
    kD65,          // CIE standard illuminant D65, linear between its 10 nm samples:
                   // (.3126, .3292), (.3127, .3290)
    kEqualEnergy,  // constant power: (.3330, .3337), (.3333, .3333)
    kTungsten,     // CIE standard illuminant A, a Planckian radiator of 2856 K (ISO/CIE 11664-2):
                   // (.446, .409), (.4476, .4074)
    kSodium,       // low-pressure sodium: the D lines only, 588.995 and 589.592 nm at 2:1 (NIST
                   // Atomic Spectra Database; an optically thin gas): (.568, .432), (.569, .430)
    kHighPressureSodium,  // street lamp, 5 nm table of NIST's "Color Quality Scale" spreadsheet 7.4
                          // (Davis & Ohno 2008): (.5215, .4186), (.5217, .4180)
    kMercury,  // clear high-pressure lamp, H38HT-100 of the same spreadsheet. Its six visible lines
               // stand at their wavelengths (NIST ASD) with the power that the table holds above
               // its continuum: (.313, .377), (.311, .383)
    kLed,      // phosphor-converted white LED of 4100 K: three lobes fitted to CIE LED-B3 (CIE
               // 015:2018), within 4 % of its peak: (.3765, .3723), (.3756, .3723)
};

// The names used on the command line: d65, equal-energy, tungsten, sodium, high-pressure-sodium,
// mercury, led. Throws InvalidArgument for any other.
Illuminant illuminant_from_name(std::string_view name);
std::string_view name_of(Illuminant illuminant);

// Relative spectral power per nm, without the lines; 0 for kSodium. D65, equal energy and tungsten
// are 100 at 560 nm. Tables are clamped outside 380-780 nm.
double relative_power(Illuminant illuminant, double wavelength_nm);

// Light of one wavelength: power in the unit of relative_power times nm.
struct SpectralLine {
    double wavelength_nm = 0;
    double power = 0;
};
// Lines in addition to relative_power, by wavelength; none for most.
std::span<const SpectralLine> spectral_lines(Illuminant illuminant);

// CIE 1931 tristimulus values of all the light from 380 to 770 nm, with Y = 1.
Xyz tristimulus(Illuminant illuminant);

}  // namespace aureole::color
