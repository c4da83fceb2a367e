// Drawing what floats in cornea, lens and vitreous, each layer from its own random stream.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"
#include "eye/before_pupil.h"

namespace aureole::eye {
namespace {

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

// Distances behind the entrance pupil of an eye 24 mm long (Gullstrand's: pupil 3.05 mm behind the
// cornea, centre of rotation 13.5 mm).
constexpr double kCorneaMm = -3.05;
constexpr double kLensMm = 3.6;  // its thickness; the iris lies on its front
constexpr double kRotationCentreMm = 10.4;
constexpr double kRetinaMm = 21;
// In the front half of the vitreous: what is farther back throws shadows (floaters) instead of wide
// diffraction.
constexpr std::array<double, 2> kVitreousDepthsMm = {4, 8};
// Angle of the ray through the middle of the pupil, inside over outside: n y / n' y' of the pupils
// (Lagrange), 1 / (1.336 * .912); those of Gullstrand's eye are 1.13 and 1.03 times the iris.
constexpr double kInsideOverOutside = 0.82;
constexpr double kGoldenFraction = 0.618034;

double depth_mm(ParticleLayer layer, std::size_t index) {
    switch (layer) {
        case ParticleLayer::kCornea:
            return kCorneaMm;
        case ParticleLayer::kVitreous:
            return kVitreousDepthsMm[index % kVitreousDepthsMm.size()];
        case ParticleLayer::kLens:
            break;
    }
    const double turns = kGoldenFraction * (static_cast<double>(index) + 0.5);
    return kLensMm * (turns - std::floor(turns));  // evenly through it
}

// Seen from the retina, a particle at depth z behind the pupil lies before the point of the pupil
// L / (L - z) times as far from the axis, L the distance to the retina.
double seen_in_pupil(double depth_mm) { return kRetinaMm / (kRetinaMm - depth_mm); }

// Moves a particle; who leaves the disc enters again at the other end of the chord, which keeps the
// density uniform.
void carry(wave::Particle& disc, double shift_x_mm, double shift_y_mm, double disc_radius_mm) {
    const double shift_mm = std::hypot(shift_x_mm, shift_y_mm);
    if (shift_mm == 0) return;
    const double ux = shift_x_mm / shift_mm;
    const double uy = shift_y_mm / shift_mm;
    const double along_mm = ux * disc.x_mm + uy * disc.y_mm;
    const double across_mm = ux * disc.y_mm - uy * disc.x_mm;
    const double half_chord_mm =
        std::sqrt(std::max(disc_radius_mm * disc_radius_mm - across_mm * across_mm, 1e-12));
    const double turns = (along_mm + shift_mm + half_chord_mm) / (2 * half_chord_mm);
    const double moved_mm = along_mm + shift_mm - 2 * half_chord_mm * std::floor(turns);
    disc.x_mm = moved_mm * ux - across_mm * uy;
    disc.y_mm = moved_mm * uy + across_mm * ux;
}

// The vitreous as one rigid body that turns about the centre of the eye: particles move sideways by
// their distance from there.
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
        const double depth = depth_mm(ParticleLayer::kVitreous, index);
        const double mm_per_rad = (kRotationCentreMm - depth) * seen_in_pupil(depth);
        const double x_mm = cosine_ * disc.x_mm - sine_ * disc.y_mm;
        const double y_mm = sine_ * disc.x_mm + cosine_ * disc.y_mm;
        disc.x_mm = x_mm;
        disc.y_mm = y_mm;
        carry(disc, mm_per_rad * yaw_rad_, mm_per_rad * pitch_rad_, radius_mm_);
    }

  private:
    double radius_mm_;
    double yaw_rad_;
    double pitch_rad_;
    double cosine_;
    double sine_;
    bool at_rest_;
};

// Before which points of the pupil a source off the axis sees the particles of a layer.
class Parallax {
  public:
    Parallax(const Eye& eye, ParticleLayer layer, const FieldPosition& field)
        : layer_(layer),
          radius_mm_(eye.anatomy.particle_disc_radius_mm *
                     (layer == ParticleLayer::kLens ? eye.pose.lens_scale : 1)),
          view_(oblique(eye, field)),
          slope_x_(std::tan(rad_from_deg(field.x_deg))),
          slope_y_(std::tan(rad_from_deg(field.y_deg))) {}

    void operator()(wave::Particle& disc, std::size_t index) const {
        if (view_.shortening == 0) return;
        const double depth = depth_mm(layer_, index);
        const double mm = depth < 0 ? depth : kInsideOverOutside * depth * seen_in_pupil(depth);
        carry(disc, mm * slope_x_, mm * slope_y_, radius_mm_);
        const wave::Point place = foreshortened({disc.x_mm, disc.y_mm}, view_);
        disc.x_mm = place.x_mm;
        disc.y_mm = place.y_mm;
    }

  private:
    ParticleLayer layer_;
    double radius_mm_;
    Oblique view_;
    double slope_x_;
    double slope_y_;
};

}  // namespace

void add_particles(const Eye& eye, ParticleLayer layer, wave::Mask& coverage,
                   const FieldPosition& field) {
    check(eye);
    const Anatomy& anatomy = eye.anatomy;
    const Parallax seen_from_field(eye, layer, field);
    const auto add = [&](const Particles& particles, Stream stream, const auto& move) {
        add_disc_of_particles(eye, particles, stream, coverage,
                              [&](wave::Particle& disc, std::size_t index) {
                                  move(disc, index);
                                  seen_from_field(disc, index);
                              });
    };
    const auto with_lens = [scale = eye.pose.lens_scale](wave::Particle& disc, std::size_t) {
        disc.x_mm *= scale;
        disc.y_mm *= scale;
    };
    switch (layer) {
        case ParticleLayer::kLens:
            add(anatomy.lens_small, kLensSmallStream, with_lens);
            add(anatomy.lens_large, kLensLargeStream, with_lens);
            break;
        case ParticleLayer::kVitreous:
            add(anatomy.vitreous, kVitreousStream, VitreousMotion(eye));
            break;
        case ParticleLayer::kCornea:
            add(anatomy.cornea, kCorneaStream, [](wave::Particle&, std::size_t) {});
            break;
    }
}

}  // namespace aureole::eye
