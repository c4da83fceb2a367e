// Drawing the pupil and what floats in an eye, each layer from its own random stream.
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
#include "eye/before_pupil.h"

namespace aureole::eye {
namespace {

// Lowest harmonic of the pupil's edge; order 1 would be a shift.
constexpr int kFirstEdgeHarmonic = 2;

// Fibres wander: their displacement is noise whose amplitude falls as 1 / order round the lens, so
// that neighbours stay nearly parallel.
constexpr int kJitterHarmonics = 400;
constexpr int kJitterNodes = 8192;

// Calls move(disc, index) for each particle before it is drawn.
template <class Move>
void add_disc_of_particles(const Eye& eye, const Particles& particles, Stream stream,
                           wave::Mask& coverage, const Move& move) {
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
    for (std::size_t i = 0; i < discs.size(); ++i) move(discs[i], i);
    wave::draw_particles(coverage, discs);
}

// The vitreous as one rigid body. Seen from the retina, a particle at depth z behind the pupil lies
// before the point of the pupil L / (L - z) times as far from the axis, L the distance to the
// retina; and a turn about the centre of the eye moves it sideways by its distance from there.
class VitreousMotion {
  public:
    explicit VitreousMotion(const Eye& eye)
        : radius_mm_(eye.anatomy.particle_disc_radius_mm),
          yaw_rad_(rad_from_deg(eye.pose.vitreous_yaw_deg)),
          pitch_rad_(rad_from_deg(eye.pose.vitreous_pitch_deg)),
          cosine_(std::cos(rad_from_deg(eye.pose.vitreous_roll_deg))),
          sine_(std::sin(rad_from_deg(eye.pose.vitreous_roll_deg))),
          at_rest_(yaw_rad_ == 0 && pitch_rad_ == 0 && eye.pose.vitreous_roll_deg == 0) {}

    void operator()(wave::Particle& disc, std::size_t index) const {
        if (at_rest_) return;
        const double depth_mm = kVitreousDepthsMm[index % kVitreousDepthsMm.size()];
        const double mm_per_rad =
            (kRotationCentreMm - depth_mm) * kRetinaMm / (kRetinaMm - depth_mm);
        const double x_mm = cosine_ * disc.x_mm - sine_ * disc.y_mm;
        const double y_mm = sine_ * disc.x_mm + cosine_ * disc.y_mm;
        const double shift_x_mm = mm_per_rad * yaw_rad_;
        const double shift_y_mm = mm_per_rad * pitch_rad_;
        const double shift_mm = std::hypot(shift_x_mm, shift_y_mm);
        disc.x_mm = x_mm;
        disc.y_mm = y_mm;
        if (shift_mm == 0) return;
        // There is more vitreous than the disc that is drawn: who leaves it enters again at the
        // other end of the chord, which keeps the density uniform.
        const double ux = shift_x_mm / shift_mm;
        const double uy = shift_y_mm / shift_mm;
        const double along_mm = ux * x_mm + uy * y_mm;
        const double across_mm = ux * y_mm - uy * x_mm;
        const double half_chord_mm =
            std::sqrt(std::max(radius_mm_ * radius_mm_ - across_mm * across_mm, 1e-12));
        const double turns = (along_mm + shift_mm + half_chord_mm) / (2 * half_chord_mm);
        const double moved_mm = along_mm + shift_mm - 2 * half_chord_mm * std::floor(turns);
        disc.x_mm = moved_mm * ux - across_mm * uy;
        disc.y_mm = moved_mm * uy + across_mm * ux;
    }

  private:
    // Distances behind the entrance pupil of an eye 24 mm long (Gullstrand's: pupil 3.05 mm behind
    // the cornea, centre of rotation 13.5 mm). Depths in the front half of the vitreous: what is
    // farther back throws shadows (floaters) instead of wide diffraction.
    static constexpr double kRotationCentreMm = 10.4;
    static constexpr double kRetinaMm = 21;
    static constexpr std::array<double, 2> kVitreousDepthsMm = {4, 8};

    double radius_mm_;
    double yaw_rad_;
    double pitch_rad_;
    double cosine_;
    double sine_;
    bool at_rest_;
};

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

}  // namespace

wave::Mask draw_pupil(const Eye& eye, const wave::ApertureGrid& grid, const FieldPosition& field) {
    check(eye);
    const Oblique view = oblique(eye, field);
    Random random(eye.seed, kPupilStream);
    std::vector<wave::RadiusHarmonic> harmonics;
    for (int order = kFirstEdgeHarmonic; order <= kLastEdgeHarmonic; ++order) {
        const double amplitude = eye.anatomy.pupil_irregularity * random.normal() / order;
        harmonics.push_back({order, amplitude, random.uniform(0, 2 * kPi)});
    }
    const PupilOutline outline(eye);
    wave::Mask pupil(grid);
    wave::draw(pupil,
               seen(outline.round() ? wave::irregular_disc(outline.longest_radius_mm(), harmonics)
                                    : wave::with_harmonics(outline.shape(), harmonics),
                    Layer::kPupil, view));
    if (eye.eyelid > 0) {
        const auto keep = [&](wave::LidSide side, double edge_y_mm) {
            wave::draw(pupil, seen(wave::lid_opening(side, edge_y_mm), Layer::kBeforePupil, view),
                       wave::Blend::kKeep);
        };
        const Lids lids(eye, outline, eye.eyelid);
        keep(wave::LidSide::kUpper, lids.upper_mm);
        keep(wave::LidSide::kLower, lids.lower_mm);
        if (view.shortening == 0 && !(wave::area_mm2(pupil) > 0)) {
            throw InvalidArgument("eyelid", fmt::format("{}", eye.eyelid),
                                  "leaves no opening; must be smaller");
        }
    }
    return pupil;
}

void add_particles(const Eye& eye, ParticleLayer layer, wave::Mask& coverage) {
    check(eye);
    const auto with_lens = [scale = eye.pose.lens_scale](wave::Particle& disc, std::size_t) {
        disc.x_mm *= scale;
        disc.y_mm *= scale;
    };
    const auto stay = [](wave::Particle&, std::size_t) {};
    switch (layer) {
        case ParticleLayer::kLens:
            add_disc_of_particles(eye, eye.anatomy.lens_small, kLensSmallStream, coverage,
                                  with_lens);
            add_disc_of_particles(eye, eye.anatomy.lens_large, kLensLargeStream, coverage,
                                  with_lens);
            break;
        case ParticleLayer::kVitreous:
            add_disc_of_particles(eye, eye.anatomy.vitreous, kVitreousStream, coverage,
                                  VitreousMotion(eye));
            break;
        case ParticleLayer::kCornea:
            add_disc_of_particles(eye, eye.anatomy.cornea, kCorneaStream, coverage, stay);
            break;
    }
}

void multiply_gratings(const Eye& eye, wave::Field& field) {
    check(eye);
    const Gratings& gratings = eye.anatomy.gratings;
    wave::RadialGrating grating;
    grating.fibres = gratings.fibres;
    grating.phase_rad = gratings.phase_rad;
    grating.inner_radius_mm = gratings.inner_radius_mm * eye.pose.lens_scale;
    grating.full_radius_mm = gratings.full_radius_mm * eye.pose.lens_scale;
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

}  // namespace aureole::eye
