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

// Where a source off the axis sees the points of a layer.
struct Oblique {
    double shift_x_mm = 0;  // of what lies before the pupil
    double shift_y_mm = 0;
    double along_x = 0;  // unit vector from the axis to the source
    double along_y = 0;
    double shortening = 0;  // 1 - cosine of the angle
};

Oblique oblique(const Eye& eye, const FieldPosition& field) {
    check(field);
    const double x = std::tan(rad_from_deg(field.x_deg));
    const double y = std::tan(rad_from_deg(field.y_deg));
    const double r = std::hypot(x, y);
    if (r == 0) return {};
    const double distance_mm = eye.anatomy.lashes.distance_mm;
    return {-distance_mm * x, -distance_mm * y, x / r, y / r, 1 - 1 / std::hypot(1, r)};
}

enum class Layer { kPupil, kBeforePupil };

wave::Shape seen(wave::Shape shape, Layer layer, const Oblique& view) {
    if (view.shortening == 0) return shape;
    const bool shifted = layer == Layer::kBeforePupil;
    for (auto& outline : shape.outlines) {
        for (wave::Point& point : outline) {
            if (shifted) {
                point.x_mm += view.shift_x_mm;
                point.y_mm += view.shift_y_mm;
            }
            const double along = point.x_mm * view.along_x + point.y_mm * view.along_y;
            point.x_mm -= view.shortening * along * view.along_x;
            point.y_mm -= view.shortening * along * view.along_y;
        }
    }
    return shape;
}

// How far the upper lid has come down, and the lower one up, from the open eye, mm.
double lid_descent_mm(const Eye& eye, double closure) {
    return (1 - eye.anatomy.lower_lid_share) * closure * eye.pupil_diameter_mm;
}
double lid_rise_mm(const Eye& eye, double closure) {
    return eye.anatomy.lower_lid_share * closure * eye.pupil_diameter_mm;
}

