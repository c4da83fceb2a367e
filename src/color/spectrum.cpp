#include "aureole/color/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aureole/base/error.h"

namespace aureole::color {
namespace {

// One lobe of the fit: a Gaussian with a width on either side, 1/sigma in nm^-1.
struct Lobe {
    double amplitude;
    double centre_nm;
    double inverse_width_left;
    double inverse_width_right;
};

constexpr Lobe kX[] = {{1.056, 599.8, 0.0264, 0.0323},
                       {0.362, 442.0, 0.0624, 0.0374},
                       {-0.065, 501.1, 0.0490, 0.0382}};
constexpr Lobe kY[] = {{0.821, 568.8, 0.0213, 0.0247}, {0.286, 530.9, 0.0613, 0.0322}};
constexpr Lobe kZ[] = {{1.217, 437.0, 0.0845, 0.0278}, {0.681, 459.0, 0.0385, 0.0725}};

template <std::size_t kCount>
double sum_of_lobes(const Lobe (&lobes)[kCount], double wavelength_nm) {
    double sum = 0;
    for (const Lobe& lobe : lobes) {
        const double distance = wavelength_nm - lobe.centre_nm;
        const double t =
            distance * (distance < 0 ? lobe.inverse_width_left : lobe.inverse_width_right);
        sum += lobe.amplitude * std::exp(-0.5 * t * t);
    }
    return sum;
}

// The observer changes by less than 1 % per nanometre, D65 has a kink every ten: the midpoint
// rule at this step integrates a band to 1e-4.
constexpr double kIntegrationStepNm = 1;

// A component whose positive and negative light cancel to less than this share of their sum
// has no colour that its weights could be relative to.
constexpr double kLeastNetLight = 0.1;

template <class Visit>
void over_steps(Illuminant illuminant, double low_nm, double high_nm, const Visit& visit) {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((high_nm - low_nm) / kIntegrationStepNm)));
    const double step_nm = (high_nm - low_nm) / steps;
    for (int i = 0; i < steps; ++i) {
        const double wavelength_nm = low_nm + (i + 0.5) * step_nm;
        visit(wavelength_nm, relative_power(illuminant, wavelength_nm) * step_nm);
    }
}

void add(Xyz& sum, double wavelength_nm, double power) {
    const Xyz observer = cie_1931_observer(wavelength_nm);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += observer[c] * power;
}

// Tristimulus values of the light between two wavelengths, without lines.
Xyz integrate(Illuminant illuminant, double low_nm, double high_nm) {
    Xyz result{};
    over_steps(illuminant, low_nm, high_nm,
               [&](double wavelength_nm, double power) { add(result, wavelength_nm, power); });
    return result;
}

// Every piece of the visible light of a source: steps of its continuum, and its lines.
template <class Visit>
void over_light(Illuminant illuminant, const Visit& visit) {
    const SpectralRange visible;
    over_steps(illuminant, visible.low_nm, visible.high_nm, visit);
    for (const SpectralLine& line : spectral_lines(illuminant)) {
        visit(line.wavelength_nm, line.power);
    }
}

// Whether the weights of each component can be relative to the source's own colour.
std::array<bool, 3> has_components(Illuminant illuminant) {
    Rgb net{};
    Rgb magnitude{};
    over_light(illuminant, [&](double wavelength_nm, double power) {
        Xyz xyz{};
        add(xyz, wavelength_nm, power);
        const Rgb rgb = rgb_from_xyz(xyz);
        for (std::size_t c = 0; c < 3; ++c) {
            net[c] += rgb[c];
            magnitude[c] += std::abs(rgb[c]);
        }
    });
    std::array<bool, 3> result{};
    for (std::size_t c = 0; c < 3; ++c) {
        result[c] = std::abs(net[c]) >= kLeastNetLight * magnitude[c];
    }
    return result;
}

}  // namespace

Xyz cie_1931_observer(double wavelength_nm) {
    return {sum_of_lobes(kX, wavelength_nm), sum_of_lobes(kY, wavelength_nm),
            sum_of_lobes(kZ, wavelength_nm)};
}

Xyz tristimulus(Illuminant illuminant) {
    Xyz sum{};
    over_light(illuminant,
               [&](double wavelength_nm, double power) { add(sum, wavelength_nm, power); });
    return {sum[0] / sum[1], 1, sum[2] / sum[1]};
}

std::vector<SpectralBand> sample_spectrum(int count, WavelengthSpacing spacing,
                                          Illuminant illuminant, SpectralRange range) {
    if (count < 1) {
        throw InvalidArgument("wavelengths", std::to_string(count), "must be at least 1");
    }
    const std::string range_text =
        std::to_string(range.low_nm) + " to " + std::to_string(range.high_nm);
    if (!(range.low_nm > 0 && range.low_nm < range.high_nm && std::isfinite(range.high_nm))) {
        throw InvalidArgument("spectral range (nm)", range_text, "must be 0 < low < high");
    }
    const bool logarithmic = spacing == WavelengthSpacing::kLogarithmic;
    const auto position_nm = [&](double t) {
        return logarithmic ? range.low_nm * std::pow(range.high_nm / range.low_nm, t)
                           : range.low_nm + (range.high_nm - range.low_nm) * t;
    };

    std::vector<SpectralBand> bands;
    Rgb sum{};
    Rgb magnitude{};
    double sum_y = 0;
    const auto add_band = [&](double wavelength_nm, const Xyz& xyz) {
        if (xyz == Xyz{}) return;
        const SpectralBand band{wavelength_nm, rgb_from_xyz(xyz), xyz[1]};
        sum_y += band.y;
        for (std::size_t c = 0; c < 3; ++c) {
            sum[c] += band.rgb[c];
            magnitude[c] += std::abs(band.rgb[c]);
        }
        bands.push_back(band);
    };
    for (int i = 0; i < count; ++i) {
        add_band(position_nm((i + 0.5) / count), integrate(illuminant, position_nm(i * 1.0 / count),
                                                           position_nm((i + 1.0) / count)));
    }
    for (const SpectralLine& line : spectral_lines(illuminant)) {
        if (line.wavelength_nm < range.low_nm || line.wavelength_nm > range.high_nm) continue;
        Xyz xyz{};
        add(xyz, line.wavelength_nm, line.power);
        add_band(line.wavelength_nm, xyz);
    }
    const std::array<bool, 3> relative = has_components(illuminant);
    for (std::size_t c = 0; c < 3; ++c) {
        // Outside the visible, or where the negative part of a component cancels the rest, the
        // component has no weight that could be scaled to 1.
        if ((relative[c] && !(std::abs(sum[c]) > 0.01 * magnitude[c])) || sum_y < 1e-6) {
            throw InvalidArgument("spectral range (nm)", range_text,
                                  "must hold light of every RGB component; 380 to 770 does");
        }
    }
    for (SpectralBand& band : bands) {
        band.y /= sum_y;
        for (std::size_t c = 0; c < 3; ++c) {
            band.rgb[c] = relative[c] ? band.rgb[c] / sum[c] : band.y;
        }
    }
    return bands;
}

std::vector<SpectralBand> single_wavelength(double wavelength_nm) {
    if (!(wavelength_nm > 0 && std::isfinite(wavelength_nm))) {
        throw InvalidArgument("wavelength (nm)", std::to_string(wavelength_nm), "must be positive");
    }
    return {{wavelength_nm, {1, 1, 1}, 1}};
}

}  // namespace aureole::color
