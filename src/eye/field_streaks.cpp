#include "eye/field_streaks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/fourier/sizes.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/spectral_psf.h"
#include "eye/band_fade.h"
#include "eye/real_pair.h"

namespace aureole::eye {
namespace {

constexpr double kMostStreakShare = 0.5;
// Up to its reach the shortest wavelength must not have begun to fade (kStreaksFade).
constexpr double kUnfadedShare = 0.6;
constexpr double kShortestNm = 380;
// Distances that pixels of width p still see, in lambda / p.
constexpr double kCorrelation = 2;
constexpr double kMiddleNm = 555;
// Harmonics of the pupil's edge.
constexpr double kPupilMargin = 1.1;

}  // namespace

FieldStreaks::FieldStreaks(const Eye& eye, const wave::KernelGrid& grid,
                           const wave::ApertureGrid& raster, const SpectralSampling& sampling)
    : eye_(eye),
      grid_(grid),
      raster_(raster),
      levels_(spectral_levels(sampling, grid)),
      fft_(raster.samples, raster.samples),
      amplitude_(raster) {}

FieldStreaks::Blocked FieldStreaks::blocked(const FieldPosition& field) const {
    if (eye_.streaks == 0 || eye_.eyelashes == 0) return {wave::Mask({2, raster_.extent_mm}), 0};
    const wave::Mask pupil = draw_pupil(eye_, raster_, field);
    Blocked result{draw_lashes(eye_, raster_, field), 0};
    const auto n = static_cast<std::size_t>(raster_.samples);
    struct Sums {
        double open = 0, blocked = 0;
    };
    std::vector<Sums> rows(n);
    parallel_for(n, [&](std::size_t j, int) {
        const float* open = pupil.row(static_cast<int>(j));
        float* lashes = result.mask.row(static_cast<int>(j));
        float open_sum = 0;
        float blocked_sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            lashes[i] *= open[i];
            open_sum += open[i];
            blocked_sum += lashes[i];
        }
        rows[j] = {static_cast<double>(open_sum), static_cast<double>(blocked_sum)};
    });
    Sums total;
    for (const Sums& row : rows) {
        total.open += row.open;
        total.blocked += row.blocked;
    }
    result.share = total.open > 0 ? total.blocked / total.open : 0;
    return result;
}

Image FieldStreaks::onto_pixels(const wave::Field& amplitude, double share) const {
    // The value at frequency 0: any scale that keeps a float in its range would do.
    const double peak = std::pow(static_cast<double>(amplitude.re[0]), 2);
    const auto pattern =
        wave::PatternIntegral::from_transform(amplitude, streak_weights(raster_.samples, 1 / peak));
    Image kernel(grid_.width, grid_.height, 3);
    add_spectral(pattern, raster_.extent_mm, wave::PixelRule::kEnergy, levels_, grid_, kernel);
    const auto factor = static_cast<float>(share / pattern.total());
    std::for_each_n(kernel.plane(0), 3 * kernel.pixels(), [&](float& value) { value *= factor; });
    return kernel;
}

std::vector<FieldStreaks::Streaks> FieldStreaks::at(std::span<const FieldPosition> fields) {
    std::vector<Streaks> result;
    std::vector<Blocked> masks;
    for (const FieldPosition& field : fields) {
        masks.push_back(blocked(field));
        result.push_back({Image(grid_.width, grid_.height, 3),
                          std::min(masks.back().share * eye_.streaks, kMostStreakShare)});
    }
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if (result[i].share > 0) lit.push_back(i);
    }
    if (lit.empty()) return result;
    wave::Field pair({2, raster_.extent_mm});
    pair.grid = raster_;
    pair.re = std::move(masks[lit[0]].mask.values);
    pair.im = lit.size() > 1 ? std::move(masks[lit[1]].mask.values) : wave::Mask(raster_).values;
    wave::transform(pair, fft_);
    separate_amplitudes(pair);
    for (std::size_t i = 0; i < lit.size(); ++i) {
        std::swap(amplitude_.re, i == 0 ? pair.re : pair.im);
        result[lit[i]].kernel = onto_pixels(amplitude_, result[lit[i]].share);
    }
    return result;
}

wave::ApertureGrid streak_raster(const Eye& eye, const wave::KernelGrid& grid, double reach_deg,
                                 const wave::ApertureGrid& most) {
    const double pixel_rad = rad_from_deg(grid.pitch_deg);
    const double extent_mm =
        std::min(most.extent_mm, kPupilMargin * eye.pupil_diameter_mm +
                                     kCorrelation * mm_from_nm(kMiddleNm) / pixel_rad);
    // Half the band: sin / lambda cycles per mm.
    const double spacing_mm =
        std::max(most.spacing_mm(),
                 kUnfadedShare * mm_from_nm(kShortestNm) / (2 * std::sin(rad_from_deg(reach_deg))));
    int samples = std::max(64, static_cast<int>(std::ceil(extent_mm / spacing_mm)));
    while (samples % 2 != 0 || !fourier::is_smooth(samples)) ++samples;
    return {samples, samples * spacing_mm};
}

}  // namespace aureole::eye
