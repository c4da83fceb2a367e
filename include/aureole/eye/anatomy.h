// What an eye is made of: the parameters of one eye at one moment.
//
// Defaults are an average adult. They are those with which the corona, the halo and the streaks
// were calibrated against measured glare; lengths are in the plane of the entrance pupil.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "aureole/eye/scatter.h"
#include "aureole/wave/aperture.h"

namespace aureole::eye {

// Discs of log-uniformly distributed radius, uniformly spread over a disc.
struct Particles {
    int count = 0;  // 0 to 200000
    double min_radius_um = 0;
    double max_radius_um = 0;  // >= min_radius_um

    bool operator==(const Particles&) const = default;
};

// The fibres of the lens, radially arranged; their grating makes the lenticular halo.
struct Gratings {
    int fibres = 1740;  // per turn, 1 to 10000. A period of 10.85 um at 3 mm, which puts the halo
                        // at 3 deg for 568 nm. The thesis used 200: a halo at 0.3 deg
    double phase_rad = 0.175;      // amplitude of the delay, 0 to 3
    double inner_radius_mm = 1.8;  // the delay rises smoothly from 0 here ...
    double full_radius_mm = 3.2;   // ... to its full value here
    double jitter_fibres = 0.25;   // rms displacement of the fibres, in fibre spacings

    bool operator==(const Gratings&) const = default;
};

// The lashes in front of the pupil: those that hang from the upper lid of the open eye, and those
// of both lids that curl away from it and come before the pupil when lids close.
struct Lashes {
    double width_um = 75;      // mean of the full width at the root, +- 25 %
    double angle_sd_deg = 15;  // standard deviation of the direction about the vertical
    double reach = 0.45;       // mean share of the pupil's height that a lash covers from above
    double reach_sd = 0.25;    // its standard deviation
    double curvature_per_mm = 0.03;  // standard deviation
    double distance_mm = 12;     // of the lashes and the lid's edge before the pupil, 0 to 30: what
                                 // moves them across it with the direction of the light
    double curled_per_mm = 2.8;  // along either lid, where Eye::eyelashes is 7; 0 to 10
    double curl_deg = 40;  // how far they curl away from straight ahead, spread evenly from 0 to
                           // this, which is 1 to 90

    bool operator==(const Lashes&) const = default;
};

enum class PupilShape {
    kRound,    // people
    kSlit,     // cats, foxes, geckos: between two arcs with vertical tips
    kEllipse,  // horses, sheep, goats: long axis horizontal
};

// The outline of a pupil. A pupil_diameter_mm is the diameter of the disc of equal area, whatever
// the shape: it lets in the same light. The ring of the iris ends every pupil at iris_mm, so that
// slits and ellipses become round when they open: the tips of a slit stay there while its sides
// part, an ellipse keeps its axis ratio until it is that long (docs/eye.md).
struct PupilForm {
    PupilShape shape = PupilShape::kRound;
    double axis_ratio = 2;    // kEllipse: long over short, 1 to 10
    double iris_mm = 9;       // 1 to 9
    double rotation_deg = 0;  // counter-clockwise, -180 to 180

    bool operator==(const PupilForm&) const = default;
};

struct Anatomy {
    PupilForm pupil;
    Particles lens_small = {2500, 1.5, 8};
    Particles lens_large = {750, 10, 35};
    Particles vitreous = {2500, 1.5, 8};
    Particles cornea = {60, 10, 35};
    double particle_disc_radius_mm = 4;  // where particles are found; 0.5 to 5
    Gratings gratings;
    Lashes lashes;
    double lower_lid_share = 0.1;  // of a closing, done by the lower lid; the upper one does the
                                   // rest. 0 to 0.5
    double pupil_irregularity = 0.004;  // rms scale of the harmonics of the pupil's edge, 0 to 0.1

    bool operator==(const Anatomy&) const = default;
};

// Where those parts of an eye are that move; the default is an eye at rest. motion.h says how they
// move with time.
struct Pose {
    double lens_scale = 1;  // of the lens, its fibres and particles, about the axis; 0.9 to 1.1
    // Rotation of the vitreous against the eye, about the eye's centre; -90 to 90 each.
    double vitreous_yaw_deg = 0;    // > 0: its front has moved towards +x
    double vitreous_pitch_deg = 0;  // > 0: towards +y
    double vitreous_roll_deg = 0;   // > 0: counter-clockwise
    // How far the lashes have come down with a lid that covers nothing, 0 to 1 as Eye::eyelid; the
    // larger of both counts.
    double lash_closure = 0;

