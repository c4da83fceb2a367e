#include "living_eye_observer.h"

#include "eye_observer.h"

namespace aureole::app {

View LivingEyeObserver::view_of(const io::Picture& picture) {
    view_ = view_options_.view_of(picture, session_);
    return view_;
}

bool LivingEyeObserver::adapt(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_options_.white_luminance(picture);
    const double metered = living_.meters() ? metered_cd_m2(picture, white_luminance_cd_m2_) : 0;
    moment_ = living_.at(time_s_, metered, view_);
    return false;
}

Spreading LivingEyeObserver::spreading(const View& /*display*/, const View& data) {
    if (book_) {
        const auto grid = wave::KernelGrid::full_reach(data);
        return {.streaks = nullptr,
                .rest = book_->psf(moment_.eye, options_.sampling(), grid, session_)};
    }
    return spreading_of(moment_.eye, passes_, data, options_.sampling(), session_);
}

void LivingEyeObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    parameters.update(living_.report());
    if (book_) parameters["book"] = book_->path();
}

}  // namespace aureole::app
