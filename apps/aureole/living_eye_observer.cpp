#include "living_eye_observer.h"

#include "aureole/base/error.h"
#include "eye_observer.h"
#include "number_table.h"

namespace aureole::app {
namespace {

eye::LuminanceCurve curve_from(const std::string& file) {
    const NumberTable table(file);
    try {
        return {table.column("time_s"), table.column("adaptation_cd_m2")};
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
}

}  // namespace

LivingEyeObserver::LivingEyeObserver(const EyeOptions& eye, const MotionOptions& motion,
                                     const ViewOptions& view, Passes passes, Session& session)
    : options_(eye), motion_(motion), view_options_(view), passes_(passes), session_(session) {
    motion_.apply(settings_, options_.seed());
    if (!options_.adaptation_file().empty()) adaptation_ = curve_from(options_.adaptation_file());
    // What can be wrong with the settings is found before any picture is read.
    constexpr double kAnyLuminance = 1;
    const View any = View::from_fov(16, 9, 60, Projection::kPerspective);
    eye::LivingEye(options_.eye(kAnyLuminance, any), settings_, eye::LuminanceCurve(kAnyLuminance));
}

View LivingEyeObserver::view_of(const io::Picture& picture) {
    view_ = view_options_.view_of(picture, session_);
    return view_;
}

bool LivingEyeObserver::adapt(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_options_.white_luminance(picture);
    const double metered =
        options_.needs_adaptation() ? metered_cd_m2(picture, white_luminance_cd_m2_) : 0;
    const eye::LuminanceCurve curve =
        adaptation_.value_or(eye::LuminanceCurve(options_.adaptation_cd_m2(metered)));
    options_.apply_pupil(settings_, view_);
    const eye::LivingEye living(options_.eye(curve.at(time_s_), view_), settings_, curve);
    moment_ = living.at(time_s_);
    return false;
}

Spreading LivingEyeObserver::spreading(const View& /*display*/, const View& data) {
    if (moment_.closed) return {};
    return spreading_of(moment_.eye, passes_, data, options_.sampling(), session_);
}

void LivingEyeObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    parameters.update(options_.report(moment_.eye, moment_.adaptation_cd_m2));
    parameters.update(motion_.report());
    parameters.update({{"time_s", time_s_},
                       {"mean_pupil_mm", moment_.mean_pupil_mm},
                       {"accommodation_d", moment_.accommodation_d},
                       {"vitreous_yaw_deg", moment_.eye.pose.vitreous_yaw_deg},
                       {"vitreous_pitch_deg", moment_.eye.pose.vitreous_pitch_deg},
                       {"vitreous_roll_deg", moment_.eye.pose.vitreous_roll_deg},
                       {"light_share", moment_.light_share}});
}

}  // namespace aureole::app
