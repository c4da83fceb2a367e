#include "eye_options.h"

#include <charconv>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/eye/pupil.h"

namespace aureole::app {
namespace {

double number(const char* option, const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) {
        throw InvalidArgument(option, text, "must be a number or auto");
    }
    return value;
}

}  // namespace

void EyeOptions::add_options(CLI::App& command) {
    CLI::Option_group& group = *command.add_option_group("The eye");
    group
        .add_option("--preset", preset_,
                    "physical: as measured; vivid: what people say they see (corona contrast 2.5 "
                    "to 4, streaks x1.5)")
        ->check(CLI::IsMember({"physical", "vivid"}))
        ->capture_default_str();
    group.add_option("--age", age_years_, "Years; older eyes scatter more")
        ->type_name("YEARS")
        ->capture_default_str();
    group.add_option("--pigmentation", pigmentation_, "Colour of the iris")
        ->check(CLI::IsMember({"brown", "blue", "dark-brown", "mean"}))
        ->capture_default_str();
    group
        .add_option("--scatter", scatter_,
                    "Scatter model: cie (CIE 135/1-1999), ijspeert (1993), none (diffraction at "
                    "the pupil only)")
        ->check(CLI::IsMember({"cie", "ijspeert", "none"}))
        ->capture_default_str();
    group
        .add_option("--corona-contrast", corona_contrast_,
                    "Exponent of the corona's needles; 1 is physical")
        ->type_name("G");
    group.add_option("--halo", halo_, "Scale of the lenticular halo; 1 is physical")
        ->type_name("X");
    group.add_option("--streaks", streaks_, "Scale of the eyelash streaks; 1 is physical")
        ->type_name("X");
    group.add_option("--pupil", pupil_, "Diameter in mm, or auto: from the adaptation luminance")
        ->type_name("auto|MM")
        ->capture_default_str();
    group.add_option("--pupil-model", pupil_model_, "From luminance to diameter")
        ->check(CLI::IsMember({"watson-yellott", "moon-spencer", "de-groot", "thesis"}))
        ->capture_default_str();
    group
        .add_option("--adaptation", adaptation_,
                    "Luminance the eye is adapted to, in cd/m2, or auto: attribute "
                    "aureole:adaptation_cd_m2, else the mean of the picture")
        ->type_name("auto|CD_M2")
        ->capture_default_str();
    group.add_option("--eyelid", eyelid_, "How far the upper lid is closed: 0 open, 1 closed")
        ->type_name("0..1")
        ->capture_default_str();
    group.add_option("--eyelashes", eyelashes_, "Lashes in front of the pupil")
        ->type_name("N")
        ->capture_default_str();
    group.add_option("--seed", seed_, "Another seed is another eye")->capture_default_str();
}

eye::Eye EyeOptions::eye(double metered_cd_m2, const View& view) const {
    eye::Eye eye;
    eye.age_years = age_years_;
    eye.pigmentation = eye::pigmentation_from_name(pigmentation_);
    eye.scatter = eye::scatter_model_from_name(scatter_);
    eye.eyelid = eyelid_;
    eye.eyelashes = eyelashes_;
    eye.seed = seed_;
    if (pupil_ == "auto") {
        const double luminance =
            needs_adaptation() ? metered_cd_m2 : number("adaptation (cd/m2)", adaptation_);
        eye::PupilConditions conditions;
        conditions.age_years = age_years_;
        conditions.field_area_deg2 = view.solid_angle_sr() * deg_from_rad(1) * deg_from_rad(1);
        eye.pupil_diameter_mm =
            eye::pupil_diameter_mm(eye::pupil_model_from_name(pupil_model_), luminance, conditions);
    } else {
        eye.pupil_diameter_mm = number("pupil (mm)", pupil_);
    }
    eye::apply_look(eye, eye::look_from_name(preset_), view.horizontal_field_deg());
    eye.corona_contrast = corona_contrast_.value_or(eye.corona_contrast);
    eye.halo = halo_.value_or(eye.halo);
    eye.streaks = streaks_.value_or(eye.streaks);
    eye::check(eye);
    return eye;
}

nlohmann::ordered_json to_json(const eye::Eye& eye) {
    return {{"pupil_mm", eye.pupil_diameter_mm},
            {"age_years", eye.age_years},
            {"pigmentation", std::string(eye::name_of(eye.pigmentation))},
            {"scatter", std::string(eye::name_of(eye.scatter))},
            {"corona_contrast", eye.corona_contrast},
            {"halo", eye.halo},
            {"streaks", eye.streaks},
            {"eyelid", eye.eyelid},
            {"eyelashes", eye.eyelashes},
            {"seed", eye.seed}};
}

}  // namespace aureole::app
