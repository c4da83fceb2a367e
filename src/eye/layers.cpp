// Drawing the layers of an eye, each from its own random stream.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/radial_grating.h"

namespace aureole::eye {
namespace {

enum Stream : std::uint64_t {
    kPupilStream = 1,
    kLensSmallStream,
    kLensLargeStream,
    kVitreousStream,
    kCorneaStream,
    kGratingStream,
    kLashStream,
};

// Lowest and highest harmonic of the pupil's edge; order 1 would be a shift.
constexpr int kFirstEdgeHarmonic = 2;
constexpr int kLastEdgeHarmonic = 8;

// Fibres wander: their displacement is noise whose amplitude falls as 1 / order round the lens, so
// that neighbours stay nearly parallel.
constexpr int kJitterHarmonics = 400;
constexpr int kJitterNodes = 8192;

void add_disc_of_particles(const Eye& eye, const Particles& particles, Stream stream,
                           wave::Mask& coverage) {
    Random random(eye.seed, stream);
    std::vector<wave::Particle> discs(static_cast<std::size_t>(particles.count));
    for (auto& disc : discs) {
        const double distance = eye.anatomy.particle_disc_radius_mm * std::sqrt(random.uniform());
        const double direction = random.uniform(0, 2 * kPi);
        disc.x_mm = distance * std::cos(direction);
        disc.y_mm = distance * std::sin(direction);
        disc.radius_mm =
            mm_from_um(random.log_uniform(particles.min_radius_um, particles.max_radius_um));
    }
    wave::draw_particles(coverage, discs);
}

// Displacement of the fibres over one turn, in radians of the fibres' own phase.
std::vector<float> fibre_jitter(const Eye& eye) {
    if (eye.anatomy.gratings.jitter_fibres == 0) return {};
    Random random(eye.seed, kGratingStream);
    std::vector<double> sum(kJitterNodes);
    for (int order = 1; order < kJitterHarmonics; ++order) {
        const double cosine = random.normal() / order;
        const double sine = random.normal() / order;
        const std::complex<double> turn = std::polar(1.0, 2 * kPi * order / kJitterNodes);
        std::complex<double> phasor(cosine, sine);
        for (auto& value : sum) {
            value += phasor.real();
            phasor *= turn;
        }
    }
    double square = 0;
    for (const double value : sum) square += value * value;
    const double scale =
        2 * kPi * eye.anatomy.gratings.jitter_fibres / std::sqrt(square / kJitterNodes);
    std::vector<float> jitter(kJitterNodes);
    std::transform(sum.begin(), sum.end(), jitter.begin(),
                   [&](double value) { return static_cast<float>(value * scale); });
    return jitter;
}

// How far the upper lid has come down, and the lower one up, from the open eye, mm.
double lid_descent_mm(const Eye& eye) {
    return (1 - eye.anatomy.lower_lid_share) * eye.eyelid * eye.pupil_diameter_mm;
}
double lid_rise_mm(const Eye& eye) {
    return eye.anatomy.lower_lid_share * eye.eyelid * eye.pupil_diameter_mm;
}

}  // namespace

wave::Mask draw_pupil(const Eye& eye, const wave::ApertureGrid& grid) {
    check(eye);
    Random random(eye.seed, kPupilStream);
    std::vector<wave::RadiusHarmonic> harmonics;
    for (int order = kFirstEdgeHarmonic; order <= kLastEdgeHarmonic; ++order) {
        const double amplitude = eye.anatomy.pupil_irregularity * random.normal() / order;
        harmonics.push_back({order, amplitude, random.uniform(0, 2 * kPi)});
    }
    const double radius_mm = eye.pupil_diameter_mm / 2;
    wave::Mask pupil(grid);
    wave::draw(pupil, wave::irregular_disc(radius_mm, harmonics));
    if (eye.eyelid > 0) {
        wave::draw(pupil, wave::lid_opening(wave::LidSide::kUpper, radius_mm - lid_descent_mm(eye)),
                   wave::Blend::kKeep);
        wave::draw(pupil, wave::lid_opening(wave::LidSide::kLower, lid_rise_mm(eye) - radius_mm),
                   wave::Blend::kKeep);
        if (!(wave::area_mm2(pupil) > 0)) {
            throw InvalidArgument("eyelid", fmt::format("{}", eye.eyelid),
                                  "leaves no opening; must be smaller");
        }
    }
    return pupil;
}

void add_particles(const Eye& eye, ParticleLayer layer, wave::Mask& coverage) {
    check(eye);
    switch (layer) {
        case ParticleLayer::kLens:
            add_disc_of_particles(eye, eye.anatomy.lens_small, kLensSmallStream, coverage);
            add_disc_of_particles(eye, eye.anatomy.lens_large, kLensLargeStream, coverage);
            break;
        case ParticleLayer::kVitreous:
            add_disc_of_particles(eye, eye.anatomy.vitreous, kVitreousStream, coverage);
            break;
        case ParticleLayer::kCornea:
            add_disc_of_particles(eye, eye.anatomy.cornea, kCorneaStream, coverage);
            break;
    }
}

void multiply_gratings(const Eye& eye, wave::Field& field) {
    check(eye);
    const Gratings& gratings = eye.anatomy.gratings;
    wave::RadialGrating grating;
    grating.fibres = gratings.fibres;
    grating.phase_rad = gratings.phase_rad;
    grating.inner_radius_mm = gratings.inner_radius_mm;
    grating.full_radius_mm = gratings.full_radius_mm;
    grating.jitter_rad = fibre_jitter(eye);
    wave::multiply_radial_grating(field, grating);
}

std::string grating_resolution_note(const Eye& eye, const wave::ApertureGrid& grid) {
    const Gratings& gratings = eye.anatomy.gratings;
    const double smallest_period_mm = 2 * grid.spacing_mm();
    const double resolved_from_mm = smallest_period_mm * gratings.fibres / (2 * kPi);
    if (resolved_from_mm <= gratings.inner_radius_mm) return {};
    return fmt::format(
        "{} lens fibres are finer than two samples of the {} x {} raster within {:.2f} mm of the "
        "axis: that part of the halo, outside {:.2f} deg at 568 nm, is missing",
        gratings.fibres, grid.samples, grid.samples, resolved_from_mm,
        deg_from_rad(std::asin(mm_from_nm(568) / smallest_period_mm)));
}

wave::Mask draw_lashes(const Eye& eye, const wave::ApertureGrid& grid) {
    check(eye);
    const Lashes& lashes = eye.anatomy.lashes;
    const double radius_mm = eye.pupil_diameter_mm / 2;
    Random random(eye.seed, kLashStream);
    wave::Mask blocked(grid);
    for (int i = 0; i < eye.eyelashes; ++i) {
        // Evenly spaced across 85 % of the pupil, then displaced.
        const double across = 0.85 * (2 * (i + 0.5) / eye.eyelashes - 1) + 0.12 * random.normal();
        const double reach =
            std::clamp(lashes.reach + lashes.reach_sd * random.normal(), 0.05, 1.2);
        wave::Lash lash;
        lash.tip = {across * radius_mm,
                    radius_mm - reach * eye.pupil_diameter_mm - lid_descent_mm(eye)};
        lash.direction_deg = 90 - lashes.angle_sd_deg * random.normal();
        lash.width_mm = mm_from_um(lashes.width_um) * random.uniform(0.75, 1.25);
        lash.curvature_per_mm = lashes.curvature_per_mm * random.normal();
        wave::draw(blocked, wave::lash(lash), wave::Blend::kMax);
    }
    return blocked;
}

}  // namespace aureole::eye
