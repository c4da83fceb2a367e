#include "living_eye.h"

#include "aureole/base/error.h"
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

LivingEye::LivingEye(const EyeOptions& eye, const MotionOptions& motion)
    : options_(eye), motion_(motion) {
    motion_.apply(settings_, options_.seed());
    if (!options_.adaptation_file().empty()) adaptation_ = curve_from(options_.adaptation_file());
    // What can be wrong with the settings is found before any picture is read.
    constexpr double kAnyLuminance = 1;
    const View any = View::from_fov(16, 9, 60, Projection::kPerspective);
    eye::LivingEye(options_.eye(kAnyLuminance, any), settings_, eye::LuminanceCurve(kAnyLuminance));
}

eye::Moment LivingEye::at(double time_s, double metered_cd_m2, const View& view) {
    const eye::LuminanceCurve curve =
        adaptation_.value_or(eye::LuminanceCurve(options_.adaptation_cd_m2(metered_cd_m2)));
    options_.apply_pupil(settings_, view);
    const eye::LivingEye living(options_.eye(curve.at(time_s), view), settings_, curve);
    time_s_ = time_s;
    moment_ = living.at(time_s);
    return moment_;
}

nlohmann::ordered_json LivingEye::report() const {
    nlohmann::ordered_json parameters = options_.report(moment_.eye, moment_.adaptation_cd_m2);
    parameters.update(motion_.report());
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
