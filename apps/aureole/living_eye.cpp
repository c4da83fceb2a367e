#include "living_eye.h"

#include <fmt/format.h>

#include "aureole/base/error.h"
#include "number_table.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

eye::LuminanceCurve curve_from(const std::string& file) {
    const NumberTable table = table_of_option("--adaptation", file, "auto, a number of cd/m2");
    try {
        return {table.column("time_s"), table.column("adaptation_cd_m2")};
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
}

}  // namespace

void check_eye(const EyeOptions& eye, const MotionOptions& motion) {
    motion.check();
    const std::string table = eye.adaptation_file();
    refuse(table.empty() || motion.alive() ? "" : "--adaptation " + table,
           "is a table over time: needs " + motion.needs());
    eye.check(motion.squints());
    if (motion.blink_word() != "streaks") return;
    refuse(eye.eyelashes() > 0 ? "" : "--blink streaks",
           "moves nothing but lashes: leave out --eyelashes 0");
    refuse(eye.streaks() > 0 ? "" : "--blink streaks",
           "moves nothing but lashes: leave out --streaks 0");
}

LivingEye::LivingEye(const EyeOptions& eye, const MotionOptions& motion, Session& session)
    : options_(eye), motion_(motion), session_(session) {
    motion_.apply(settings_, options_.seed());
    if (motion_.has_rate() && options_.meters()) settings_.squint = 0;
    if (!options_.adaptation_file().empty()) adaptation_ = curve_from(options_.adaptation_file());
    // What can be wrong with the settings is found before any picture is read.
    constexpr double kAnyLuminance = 1;
    living_for(kAnyLuminance, View::from_fov(16, 9, 60, Projection::kPerspective));
}

bool LivingEye::meters() const {
    return options_.needs_adaptation() || (options_.meters() && settings_.squint > 0);
}

const eye::LivingEye& LivingEye::living_for(double metered_cd_m2, const View& view) {
    const double luminance_cd_m2 = options_.adaptation_cd_m2(metered_cd_m2);
    if (built_ && built_->view == view &&
        (adaptation_ || built_->luminance_cd_m2 == luminance_cd_m2)) {
        return built_->eye;
    }
    const auto curve = adaptation_.value_or(eye::LuminanceCurve(luminance_cd_m2));
    options_.apply_pupil(settings_, view);
    const eye::Eye rest = options_.eye(luminance_cd_m2, view);
    built_.emplace(Built{view, luminance_cd_m2, eye::LivingEye(rest, settings_, curve)});
    return built_->eye;
}

// Both tables hold on at their ends; who renders beyond them may not know.
void LivingEye::note_ends(double time_s) {
    constexpr double kRoundingS = 1e-3;  // tables may be rounded
    const auto note = [&](const std::vector<double>& times_s, const std::string& table,
                          const std::string& what) {
        if (times_s.empty()) return;
        if (time_s < times_s.front() - kRoundingS) {
            session_.note(fmt::format("{} begins at {:g} s: before that its first {} holds", table,
                                      times_s.front(), what));
        }
        if (time_s > times_s.back() + kRoundingS) {
            session_.note(fmt::format("{} ends at {:g} s: after that its last {} holds", table,
                                      times_s.back(), what));
        }
    };
    if (adaptation_) note(adaptation_->times_s(), options_.adaptation_file(), "luminance");
    note(settings_.gaze.times_s(), motion_.motion_word(), "direction");
}

eye::Moment LivingEye::at(double time_s, double metered_cd_m2, const View& view) {
    note_ends(time_s);
    time_s_ = time_s;
    moment_ = living_for(metered_cd_m2, view).at(time_s);
    return moment_;
}

nlohmann::ordered_json LivingEye::report() const {
    nlohmann::ordered_json parameters = options_.report(moment_.eye, moment_.adaptation_cd_m2);
    parameters.update(motion_.report());
    parameters["squint"] = settings_.squint;
    if (settings_.squint > 0) parameters["adaptation_cd_m2"] = moment_.adaptation_cd_m2;
    parameters.update({{"time_s", time_s_},
                       {"mean_pupil_mm", moment_.mean_pupil_mm},
                       {"accommodation_d", moment_.accommodation_d},
                       {"vitreous_yaw_deg", moment_.eye.pose.vitreous_yaw_deg},
                       {"vitreous_pitch_deg", moment_.eye.pose.vitreous_pitch_deg},
                       {"vitreous_roll_deg", moment_.eye.pose.vitreous_roll_deg},
                       {"light_share", moment_.light_share}});
    return parameters;
}

}  // namespace aureole::app
