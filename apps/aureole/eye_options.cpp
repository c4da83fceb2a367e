#include "eye_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/color/illuminant.h"
#include "aureole/eye/pupil.h"
#include "aureole/eye/ranges.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

// --source-spectrum: not a lamp.
constexpr const char* kByColor = "rgb";

}  // namespace

void EyeOptions::add_options(CLI::App& command) {
    group_ = command.add_option_group("The eye");
    one_of(group_->add_option("--preset", preset_,
                              "physical: as measured; vivid: what people say they see (corona "
                              "contrast 2.5 to 4, streaks x1.5)"),
           {"physical", "vivid"})
        ->capture_default_str();
    add_options_to_group();
}

void EyeOptions::add_options_but_preset(CLI::App& command) {
    group_ = command.add_option_group("The eye");
    add_options_to_group();
}

void EyeOptions::add_options_of_the_person(CLI::App& command) {
    add_options(command);
    for (const char* name :
         {"--halo", "--streaks", "--pupil", "--pupil-model", "--adaptation", "--eyelid"}) {
        group_->remove_option(group_->get_option(name));
    }
}

void EyeOptions::add_options_to_group() {
    CLI::Option_group& group = *group_;
    number(group.add_option("--age", age_years_, "Years; older eyes scatter more"))
        ->type_name("YEARS")
        ->capture_default_str();
    one_of(group.add_option("--pigmentation", pigmentation_, "Colour of the iris"),
           {"brown", "blue", "dark-brown", "mean"})
        ->capture_default_str();
    one_of(group.add_option("--scatter", scatter_,
                            "Scatter model: cie (CIE 135/1-1999), ijspeert (1993), none "
                            "(diffraction at the pupil only)"),
           {"cie", "ijspeert", "none"})
        ->capture_default_str();
    number(group.add_option("--corona-contrast", corona_contrast_,
                            "Exponent of the corona's needles; 1 is physical"))
        ->type_name("G");
    number(group.add_option("--halo", halo_, "Scale of the lenticular halo; 1 is physical"))
        ->type_name("X");
    number(group.add_option("--streaks", streaks_, "Scale of the eyelash streaks; 1 is physical"))
        ->type_name("X");
    number_or_auto(group.add_option("--pupil", pupil_,
                                    "Diameter in mm (of a round pupil of the same area), or auto: "
                                    "from the adaptation luminance"))
        ->type_name("auto|MM")
        ->capture_default_str();
    one_of(group.add_option("--pupil-model", pupil_model_, "From luminance to diameter"),
           {"watson-yellott", "moon-spencer", "de-groot", "thesis"})
        ->capture_default_str();
    group
        .add_option("--pupil-shape", pupil_shape_,
                    "round; slit: a cat's, vertical, its tips 9 mm apart; ellipse:RATIO: a goat's "
                    "or a horse's, RATIO (1 to 10) times as wide as high and 9 mm at most")
        ->type_name("round|slit|ellipse:RATIO")
        ->capture_default_str();
    number(group.add_option("--pupil-rotation", pupil_rotation_deg_,
                            "Turns a slit or an ellipse, counter-clockwise"),
           -180, 180)
        ->type_name("DEG");
    group
        .add_option("--adaptation", adaptation_,
                    "Luminance the eye is adapted to, in cd/m2, or auto: attribute "
                    "aureole:adaptation_cd_m2, else the mean of the picture; of an eye in motion, "
                    "a table of `aureole meter`")
        ->type_name("auto|CD_M2|FILE")
        ->capture_default_str();
    number(
        group.add_option("--eyelid", eyelid_, "How far the upper lid is closed: 0 open, 1 closed"))
        ->type_name("0..1")
        ->capture_default_str();
    whole_number(group.add_option("--eyelashes", eyelashes_, "Lashes in front of the pupil"), 0,
                 100)
        ->type_name("N")
        ->capture_default_str();
    one_of(group.add_option("--source-spectrum", source_spectrum_,
                            "Spectrum of the lights: it makes the colours of diffraction. A light "
                            "keeps its own colour in sum. rgb: each light has the smoothest "
                            "spectrum of its colour (white: d65)"),
           {"d65", "tungsten", "sodium", "high-pressure-sodium", "mercury", "led", kByColor})
        ->capture_default_str();
    seed_number(group.add_option("--seed", seed_, "Another seed is another eye"))
        ->type_name("N")
        ->capture_default_str();
}

std::string EyeOptions::first_given() const { return app::first_given(*group_); }

void EyeOptions::check(bool lids_know_light) const {
    if (given_number(pupil_)) {
        refuse(given("--pupil-model") ? "--pupil-model" : "",
               "has no effect with --pupil " + pupil_);
        refuse(given("--adaptation") && !lids_know_light ? "--adaptation" : "",
               "has no effect with --pupil " + pupil_);
    }
    if (const auto adaptation = given_number(adaptation_);
        adaptation && !(*adaptation >= 0 && *adaptation <= eye::kBrightestCdM2)) {
        throw InvalidArgument("--adaptation", adaptation_,
                              fmt::format("must be 0 to {:g} cd/m2", eye::kBrightestCdM2));
    }
    constexpr double kAnyLuminance = 1;
    eye(kAnyLuminance, View::from_fov(16, 9, 60, Projection::kPerspective));
}

std::string EyeOptions::adaptation_file() const {
    return adaptation_ == "auto" || given_number(adaptation_) ? "" : adaptation_;
}

