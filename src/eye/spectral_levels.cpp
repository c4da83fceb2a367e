#include "eye/spectral_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/color/primary_spectra.h"
#include "aureole/color/rgb.h"

namespace aureole::eye {
namespace {

constexpr int kFewestBands = 32;
constexpr int kMostBands = 256;
// Largest step from band to band, in pixels, before the count doubles. The texture is exact to a
// tenth of its contrast with .3; where 128 bands no longer do that, the eye only asks that rays
// do not fall apart into dots.
constexpr int kExactBands = 128;
constexpr double kExactStepPx = 0.3;
constexpr double kContinuousStepPx = 1.45;

double angle_deg(const wave::KernelGrid& grid, double rho_px) {
    const double ratio = rho_px / grid.view().focal_length_px();
    return deg_from_rad(grid.projection == Projection::kPerspective ? std::atan(ratio) : ratio);
}

void add_level(const SpectralSampling& sampling, int bands, color::WavelengthSpacing spacing,
               const wave::AngleRange& range, std::vector<std::vector<SpectralLevel>>& lights) {
    if (!sampling.by_color) {
        lights[0].push_back({range, color::sample_spectrum(bands, spacing, sampling.illuminant)});
        return;
    }
    for (auto& light : lights) light.push_back({range, {}});
    for (const color::PrimaryBand& band : color::sample_primaries(bands, spacing)) {
        for (std::size_t j = 0; j < 3; ++j) {
            const color::Rgb& rgb = band.primary[j];
            if (rgb == color::Rgb{}) continue;
            lights[j].back().bands.push_back({band.wavelength_nm, rgb, color::luminance(rgb)});
        }
    }
}

}  // namespace

std::vector<SpectralLevel> spectral_levels(const SpectralSampling& sampling,
                                           const wave::KernelGrid& grid) {
    if (sampling.by_color) {
        throw InvalidArgument("spectrum by colour", "on", "must be off for this kernel");
    }
    return std::move(levels_of_lights(sampling, grid).front());
}

std::vector<std::vector<SpectralLevel>> levels_of_lights(const SpectralSampling& sampling,
                                                         const wave::KernelGrid& grid) {
    const color::SpectralRange visible;
    if (sampling.single_wavelength_nm != 0) {
        const double wavelength_nm = sampling.single_wavelength_nm;
        if (!(wavelength_nm >= visible.low_nm && wavelength_nm <= visible.high_nm)) {
            throw InvalidArgument("wavelength", fmt::format("{}", wavelength_nm),
                                  "must be 380 to 770 nm, or 0 for the whole spectrum");
        }
        return {{{{}, color::single_wavelength(wavelength_nm)}}};
    }
    if (sampling.bands < 0 || sampling.bands > 4096) {
        throw InvalidArgument("wavelengths", fmt::format("{}", sampling.bands),
                              "must be 1 to 4096, or 0 for automatic");
    }
    if (sampling.by_color && sampling.illuminant != color::Illuminant::kD65) {
        throw InvalidArgument("illuminant", std::string(color::name_of(sampling.illuminant)),
                              "must be d65 with spectra by colour");
    }
    std::vector<std::vector<SpectralLevel>> lights(sampling.by_color ? 3 : 1);
    if (sampling.bands > 0) {
        add_level(sampling, sampling.bands, sampling.spacing, {}, lights);
        return lights;
    }
    const double log_range = std::log(visible.high_nm / visible.low_nm);
    const double farthest_px = 0.5 * std::hypot(grid.width, grid.height);
    double from_deg = 0;
    for (int bands = kFewestBands;; bands *= 2) {
        const double step_px = bands < kExactBands ? kExactStepPx : kContinuousStepPx;
        const double to_px = step_px * bands / log_range;
        const bool last = bands == kMostBands || to_px >= farthest_px;
        const double to_deg = last ? wave::AngleRange{}.max_deg : angle_deg(grid, to_px);
        add_level(sampling, bands, color::WavelengthSpacing::kLogarithmic, {from_deg, to_deg},
                  lights);
        if (last) return lights;
        from_deg = to_deg;
    }
}

void add_spectral(const wave::PatternIntegral& pattern, double extent_mm, wave::PixelRule rule,
                  const std::vector<SpectralLevel>& levels, const wave::KernelGrid& grid,
                  const ImageView& out) {
    for (const auto& level : levels) {
        wave::add_spectral(pattern, extent_mm, rule, level.bands, grid, level.range, out,
                           wave::Symmetry::kHalfTurn);
    }
}

double longest_wavelength_nm(const std::vector<std::vector<SpectralLevel>>& lights) {
    double longest = 0;
    for (const auto& levels : lights) {
        for (const auto& level : levels) {
            for (const auto& band : level.bands) longest = std::max(longest, band.wavelength_nm);
        }
    }
    return longest;
}

}  // namespace aureole::eye
