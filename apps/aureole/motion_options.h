// When the eye looks, and what moves in it.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "aureole/eye/motion.h"

namespace aureole::app {

class MotionOptions {
  public:
    // For commands that render pictures; each frame has its moment.
    void add_options(CLI::App& command);
    // For commands that know one moment only: no --fps.
    void add_options_of_a_moment(CLI::App& command);

    // Whether the eye lives, and not only is: --time or --fps.
    bool alive() const { return time_s_ || fps_; }
    bool has_rate() const { return fps_.has_value(); }
    const std::string& needs() const { return needs_; }  // to live, for messages
    // Whether lids close against light, if they know how bright it is.
    bool squints() const { return alive() && squint_ > 0; }
    // The first of these options that was given, or nothing.
    std::string first_given() const;
    // Throws InvalidArgument for options of an eye that moves without a moment.
    void check() const;

    bool given(const std::string& option) const;
    const std::string& blink_word() const { return blink_; }
    const std::string& motion_word() const { return motion_; }

    // Of a frame by its number. Throws InvalidArgument as frame_time_s().
    double time_s(int frame) const;
    // Gaze, blinks and squint. Reads files: throws FileError, InvalidArgument.
    void apply(eye::MotionSettings& settings, std::uint64_t seed) const;
    nlohmann::ordered_json report() const;

  private:
    void moment_option(const std::string& description);
    void add_movements();

    CLI::Option_group* group_ = nullptr;
    std::string needs_;  // one of the options that make the eye live
    std::optional<double> time_s_;
    std::optional<double> fps_;
    std::string motion_ = "off";
    std::string blink_ = "off";
    double squint_ = 0.5;
};

// When a frame is seen. Throws InvalidArgument that names --fps if no eye can be asked about that
// moment (eye/ranges.h). start_s lies within the range.
double frame_time_s(int frame, std::optional<double> fps, double start_s = 0);

}  // namespace aureole::app
