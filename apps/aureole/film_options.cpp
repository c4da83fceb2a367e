#include "film_options.h"

#include "option_checks.h"

namespace aureole::app {

void FilmOptions::add_options(CLI::App& command) {
    group_ = command.add_option_group(
        "The film", "Blooms with --passes both or bloom: light that its base throws back");
    number(group_->add_option("--halation", halation_.share,
                              "Share of the light that comes back around its point"),
           0, 1)
        ->type_name("SHARE")
        ->capture_default_str();
    number(group_->add_option("--halation-layer", halation_.layer_mm,
                              "Thickness of the base of the film, or of the cover glass of a "
                              "sensor: half of the light lies within about twice as much"),
           0.001, 100)
        ->type_name("MM")
        ->capture_default_str();
    number(group_->add_option("--halation-index", halation_.refractive_index,
                              "Refractive index of that layer"),
           1.01, 4)
        ->type_name("N")
        ->capture_default_str();
    number(
        group_->add_option("--halation-backing", halation_.backing,
                           "Reflectance of what the layer lies on; 0 (air, black) leaves a ring"),
        0, 1)
        ->type_name("0..1")
        ->capture_default_str();
}

std::string FilmOptions::first_given() const { return app::first_given(*group_); }

}  // namespace aureole::app
