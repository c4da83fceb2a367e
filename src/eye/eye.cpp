// Ranges of the parameters of an eye, and its named looks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/eye/anatomy.h"

namespace aureole::eye {
namespace {

void require(const char* parameter, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;  // false for NaN
    throw InvalidArgument(parameter, fmt::format("{}", value),
                          fmt::format("must be {} to {}{}", low, high, unit));
}

void check_particles(const char* layer, const Particles& particles) {
    require(layer, particles.count, 0, 200000, " particles");
    require(layer, particles.min_radius_um, 0.1, 1000, " um radius");
    require(layer, particles.max_radius_um, particles.min_radius_um, 1000, " um radius");
}

}  // namespace

void check(const Eye& eye) {
    require("pupil", eye.pupil_diameter_mm, 1, 9, " mm");
    require("age", eye.age_years, 1, 120, " years");
    require("eyelid", eye.eyelid, 0, 1, "");
    if (eye.eyelid == 1) throw InvalidArgument("eyelid", "1", "the eye is closed; must be below 1");
    require("eyelashes", eye.eyelashes, 0, 100, "");
    require("corona-contrast", eye.corona_contrast, 0, 16, "");
    require("halo", eye.halo, 0, 20, "");
    require("streaks", eye.streaks, 0, 20, "");
    const Anatomy& anatomy = eye.anatomy;
    require("pupil axis ratio", anatomy.pupil.axis_ratio, 1, 10, "");
    require("iris", anatomy.pupil.iris_mm, 1, 9, " mm");
    require("pupil rotation", anatomy.pupil.rotation_deg, -180, 180, " deg");
    check_particles("lens_small", anatomy.lens_small);
    check_particles("lens_large", anatomy.lens_large);
    check_particles("vitreous", anatomy.vitreous);
    check_particles("cornea", anatomy.cornea);
    require("particle_disc_radius", anatomy.particle_disc_radius_mm, 0.5, 5, " mm");
    require("pupil_irregularity", anatomy.pupil_irregularity, 0, 0.1, "");
    require("lower_lid_share", anatomy.lower_lid_share, 0, 0.5, "");
    require("gratings", anatomy.gratings.fibres, 1, 10000, " fibres");
    require("grating phase", anatomy.gratings.phase_rad, 0, 3, " rad");
    require("grating inner radius", anatomy.gratings.inner_radius_mm, 0.05, 5, " mm");
    require("grating full radius", anatomy.gratings.full_radius_mm,
            anatomy.gratings.inner_radius_mm + 0.001, 10, " mm");
    require("grating jitter", anatomy.gratings.jitter_fibres, 0, 10, " fibres");
    require("lash width", anatomy.lashes.width_um, 1, 1000, " um");
    require("lash angle", anatomy.lashes.angle_sd_deg, 0, 60, " deg");
    require("lash reach", anatomy.lashes.reach, 0, 2, "");
    require("lash reach_sd", anatomy.lashes.reach_sd, 0, 1, "");
    require("lash curvature", anatomy.lashes.curvature_per_mm, 0, 0.1, " per mm");
    require("lash distance", anatomy.lashes.distance_mm, 0, 30, " mm");
    require("curled lashes", anatomy.lashes.curled_per_mm, 0, 10, " per mm");
    require("lash curl", anatomy.lashes.curl_deg, 1, 90, " deg");
    require("lens scale", eye.pose.lens_scale, 0.9, 1.1, "");
    require("vitreous yaw", eye.pose.vitreous_yaw_deg, -90, 90, " deg");
    require("vitreous pitch", eye.pose.vitreous_pitch_deg, -90, 90, " deg");
    require("vitreous roll", eye.pose.vitreous_roll_deg, -90, 90, " deg");
    require("lash closure", eye.pose.lash_closure, 0, 1, "");
}

void check(const FieldPosition& field) {
    require("field x", field.x_deg, -80, 80, " deg");
    require("field y", field.y_deg, -80, 80, " deg");
}

Look look_from_name(std::string_view name) {
    if (name == "physical") return Look::kPhysical;
    if (name == "vivid") return Look::kVivid;
    throw InvalidArgument("look", std::string(name), "must be physical or vivid");
}

void apply_look(Eye& eye, Look look, double horizontal_field_deg) {
    if (!(horizontal_field_deg > 0 && horizontal_field_deg <= 360)) {
        throw InvalidArgument("field of view", fmt::format("{}", horizontal_field_deg),
                              "must be in (0, 360] deg");
    }
    eye.corona_contrast = 1;
    eye.halo = 1;
    eye.streaks = 1;
    if (look == Look::kPhysical) return;
    const double position =
        std::clamp(std::log(horizontal_field_deg / 20) / std::log(60.0 / 20), 0.0, 1.0);
    eye.corona_contrast = 2.5 + 1.5 * position;
    eye.streaks = 1.5;
}

}  // namespace aureole::eye
