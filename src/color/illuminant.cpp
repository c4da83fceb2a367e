#include "aureole/color/illuminant.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "aureole/base/error.h"

namespace aureole::color {
namespace {

constexpr struct {
    Illuminant illuminant;
    std::string_view name;
} kNames[] = {{Illuminant::kD65, "d65"},
              {Illuminant::kEqualEnergy, "equal-energy"},
              {Illuminant::kTungsten, "tungsten"},
              {Illuminant::kSodium, "sodium"},
              {Illuminant::kHighPressureSodium, "high-pressure-sodium"},
              {Illuminant::kMercury, "mercury"},
              {Illuminant::kLed, "led"}};

constexpr double kD65[] = {
#include "color/d65.inc"
};
constexpr double kHighPressureSodium[] = {
#include "color/high_pressure_sodium.inc"
};
constexpr double kMercuryContinuum[] = {
#include "color/mercury_continuum.inc"
};
constexpr double kTablesFirstNm = 380;

constexpr SpectralLine kSodiumLines[] = {{588.995, 2}, {589.592, 1}};

// The three lines of the triplet 404.7, 435.8, 546.1 nm (6s6p 3P - 6s7s 3S), 407.8 nm, and the
// yellow pair. The table is too coarse to tell how 404.7 and 407.8, and how the pair, share their
// power: 3:1 and equal shares are assumed.
constexpr SpectralLine kMercuryLines[] = {{404.656, 1.757}, {407.783, 0.586}, {435.833, 4.815},
                                          {546.075, 6.213}, {576.960, 2.820}, {579.066, 2.820}};

// A Gaussian with a width on either side: the diode, and the phosphor as the sum of two.
struct Lobe {
    double amplitude;
    double centre_nm;
    double left_nm;
    double right_nm;
};
constexpr Lobe kLedLobes[] = {
    {16.30, 448.23, 9.62, 9.23}, {7.88, 608.82, 43.54, 41.39}, {11.15, 536.98, 48.58, 90.45}};

template <std::size_t kCount>
double interpolate(const double (&table)[kCount], double step_nm, double wavelength_nm) {
    constexpr int kLast = static_cast<int>(kCount) - 1;
    const double position =
        std::clamp((wavelength_nm - kTablesFirstNm) / step_nm, 0.0, kLast * 1.0);
    const int i = std::min(static_cast<int>(position), kLast - 1);
    return table[i] + (position - i) * (table[i + 1] - table[i]);
}

// CIE standard illuminant A as its standard defines it: 2848 K on the scale of c2 = 14350 um K.
double planckian(double wavelength_nm) {
    constexpr double kC2OverTemperatureNm = 1.435e7 / 2848;
    return 100 * std::pow(560 / wavelength_nm, 5) * std::expm1(kC2OverTemperatureNm / 560) /
           std::expm1(kC2OverTemperatureNm / wavelength_nm);
}

double led(double wavelength_nm) {
    double sum = 0;
    for (const Lobe& lobe : kLedLobes) {
        const double distance = wavelength_nm - lobe.centre_nm;
        const double t = distance / (distance < 0 ? lobe.left_nm : lobe.right_nm);
        sum += lobe.amplitude * std::exp(-0.5 * t * t);
    }
    return sum;
}

}  // namespace

Illuminant illuminant_from_name(std::string_view name) {
    for (const auto& entry : kNames) {
        if (entry.name == name) return entry.illuminant;
    }
    throw InvalidArgument("source spectrum", std::string(name),
                          "must be d65, equal-energy, tungsten, sodium, high-pressure-sodium, "
                          "mercury or led");
}

std::string_view name_of(Illuminant illuminant) {
    return std::find_if(std::begin(kNames), std::end(kNames),
                        [&](const auto& entry) { return entry.illuminant == illuminant; })
        ->name;
}

double relative_power(Illuminant illuminant, double wavelength_nm) {
    switch (illuminant) {
        case Illuminant::kD65:
            return interpolate(kD65, 10, wavelength_nm);
        case Illuminant::kTungsten:
            return planckian(wavelength_nm);
        case Illuminant::kSodium:
            return 0;
        case Illuminant::kHighPressureSodium:
            return interpolate(kHighPressureSodium, 5, wavelength_nm);
        case Illuminant::kMercury:
            return interpolate(kMercuryContinuum, 10, wavelength_nm);
        case Illuminant::kLed:
            return led(wavelength_nm);
        case Illuminant::kEqualEnergy:
            break;
    }
    return 100;
}

std::span<const SpectralLine> spectral_lines(Illuminant illuminant) {
    if (illuminant == Illuminant::kSodium) return kSodiumLines;
    if (illuminant == Illuminant::kMercury) return kMercuryLines;
    return {};
}

}  // namespace aureole::color
