#include "eye/components.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/spectral_psf.h"
#include "eye/band_fade.h"
#include "eye/diffracted_share.h"
#include "eye/kernel_checks.h"
#include "eye/pupil_outline.h"
#include "eye/real_pair.h"
#include "eye/stopwatch.h"

namespace aureole::eye {
namespace {

// As kStreaksFade, of the others.
constexpr double kCoronaFade = 0.15;
constexpr double kHaloFade = 0.15;
// The halo without what the envelope of the fibres does near the axis: from nothing at the first
// angle to everything at the second, for the reference wavelength.
constexpr double kHaloFromDeg = 1.4;
constexpr double kHaloFullDeg = 2.0;
constexpr double kHaloReferenceNm = 568;

wave::KernelGrid reached_pixels(const wave::KernelGrid& grid, const wave::ApertureGrid& aperture,
                                double longest_nm) {
    const double sine = std::min(mm_from_nm(longest_nm) / (2 * aperture.spacing_mm()), 0.999);
    const double angle = std::asin(sine);
    const double rho_px = grid.view().focal_length_px() *
                          (grid.projection == Projection::kPerspective ? std::tan(angle) : angle);
    const double side = 2 * std::ceil(std::min(rho_px, 1e8)) + 1;
    wave::KernelGrid patch = grid;
    patch.width = static_cast<int>(std::min<double>(grid.width, side));
    patch.height = static_cast<int>(std::min<double>(grid.height, side));
    return patch;
}

void multiply(Image& image, double factor) {
    const auto f = static_cast<float>(factor);
    const std::size_t values = static_cast<std::size_t>(image.channels()) * image.pixels();
    std::for_each_n(image.plane(0), values, [&](float& value) { value *= f; });
}

// A field made of two real planes, without copying them.
wave::Field field_of(const wave::ApertureGrid& grid, Buffer re, Buffer im) {
    wave::Field field({2, grid.extent_mm});
    field.grid = grid;
    field.re = std::move(re);
    field.im = std::move(im);
    return field;
}

}  // namespace

Components::Components(const Eye& eye, const wave::KernelGrid& grid, const EyePsfOptions& options,
                       Progress* progress, EyePsfTimings* timings, const FieldPosition& field)
    : eye_(eye),
      options_(options),
      progress_(progress),
      timings_(timings),
      field_(field),
      stage_start_(seconds()),
      lights_(levels_of_lights(options.spectral, grid)),
      patch_(reached_pixels(grid, options.aperture, longest_wavelength_nm(lights_))),
      fft_(options.aperture.samples, options.aperture.samples) {
    finish_stage(&EyePsfTimings::transform, 0);
}

void Components::finish_stage(double EyePsfTimings::*stage, double fraction) {
    const double now = seconds();
    if (timings_ != nullptr) timings_->*stage += now - stage_start_;
    stage_start_ = now;
    if (progress_ == nullptr) return;
    // Components come in any order: what is done stays done.
    fraction_done_ = std::max(fraction_done_, fraction);
    progress_->report("eye psf", fraction_done_);
    if (progress_->cancelled()) throw Cancelled();
}

void Components::draw_pupil_once() {
    if (pupil_) return;
    pupil_ = draw_pupil(eye_, options_.aperture, field_);
    const int n = options_.aperture.samples;
    const auto dark = [&](int j) {
        const float* row = pupil_->row(j);
        return std::all_of(row, row + n, [](float value) { return value == 0; });
    };
    int first = 0;
    while (first < n && dark(first)) ++first;
    int end = n;
    while (end > first && dark(end - 1)) --end;
    first_lit_row_ = static_cast<std::size_t>(first);
    end_lit_row_ = static_cast<std::size_t>(end);
}

double Components::sum_lit_rows(const Buffer& plane) const {
    const auto count = static_cast<std::size_t>(options_.aperture.samples);
    std::vector<double> sums(lit_rows());
    parallel_for(sums.size(), [&](std::size_t row, int) {
        const float* values = plane.data() + (first_lit_row_ + row) * count;
        sums[row] = std::accumulate(values, values + count, 0.0);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

Image Components::onto_pixels(const wave::PatternIntegral& pattern, wave::PixelRule rule,
                              float initial) {
    Image out(patch_.width, patch_.height, channels());
    for (std::size_t light = 0; light < lights_.size(); ++light) {
        const int first = 3 * static_cast<int>(light);
        for (int c = 0; c < 3; ++c) {
            if (is_own_colour(first + c, channels())) {
                std::fill_n(out.plane(first + c), out.pixels(), initial);
            }
        }
        add_spectral(pattern, options_.aperture.extent_mm, rule, lights_[light], patch_,
                     out.view().channel_range(first, 3));
    }
    return out;
}

Image Components::bloom() {
    draw_pupil_once();
    wave::Field field = wave::field_from(*pupil_);
    finish_stage(&EyePsfTimings::draw, 0.2);
    const double energy = wave::transform(field, fft_);
    finish_stage(&EyePsfTimings::transform, 0.4);
    const auto pattern = wave::PatternIntegral::from_transform(field, 1 / energy);
    finish_stage(&EyePsfTimings::pattern, 0.6);
    Image out = onto_pixels(pattern, wave::PixelRule::kEnergy, 0);
    multiply(out, 1 / pattern.total());
    finish_stage(&EyePsfTimings::spectral, 0.9);
    return out;
}

std::optional<Image> Components::halo() {
    const int n = options_.aperture.samples;
    const auto count = static_cast<std::size_t>(n);
    if (!shows_fibres(eye_)) return std::nullopt;
    draw_pupil_once();
    wave::Field field = wave::field_from(*pupil_);
    multiply_gratings(eye_, field);
    // Without the mean over the pupil: it would be the pupil's own pattern once more.
    const double opening = sum_lit_rows(pupil_->values);
    const auto mean_re = static_cast<float>(sum_lit_rows(field.re) / opening);
    const auto mean_im = static_cast<float>(sum_lit_rows(field.im) / opening);
    parallel_for(lit_rows(), [&](std::size_t row, int) {
        const std::size_t j = first_lit_row_ + row;
        const float* open = pupil_->values.data() + j * count;
        float* re = field.re.data() + j * count;
        float* im = field.im.data() + j * count;
        for (std::size_t i = 0; i < count; ++i) {
            re[i] -= mean_re * open[i];
            im[i] -= mean_im * open[i];
        }
    });
    finish_stage(&EyePsfTimings::draw, 0.1);
    const double energy = wave::transform(field, fft_);
    finish_stage(&EyePsfTimings::transform, 0.2);
    // Half turns of a weak phase's pattern differ by its second order only, so little (the first
    // 4 % where both meet) that the mean of both serves, at half the work per pixel.
    separate_amplitudes(field);
    wave::RingWeights weights;
    weights.scale.resize(count / 2);
    for (std::size_t ring = 0; ring < weights.scale.size(); ++ring) {
        const double angle_deg = deg_from_rad(
            std::asin(std::min(1.0, static_cast<double>(ring) * mm_from_nm(kHaloReferenceNm) /
                                        options_.aperture.extent_mm)));
        weights.scale[ring] = static_cast<float>(smoothstep(kHaloFromDeg, kHaloFullDeg, angle_deg) *
                                                 band_fade(ring, n, kHaloFade) / energy);
    }
    const auto pattern = wave::PatternIntegral::from_transform(field, weights);
    finish_stage(&EyePsfTimings::pattern, 0.3);
    const double total = pattern.total();
    if (!(total > 1e-9)) return std::nullopt;
    Image out = onto_pixels(pattern, wave::PixelRule::kEnergy, 0);
    multiply(out, 1 / total);
    finish_stage(&EyePsfTimings::spectral, 0.4);
    return out;
}

Components::CoronaAndStreaks Components::corona_and_streaks(bool with_corona, bool with_streaks) {
    CoronaAndStreaks result;
    const int n = options_.aperture.samples;
    const auto count = static_cast<std::size_t>(n);

    wave::Mask particles(options_.aperture);
    if (with_corona) {
        add_particles(eye_, ParticleLayer::kLens, particles, field_);
        add_particles(eye_, ParticleLayer::kVitreous, particles, field_);
        add_particles(eye_, ParticleLayer::kCornea, particles, field_);
    }
    wave::Mask lashes =
        with_streaks ? draw_lashes(eye_, options_.aperture, field_) : wave::Mask(options_.aperture);

    // Behind particles that delay light by phi the amplitude is P Q with Q - 1 = (e^(i phi) - 1) C,
    // C their coverage (overlaps add; they cover 3 %). Its pattern relative to its own ring means
    // does not depend on phi, so C itself is transformed, and is real.
    draw_pupil_once();
    struct Sums {
        double open = 0, covered = 0, blocked = 0;
    };
    std::vector<Sums> rows(count);
    parallel_for(count, [&](std::size_t j, int) {
        float* c = particles.values.data() + j * count;
        float* l = lashes.values.data() + j * count;
        if (j < first_lit_row_ || j >= end_lit_row_) {
            std::fill_n(c, count, 0.0F);
            std::fill_n(l, count, 0.0F);
            return;
        }
        const float* open = pupil_->values.data() + j * count;
        Sums& sums = rows[j];
        for (std::size_t i = 0; i < count; ++i) {
            c[i] *= open[i];
            l[i] *= open[i];
            sums.open += static_cast<double>(open[i]);
            sums.covered += static_cast<double>(c[i]);
            sums.blocked += static_cast<double>(l[i]);
        }
    });
    Sums total;
    for (const Sums& row : rows) {
        total.open += row.open;
        total.covered += row.covered;
        total.blocked += row.blocked;
    }
    if (!(total.open > 0)) return result;
    result.blocked_share = total.blocked / total.open;
    with_corona = total.covered > 0;
    with_streaks = total.blocked > 0;
    if (!with_corona && !with_streaks) return result;
    const auto mean = static_cast<float>(total.covered / total.open);
    parallel_for(lit_rows(), [&](std::size_t row, int) {
        const std::size_t j = first_lit_row_ + row;
        const float* open = pupil_->values.data() + j * count;
        float* c = particles.values.data() + j * count;
        for (std::size_t i = 0; i < count; ++i) c[i] -= mean * open[i];
    });
    wave::Field field =
        field_of(options_.aperture, std::move(particles.values), std::move(lashes.values));
    pupil_.reset();
    finish_stage(&EyePsfTimings::draw, 0.5);
    wave::transform(field, fft_);
    finish_stage(&EyePsfTimings::transform, 0.6);
    separate_amplitudes(field);
    Buffer streak_amplitude = std::move(field.im);
    field.im = wave::Mask(options_.aperture).values;  // zeros

    if (with_corona) {
        const std::vector<double> means = wave::ring_means(field);
        wave::RingWeights weights;
        weights.scale.resize(count / 2);
        weights.offset.resize(count / 2);
        for (std::size_t ring = 0; ring < weights.scale.size(); ++ring) {
            const double fade = means[ring] > 0 ? band_fade(ring, n, kCoronaFade) : 0.0;
            weights.scale[ring] = means[ring] > 0 ? static_cast<float>(fade / means[ring]) : 0.0F;
            weights.offset[ring] = static_cast<float>(-fade);
        }
        const auto pattern = wave::PatternIntegral::from_transform(field, weights);
        finish_stage(&EyePsfTimings::pattern, 0.65);
        result.corona = onto_pixels(pattern, wave::PixelRule::kMean, 1);
        finish_stage(&EyePsfTimings::spectral, 0.8);
    }
    if (with_streaks) {
        field.re = std::move(streak_amplitude);
        // The value at frequency 0: any scale that keeps a float in its range would do.
        const double peak = std::pow(static_cast<double>(field.re[0]), 2);
        const auto pattern =
            wave::PatternIntegral::from_transform(field, streak_weights(n, 1 / peak));
        finish_stage(&EyePsfTimings::pattern, 0.85);
        result.streaks = onto_pixels(pattern, wave::PixelRule::kEnergy, 0);
        multiply(*result.streaks, 1 / pattern.total());
        finish_stage(&EyePsfTimings::spectral, 0.95);
    }
    return result;
}

}  // namespace aureole::eye
