#include "aureole/eye/joint_psf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/fft.h"
#include "aureole/fourier/sizes.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/spectral_psf.h"
#include "eye/kernel_checks.h"
#include "eye/spectral_levels.h"

namespace aureole::eye {
namespace {

constexpr int kDefaultWavelengths = 32;

void check(const JointPsfOptions& options) {
    check_aperture(options.aperture);
    const auto require = [](const char* what, double value, double low, double high,
                            const char* unit) {
        if (value >= low && value <= high) return;
        throw InvalidArgument(what, fmt::format("{}", value),
                              fmt::format("must be {} to {} {}", low, high, unit));
    };
    require("defocus", options.defocus_dioptres, -20, 20, "dioptres");
    require("retina distance", options.retina_distance_mm, 1, 1000, "mm");
    require("particle phase", options.particle_phase_rad, -10, 10, "rad");
}

double dioptres(const JointPsfOptions& options, double wavelength_nm) {
    if (options.propagation == Propagation::kFresnel) return 1000 / options.retina_distance_mm;
    return options.defocus_dioptres +
           (options.chromatic_aberration ? wave::chromatic_defocus_dioptres(wavelength_nm) : 0);
}

// Adds a pattern, scaled to unit energy, for the given levels.
void add_pattern(const wave::PatternIntegral& pattern, double extent_mm,
                 std::vector<SpectralLevel> levels, wave::Psf& psf) {
    for (auto& level : levels) {
        for (auto& band : level.bands) {
            for (double& weight : band.rgb) weight /= pattern.total();
        }
        wave::add_spectral(pattern, extent_mm, wave::PixelRule::kEnergy, level.bands, psf.grid,
                           level.range, psf.kernel);
    }
}

void copy_into(const wave::Field& from, wave::Field& to) {
    const auto n = static_cast<std::size_t>(from.grid.samples);
    parallel_for(n, [&](std::size_t j, int) {
        std::copy_n(from.re.data() + j * n, n, to.re.data() + j * n);
        std::copy_n(from.im.data() + j * n, n, to.im.data() + j * n);
    });
    to.box_filtered = from.box_filtered;
}

}  // namespace

wave::Field draw_joint_aperture(const Eye& eye, const JointPsfOptions& options) {
    check(eye);
    check(options);
    wave::Mask amplitude = draw_pupil(eye, options.aperture);
    const auto n = static_cast<std::size_t>(options.aperture.samples);
    if (eye.eyelashes > 0) {
        const wave::Mask blocked = draw_lashes(eye, options.aperture);
        parallel_for(n, [&](std::size_t j, int) {
            float* open = amplitude.row(static_cast<int>(j));
            const float* lash = blocked.row(static_cast<int>(j));
            for (std::size_t i = 0; i < n; ++i) open[i] *= 1 - lash[i];
        });
    }
    wave::Field field = wave::field_from(amplitude);
    multiply_gratings(eye, field);
    wave::Mask& particles = amplitude;
    std::fill_n(particles.values.data(), particles.values.size(), 0.0F);
    add_particles(eye, ParticleLayer::kLens, particles);
    add_particles(eye, ParticleLayer::kVitreous, particles);
    add_particles(eye, ParticleLayer::kCornea, particles);
    const bool opaque = options.particles == ParticleOptics::kOpaque;
    const auto phase = static_cast<float>(options.particle_phase_rad);
    parallel_for(n, [&](std::size_t j, int) {
        const float* coverage = particles.row(static_cast<int>(j));
        float* re = field.re.data() + j * n;
        float* im = field.im.data() + j * n;
        for (std::size_t i = 0; i < n; ++i) {
            if (coverage[i] == 0) continue;
            // c layers: all light through whole ones, a share of it through the last.
            const float whole = std::floor(coverage[i]);
            const float share = coverage[i] - whole;
            float q_re = 0;
            float q_im = 0;
            if (opaque) {
                q_re = whole > 0 ? 0 : 1 - share;
            } else {
                q_re =
                    (1 - share) * std::cos(whole * phase) + share * std::cos((whole + 1) * phase);
                q_im =
                    (1 - share) * std::sin(whole * phase) + share * std::sin((whole + 1) * phase);
            }
            const float a = re[i];
            const float b = im[i];
            re[i] = a * q_re - b * q_im;
            im[i] = a * q_im + b * q_re;
        }
    });
    return field;
}

wave::Psf joint_psf(const Eye& eye, const wave::KernelGrid& grid, const JointPsfOptions& options,
                    Progress* progress) {
    check_kernel(grid);
    wave::Field field = draw_joint_aperture(eye, options);
    fourier::Fft2d fft(options.aperture.samples, options.aperture.samples);
    wave::Psf psf;
    psf.grid = grid;
    psf.kernel = Image(grid.width, grid.height, 3);

    const auto advance = [&](double fraction) {
        if (progress == nullptr) return;
        progress->report("eye psf", fraction);
        if (progress->cancelled()) throw Cancelled();
    };
    advance(0);
    if (options.propagation == Propagation::kFraunhofer) {
        const double energy = wave::transform(field, fft);
        add_pattern(wave::PatternIntegral::from_transform(field, 1 / energy),
                    options.aperture.extent_mm, spectral_levels(options.spectral, grid), psf);
    } else {
        SpectralSampling sampling = options.spectral;
        if (sampling.bands == 0) sampling.bands = kDefaultWavelengths;
        const auto bands = spectral_levels(sampling, grid).front().bands;
        wave::Field work(options.aperture);
        for (std::size_t b = 0; b < bands.size(); ++b) {
            copy_into(field, work);
            wave::add_defocus(work, dioptres(options, bands[b].wavelength_nm),
                              bands[b].wavelength_nm);
            const double energy = wave::transform(work, fft);
            add_pattern(wave::PatternIntegral::from_transform(work, 1 / energy),
                        options.aperture.extent_mm, {{{}, {bands[b]}}}, psf);
            advance(static_cast<double>(b + 1) / static_cast<double>(bands.size()));
        }
    }
    psf.off_kernel_energy = energy_outside(psf.kernel);
    advance(1);
    return psf;
}

std::string propagation_resolution_note(const Eye& eye, const JointPsfOptions& options) {
    check(eye);
    check(options);
    if (options.propagation == Propagation::kFraunhofer) return {};
    double spacing_mm = options.aperture.spacing_mm();
    const color::SpectralRange visible;
    for (const double wavelength_nm : {visible.low_nm, visible.high_nm}) {
        const double defocus = dioptres(options, wavelength_nm);
        if (defocus == 0) continue;
        spacing_mm = std::min(spacing_mm, wave::max_spacing_for_defocus_mm(
                                              defocus, pupil_axes(eye).long_mm / 2, wavelength_nm));
    }
    if (spacing_mm >= options.aperture.spacing_mm()) return {};
    int samples =
        fourier::next_smooth(static_cast<int>(std::ceil(options.aperture.extent_mm / spacing_mm)));
    while (samples % 2 != 0) samples = fourier::next_smooth(samples + 1);
    return fmt::format(
        "{} samples do not resolve the quadratic phase at the edge of a {} mm pupil: {} would",
        options.aperture.samples, eye.pupil_diameter_mm, samples);
}

}  // namespace aureole::eye
