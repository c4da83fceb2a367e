// Whose eye it is, and what it is adapted to.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "aureole/eye/anatomy.h"
#include "aureole/image/view.h"

namespace aureole::app {

class EyeOptions {
  public:
    void add_options(CLI::App& command);

    // Whether the pupil follows from the luminance that the eye is adapted to.
    bool needs_adaptation() const { return pupil_ == "auto" && adaptation_ == "auto"; }
    // The eye of the options, looking at a view. `metered_cd_m2` is used if needs_adaptation().
    eye::Eye eye(double metered_cd_m2, const View& view) const;

  private:
    std::string preset_ = "physical";
    double age_years_ = 30;
    std::string pigmentation_ = "brown";
    std::string scatter_ = "cie";
    std::optional<double> corona_contrast_;
    std::optional<double> halo_;
    std::optional<double> streaks_;
    std::string pupil_ = "auto";
    std::string pupil_model_ = "watson-yellott";
    std::string adaptation_ = "auto";
    double eyelid_ = 0;
    int eyelashes_ = 7;
    std::uint64_t seed_ = 1;
};

// Every value of an eye, for reports.
nlohmann::ordered_json to_json(const eye::Eye& eye);

}  // namespace aureole::app
