#include "aureole/color/primary_spectra.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "aureole/color/illuminant.h"

namespace aureole::color {
namespace {

constexpr struct {
    double red;
    double blue;
} kShares[] = {
#include "color/primary_spectra.inc"
};
constexpr double kFirstNm = 380;
constexpr double kStepNm = 5;

// As sample_spectrum() integrates.
constexpr double kIntegrationStepNm = 1;

std::array<Rgb, 3> integrate_primaries(double low_nm, double high_nm) {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((high_nm - low_nm) / kIntegrationStepNm)));
    const double step_nm = (high_nm - low_nm) / steps;
    std::array<Xyz, 3> sum{};
    for (int i = 0; i < steps; ++i) {
        const double wavelength_nm = low_nm + (i + 0.5) * step_nm;
        const double power = relative_power(Illuminant::kD65, wavelength_nm) * step_nm;
        const Xyz observer = cie_1931_observer(wavelength_nm);
        const Rgb share = primary_shares(wavelength_nm);
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t c = 0; c < 3; ++c) sum[j][c] += share[j] * power * observer[c];
        }
    }
    return {rgb_from_xyz(sum[0]), rgb_from_xyz(sum[1]), rgb_from_xyz(sum[2])};
}

}  // namespace

Rgb primary_shares(double wavelength_nm) {
    const auto last = static_cast<double>(std::size(kShares) - 1);
    const double position = std::clamp((wavelength_nm - kFirstNm) / kStepNm, 0.0, last);
    const auto node = static_cast<std::size_t>(std::min(position, last - 1));
    const double t = position - static_cast<double>(node);
    const double red = (1 - t) * kShares[node].red + t * kShares[node + 1].red;
    const double blue = (1 - t) * kShares[node].blue + t * kShares[node + 1].blue;
    return {red, 1 - red - blue, blue};
}

std::vector<PrimaryBand> sample_primaries(int count, WavelengthSpacing spacing) {
    // For its wavelengths and its errors.
    const std::vector<SpectralBand> white = sample_spectrum(count, spacing, Illuminant::kD65);
    const SpectralRange visible;
    const bool logarithmic = spacing == WavelengthSpacing::kLogarithmic;
    const double width = logarithmic ? std::pow(visible.high_nm / visible.low_nm, 1.0 / count)
                                     : (visible.high_nm - visible.low_nm) / count;
    std::vector<PrimaryBand> bands;
    double low_nm = visible.low_nm;
    Rgb whole{};
    for (const SpectralBand& band : white) {
        const double high_nm = logarithmic ? low_nm * width : low_nm + width;
        bands.push_back({band.wavelength_nm, integrate_primaries(low_nm, high_nm)});
        low_nm = high_nm;
        for (const Rgb& light : bands.back().primary) {
            for (std::size_t c = 0; c < 3; ++c) whole[c] += light[c];
        }
    }
    for (PrimaryBand& band : bands) {
        for (Rgb& light : band.primary) {
            for (std::size_t c = 0; c < 3; ++c) light[c] /= whole[c];
        }
    }
    return bands;
}

}  // namespace aureole::color