// A lash of the length `span_mm` below the upper lid's edge, which the lower lid has left `gap_mm`
// of height, as an arc of that length; its tip stands on the lower lid. Root and direction of the
// chord stay. x = sin(x) / (1 - e) gives half of the arc's angle: x^2 = 6 e (1 + .3 e) to 1 % up to
// a half circle.
void bend(wave::Lash& lash, double span_mm, double gap_mm) {
    const double direction = rad_from_deg(lash.direction_deg);
    const double length_mm = span_mm / std::sin(direction);
    const double missing = std::clamp(1 - gap_mm / span_mm, 0.0, 1.0);
    if (missing == 0) return;
    const double half_angle = std::min(std::sqrt(6 * missing * (1 + 0.3 * missing)), kPi / 2);
    const double side = std::copysign(1.0, lash.curvature_per_mm);
    lash.tip.x_mm += missing * length_mm * std::cos(direction);
    lash.tip.y_mm += missing * span_mm;
    lash.direction_deg -= side * deg_from_rad(half_angle);
    lash.curvature_per_mm += side * 2 * half_angle / length_mm;
    // Longer ones would come back as a ring.
    lash.length_mm = std::max(lash.taper_mm, std::min(lash.length_mm, 2 * length_mm));
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
    const double radius_mm = eye.pupil_diameter_mm / 2;
    wave::Mask pupil(grid);
    wave::draw(pupil, seen(wave::irregular_disc(radius_mm, harmonics), Layer::kPupil, view));
    if (eye.eyelid > 0) {
        const auto keep = [&](wave::LidSide side, double edge_y_mm) {
            wave::draw(pupil, seen(wave::lid_opening(side, edge_y_mm), Layer::kBeforePupil, view),
                       wave::Blend::kKeep);
        };
        keep(wave::LidSide::kUpper, radius_mm - lid_descent_mm(eye, eye.eyelid));
        keep(wave::LidSide::kLower, lid_rise_mm(eye, eye.eyelid) - radius_mm);
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

namespace {

// The eyelid's half length: where the row of lashes ends.
constexpr double kRowEndMm = 15;
// Draws of a lash beside the pupil until it hangs clear of it; a lash that does not is left out.
constexpr int kTries = 16;

wave::Lash random_lash(const Eye& eye, double place, Random& random) {
    const Lashes& lashes = eye.anatomy.lashes;
    const double radius_mm = eye.pupil_diameter_mm / 2;
    const double closure = std::max(eye.eyelid, eye.pose.lash_closure);
    const double upper_edge_mm = radius_mm - lid_descent_mm(eye, closure);
    const double lower_edge_mm = lid_rise_mm(eye, closure) - radius_mm;
    const double across = place + 0.12 * random.normal();
    const double reach = std::clamp(lashes.reach + lashes.reach_sd * random.normal(), 0.05, 1.2);
    wave::Lash lash;
    lash.tip = {across * radius_mm,
                radius_mm - reach * eye.pupil_diameter_mm - lid_descent_mm(eye, closure)};
    lash.direction_deg = 90 - lashes.angle_sd_deg * random.normal();
    lash.width_mm = mm_from_um(lashes.width_um) * random.uniform(0.75, 1.25);
    lash.curvature_per_mm = lashes.curvature_per_mm * random.normal();
    if (eye.pose.lashes_bend) {
        // What reaches beyond the lower lid of an open eye hangs in front of it.
        const double beyond_mm = std::max(reach - 1, 0.0) * eye.pupil_diameter_mm;
        bend(lash, reach * eye.pupil_diameter_mm, upper_edge_mm - lower_edge_mm + beyond_mm);
    }
    return lash;
}

// Whether all of an outline stays further than the radius from the axis.
bool clear_of(double radius_mm, const wave::Shape& shape) {
    for (const auto& outline : shape.outlines) {
        wave::Point from = outline.back();
        for (const wave::Point& to : outline) {
            const double dx = to.x_mm - from.x_mm;
            const double dy = to.y_mm - from.y_mm;
            const double square = dx * dx + dy * dy;
            const double along =
                square > 0 ? std::clamp(-(from.x_mm * dx + from.y_mm * dy) / square, 0.0, 1.0) : 0;
            if (std::hypot(from.x_mm + along * dx, from.y_mm + along * dy) <= radius_mm) {
                return false;
            }
            from = to;
        }
    }
    return true;
}

}  // namespace

wave::Mask draw_lashes(const Eye& eye, const wave::ApertureGrid& grid, const FieldPosition& field) {
    check(eye);
    const Oblique view = oblique(eye, field);
    const double radius_mm = eye.pupil_diameter_mm / 2;
    Random random(eye.seed, kLashStream);
    wave::Mask blocked(grid);
    const auto draw = [&](const wave::Shape& shape) {
        wave::draw(blocked, seen(shape, Layer::kBeforePupil, view), wave::Blend::kMax);
    };
    // Evenly spaced across 85 % of the pupil, then displaced; places in radii of the pupil.
    const double spacing = 2 * 0.85 / std::max(eye.eyelashes, 1);
    for (int i = 0; i < eye.eyelashes; ++i) {
        draw(wave::lash(random_lash(eye, -0.85 + (i + 0.5) * spacing, random)));
    }
    if (view.shortening == 0 || eye.eyelashes == 0) return blocked;
    // The rest of the row, outwards, one to the right and one to the left.
    const double clear_mm = radius_mm * (1 + eye.anatomy.pupil_irregularity * kLastEdgeHarmonic);
    for (double place = 0.85 + spacing / 2; place * radius_mm < kRowEndMm; place += spacing) {
        for (const double side : {1.0, -1.0}) {
            for (int attempt = 0; attempt < kTries; ++attempt) {
                const wave::Shape shape = wave::lash(random_lash(eye, side * place, random));
                if (!clear_of(clear_mm, shape)) continue;
                draw(shape);
                break;
            }
        }
    }
    return blocked;
}

}  // namespace aureole::eye
