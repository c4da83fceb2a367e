#include "motion_options.h"

#include <fmt/format.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"
#include "number_table.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr const char* kMotionWords = "off, saccades";
constexpr const char* kBlinkWords = "off, auto, streaks, moments in seconds (1.5,4)";

eye::Gaze gaze_from(const std::string& file) {
    const NumberTable table = table_of_option("--motion", file, kMotionWords);
    const auto& yaw = table.column("yaw_deg");
    const auto& pitch = table.column("pitch_deg");
    const auto& roll = table.column("roll_deg");
    std::vector<eye::Rotation> rotations;
    for (std::size_t i = 0; i < yaw.size(); ++i) rotations.push_back({yaw[i], pitch[i], roll[i]});
    try {
        return eye::Gaze::through(table.column("time_s"), std::move(rotations));
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
}

eye::BlinkSettings blinks_from(const std::string& text) {
    eye::BlinkSettings blinks;
    if (text == "off") return blinks;
    blinks.blinking = eye::Blinking::kSpontaneous;
    blinks.streaks_only = text == "streaks";
    if (text == "auto" || text == "streaks") return blinks;
    blinks.blinking = eye::Blinking::kVoluntary;
    const auto times = given_numbers(text, ',');
    blinks.voluntary_s =
        times ? *times : table_of_option("--blink", text, kBlinkWords).column("time_s");
    try {
        check(blinks);
    } catch (const InvalidArgument& error) {
        if (times) throw InvalidArgument("--blink", text, error.what());
        throw FileError(text, error.what());
    }
    return blinks;
}

}  // namespace

void MotionOptions::add_options(CLI::App& command) {
    needs_ = "--time or --fps";
    group_ = command.add_option_group("The eye in motion",
                                      "With " + needs_ + " the pupil, the lens and the lids move");
    moment_option("Moment at which the eye looks; with --fps, of frame 0");
    positive_number(group_->add_option("--fps", fps_,
                                       "Frames per second: each frame has its own moment, by its "
                                       "number"))
        ->type_name("F");
    add_movements();
}

void MotionOptions::add_options_of_a_moment(CLI::App& command) {
    needs_ = "--time";
    group_ = command.add_option_group("The eye in motion",
                                      "With " + needs_ + " the pupil, the lens and the lids move");
    moment_option("Moment at which the eye looks");
    add_movements();
}

void MotionOptions::moment_option(const std::string& description) {
    number(group_->add_option("--time", time_s_, description), -eye::kFarthestTimeS,
           eye::kFarthestTimeS)
        ->type_name("S");
}

void MotionOptions::add_movements() {
    group_
        ->add_option("--motion", motion_,
                     "Turns of head and eye, which the vitreous follows: saccades, or a table with "
                     "time_s, yaw_deg, pitch_deg, roll_deg (CSV)")
        ->type_name("off|saccades|FILE")
        ->capture_default_str();
    group_
        ->add_option("--blink", blink_,
                     "auto: 15 times a minute; streaks: so that lashes move but lids cover "
                     "nothing; moments in seconds (1.5,4), or a table with time_s")
        ->type_name("off|auto|streaks|TIMES|FILE")
        ->capture_default_str();
    number(group_->add_option("--squint", squint_,
                              "How far lids close against 30000 cd/m2, where the luminance is "
                              "known"),
           0, 0.8)
        ->type_name("0..0.8")
        ->capture_default_str();
}

std::string MotionOptions::first_given() const { return app::first_given(*group_); }

bool MotionOptions::given(const std::string& option) const {
    return group_->get_option(option)->count() > 0;
}

void MotionOptions::check() const {
    const std::string option = first_given();
    if (!option.empty() && !alive()) {
        throw InvalidArgument(option + ": is about an eye that moves: needs " + needs_);
    }
}

double MotionOptions::time_s(int frame) const {
    return frame_time_s(frame, fps_, time_s_.value_or(0));
}

double frame_time_s(int frame, std::optional<double> fps, double start_s) {
    const double time_s = start_s + (fps ? frame / *fps : 0.0);
    if (std::abs(time_s) <= eye::kFarthestTimeS) return time_s;
    throw InvalidArgument("--fps", fmt::format("{}", *fps),
                          fmt::format("frame {} would be seen at {:g} s; must be {:g} to {:g} s",
                                      frame, time_s, -eye::kFarthestTimeS, eye::kFarthestTimeS));
}

void MotionOptions::apply(eye::MotionSettings& settings, std::uint64_t seed) const {
    if (motion_ == "saccades") {
        settings.gaze = eye::Gaze::saccades(seed);
    } else if (motion_ != "off") {
        settings.gaze = gaze_from(motion_);
    }
    settings.blinks = blinks_from(blink_);
    settings.squint = squint_;
}

nlohmann::ordered_json MotionOptions::report() const {
    nlohmann::ordered_json json;
    if (fps_) json["fps"] = *fps_;
    json.update({{"motion", motion_}, {"blink", blink_}, {"squint", squint_}});
    return json;
}

}  // namespace aureole::app