eye::PupilForm EyeOptions::pupil_form() const {
    constexpr std::string_view kEllipse = "ellipse:";
    eye::PupilForm form;
    if (pupil_shape_ == "slit") {
        form.shape = eye::PupilShape::kSlit;
    } else if (pupil_shape_.starts_with(kEllipse)) {
        form.shape = eye::PupilShape::kEllipse;
        form.axis_ratio = given_number(pupil_shape_.substr(kEllipse.size())).value_or(0);
    } else if (pupil_shape_ != "round") {
        form.axis_ratio = 0;
    }
    if (!(form.axis_ratio >= 1 && form.axis_ratio <= 10)) {
        throw InvalidArgument("--pupil-shape", pupil_shape_,
                              "must be round, slit, or ellipse: and a number from 1 to 10");
    }
    if (form.shape == eye::PupilShape::kRound && pupil_rotation_deg_) {
        throw InvalidArgument("--pupil-rotation", fmt::format("{}", *pupil_rotation_deg_),
                              "turns nothing: needs --pupil-shape slit or ellipse:RATIO");
    }
    form.rotation_deg = pupil_rotation_deg_.value_or(0);
    return form;
}

eye::PupilConditions EyeOptions::pupil_conditions(const View& view) const {
    constexpr double kSphereDeg2 = 41252;  // a wide picture of equal angles may claim more
    eye::PupilConditions conditions;
    conditions.age_years = age_years_;
    conditions.field_area_deg2 =
        std::min(view.solid_angle_sr() * deg_from_rad(1) * deg_from_rad(1), kSphereDeg2);
    return conditions;
}

void EyeOptions::apply_pupil(eye::MotionSettings& settings, const View& view) const {
    settings.pupil_model = eye::pupil_model_from_name(pupil_model_);
    settings.pupil_conditions = pupil_conditions(view);
    settings.mean_pupil_mm = given_number(pupil_);
}

double EyeOptions::adaptation_cd_m2(double metered_cd_m2) const {
    return given_number(adaptation_).value_or(metered_cd_m2);
}

bool EyeOptions::given(const std::string& option) const {
    return group_->get_option(option)->count() > 0;
}

bool EyeOptions::pupil_given() const {
    return given("--pupil") || given("--pupil-model") || given("--adaptation");
}

void EyeOptions::set_default_pupil_model(const std::string& name) {
    if (!given("--pupil-model")) pupil_model_ = name;
}

double EyeOptions::pupil_mm(double metered_cd_m2, const View& view) const {
    if (const std::optional<double> diameter_mm = given_number(pupil_)) return *diameter_mm;
    return eye::pupil_diameter_mm(eye::pupil_model_from_name(pupil_model_),
                                  adaptation_cd_m2(metered_cd_m2), pupil_conditions(view));
}

eye::Eye EyeOptions::eye(double metered_cd_m2, const View& view) const {
    eye::Eye eye;
    eye.age_years = age_years_;
    eye.pigmentation = eye::pigmentation_from_name(pigmentation_);
    eye.scatter = eye::scatter_model_from_name(scatter_);
    eye.eyelid = eyelid_;
    eye.eyelashes = eyelashes_;
    eye.seed = seed_;
    eye.anatomy.pupil = pupil_form();
    eye.pupil_diameter_mm = pupil_mm(metered_cd_m2, view);
    eye::apply_look(eye, eye::look_from_name(preset_), view.horizontal_field_deg());
    eye.corona_contrast = corona_contrast_.value_or(eye.corona_contrast);
    eye.halo = halo_.value_or(eye.halo);
    eye.streaks = streaks_.value_or(eye.streaks);
    eye::check(eye);
    return eye;
}

bool EyeOptions::by_color() const { return source_spectrum_ == kByColor; }

eye::SpectralSampling EyeOptions::sampling() const {
    eye::SpectralSampling sampling;
    sampling.by_color = by_color();
    if (!sampling.by_color) {
        sampling.illuminant = color::illuminant_from_name(source_spectrum_);
    }
    return sampling;
}

nlohmann::ordered_json EyeOptions::report(const eye::Eye& eye, double metered_cd_m2) const {
    nlohmann::ordered_json json = {{"preset", preset_},
                                   {"pupil_mm", eye.pupil_diameter_mm},
                                   {"pupil_shape", pupil_shape_},
                                   {"age_years", eye.age_years},
                                   {"pigmentation", std::string(eye::name_of(eye.pigmentation))},
                                   {"scatter", std::string(eye::name_of(eye.scatter))},
                                   {"corona_contrast", eye.corona_contrast},
                                   {"halo", eye.halo},
                                   {"streaks", eye.streaks},
                                   {"eyelid", eye.eyelid},
                                   {"eyelashes", eye.eyelashes},
                                   {"source_spectrum", source_spectrum_},
                                   {"seed", eye.seed}};
    if (const eye::PupilForm& form = eye.anatomy.pupil; form.shape != eye::PupilShape::kRound) {
        const eye::PupilAxes axes = eye::pupil_axes(eye);
        json["pupil_long_mm"] = axes.long_mm;
        json["pupil_short_mm"] = axes.short_mm;
        json["pupil_rotation_deg"] = form.rotation_deg;
    }
    if (pupil_ == "auto") {
        json["pupil_model"] = pupil_model_;
        json["adaptation_cd_m2"] = adaptation_cd_m2(metered_cd_m2);
    }
    return json;
}

}  // namespace aureole::app