    bool operator==(const Pose&) const = default;
};

// One eye, and what it is made to look like.
struct Eye {
    double pupil_diameter_mm = 5;  // of the disc of equal area, 1 to 9; see pupil.h
    double age_years = 30;         // 1 to 120
    Pigmentation pigmentation = Pigmentation::kBrown;
    ScatterModel scatter = ScatterModel::kCie;
    double eyelid = 0;       // 0 open to 1 closed (refused: no opening)
    int eyelashes = 7;       // 0 to 100
    std::uint64_t seed = 1;  // another seed is another person
    // Looks. 1 is physical; all of them conserve energy.
    double corona_contrast = 1;  // exponent of the corona's texture, 0 (smooth) to 16
    double halo = 1;             // scale of the halo's energy, 0 to 20
    double streaks = 1;          // scale of the energy in the streaks, 0 to 20
    Anatomy anatomy;
    Pose pose;

    bool operator==(const Eye&) const = default;
};

// Throws InvalidArgument that names the first value outside the ranges above.
void check(const Eye& eye);

// Length and width of the pupil along its axes, mm; both the diameter of a round one.
struct PupilAxes {
    double long_mm = 0;
    double short_mm = 0;
};
PupilAxes pupil_axes(const Eye& eye) noexcept;

// Named settings of corona_contrast, halo and streaks.
enum class Look {
    kPhysical,  // 1, 1, 1
    kVivid,     // what people say they see. Contrast 4 in a picture 60 deg wide and 2.5 in one
                // 20 deg wide, linear in the logarithm of the field between and constant outside
                // (a pixel of a wide picture averages over more needles); halo 1, streaks 1.5
};
// The names used on the command line: physical, vivid. Throws InvalidArgument for any other.
Look look_from_name(std::string_view name);
void apply_look(Eye& eye, Look look, double horizontal_field_deg);

// Where a source is seen: to the right and up from the visual axis. (tan x, tan y) is its place in
// a picture plane at distance 1. Both within +-80 deg.
struct FieldPosition {
    double x_deg = 0;
    double y_deg = 0;
};
// Throws InvalidArgument that names what is outside.
void check(const FieldPosition& field);

// ---- The layers, drawn one by one. Each depends on the eye and its own random stream only, so
// that changing one leaves the others as they are. ----
//
// Layers are drawn as a source at `field` sees them: what lies distance_mm before the pupil is
// displaced by -distance_mm (tan x, tan y), what lies behind it the other way, and everything is
// foreshortened along the direction of the source by the cosine of its angle.

// Amplitude transmission of the pupil, upper lid included: 1 inside, 0 outside.
// Throws InvalidArgument if the lid leaves no opening on the axis; from elsewhere light may meet
// a closed lid, and all is 0.
wave::Mask draw_pupil(const Eye& eye, const wave::ApertureGrid& grid,
                      const FieldPosition& field = {});

enum class ParticleLayer {
    kLens,      // small and large, through its 3.6 mm; moves with the lens
    kVitreous,  // in two depths, 4 and 8 mm behind the pupil; moves when eye and head turn
    kCornea,    // static, 3.05 mm before the pupil
};
// Adds 1 wherever a particle of the layer lies (antialiased; overlapping particles add up).
// There is more of a layer than the disc that is drawn: a particle that leaves it, because the eye
// moves or the source lies aside, enters again at the other end of the chord.
void add_particles(const Eye& eye, ParticleLayer layer, wave::Mask& coverage,
                   const FieldPosition& field = {});

// Multiplies the field by the delay of the lens fibres, as a phase.
void multiply_gratings(const Eye& eye, wave::Field& field);
// Empty if the raster resolves the fibres wherever they scatter (period >= 2 samples), else a
// sentence that says where it does not.
std::string grating_resolution_note(const Eye& eye, const wave::ApertureGrid& grid);

// Share of each sample that lashes block. They move with their lids. Those of `eyelashes` hang
// before the pupil of a source on the axis; the row goes on to both sides at the same spacing,
// 15 mm from the axis at most, with lashes that do not reach this pupil. As lids close, lashes that
// meet the other lid keep their length between the edge of their own and their tip, which stays on
// that of the other: they become arcs, at most half circles. Curled ones turn in with their lid,
// and neighbours come together in tufts (docs/streaks.md).
wave::Mask draw_lashes(const Eye& eye, const wave::ApertureGrid& grid,
                       const FieldPosition& field = {});

}  // namespace aureole::eye
