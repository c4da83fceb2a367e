// Whose eye it is, and what it is adapted to.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/motion.h"
#include "aureole/image/view.h"

namespace aureole::app {

class EyeOptions {
  public:
    // --preset and the others.
    void add_options(CLI::App& command);
    // The others, for commands whose --preset knows further words.
    void add_options_but_preset(CLI::App& command);
    // Those that say whose eye it is, for flipbooks: how it is at a moment, and how much of the
    // halo and the streaks is seen, is chosen when they are used.
    void add_options_of_the_person(CLI::App& command);
    void set_preset(const std::string& word) { preset_ = word; }

    // Throws InvalidArgument for an eye that cannot be and for options that have no effect, before
    // any picture is read. `lids_know_light`: the adaptation luminance moves lids, too.
    void check(bool lids_know_light = false) const;
    // The first of these options that was given, or nothing.
    std::string first_given() const;

    // Whether the pupil follows from the luminance that the picture is metered at.
    bool needs_adaptation() const { return pupil_ == "auto" && meters(); }
    // Whether nothing else tells that luminance.
    bool meters() const { return adaptation_ == "auto"; }
    // The table over time that --adaptation names, or nothing.
    std::string adaptation_file() const;
    // --adaptation as a number, or what was metered.
    double adaptation_cd_m2(double metered_cd_m2) const;
    std::uint64_t seed() const { return seed_; }
    // Single values, for looks that use a few of them.
    bool given(const std::string& option) const;
    bool pupil_given() const;  // by any option that says how wide it is
    double pupil_mm(double metered_cd_m2, const View& view) const;
    double eyelid() const { return eyelid_; }
    int eyelashes() const { return eyelashes_; }
    bool has_corona() const { return scatter_ != "none" && corona_contrast_.value_or(1) > 0; }
    double halo() const { return halo_.value_or(1); }
    double streaks() const { return streaks_.value_or(1); }
    // The model unless --pupil-model says otherwise.
    void set_default_pupil_model(const std::string& name);
    // Where the mean of a pupil that moves comes from, in an eye that looks at a view.
    void apply_pupil(eye::MotionSettings& settings, const View& view) const;
    // The eye of the options, looking at a view. `metered_cd_m2` is used if needs_adaptation().
    eye::Eye eye(double metered_cd_m2, const View& view) const;
    // The light that it sees, by --source-spectrum.
    eye::SpectralSampling sampling() const;
    // Whether each light has the spectrum of its own colour: PSFs are matrices then.
    bool by_color() const;
    // Every value of that eye, and where it came from.
    nlohmann::ordered_json report(const eye::Eye& eye, double metered_cd_m2) const;

  private:
    void add_options_to_group();
    eye::PupilConditions pupil_conditions(const View& view) const;
    eye::PupilForm pupil_form() const;

    CLI::Option_group* group_ = nullptr;
    std::string preset_ = "physical";
    double age_years_ = 30;
    std::string pigmentation_ = "brown";
    std::string scatter_ = "cie";
    std::optional<double> corona_contrast_;
    std::optional<double> halo_;
    std::optional<double> streaks_;
    std::string pupil_ = "auto";
    std::string pupil_model_ = "watson-yellott";
    std::string pupil_shape_ = "round";
    std::optional<double> pupil_rotation_deg_;
    std::string adaptation_ = "auto";
    double eyelid_ = 0;
    int eyelashes_ = 7;
    std::string source_spectrum_ = "d65";
    std::uint64_t seed_ = 1;
};

}  // namespace aureole::app
