#include "eye_observer.h"

#include <cmath>

#include "aureole/eye/eye_psf.h"
#include "aureole/eye/metering.h"
#include "kernel_file.h"
#include "output_options.h"

namespace aureole::app {
double metered_cd_m2(const io::Picture& picture, double white_luminance_cd_m2) {
    const double stored{picture.float_attribute("aureole:adaptation_cd_m2").value_or(-1.0F)};
    return std::isfinite(stored) && stored >= 0
               ? stored
               : eye::mean_luminance(over_display_window(picture.color(), picture)) *
                     white_luminance_cd_m2;
}

double EyeObserver::adaptation_to(const io::Picture& picture) const {
    if (!options_.needs_adaptation()) return 0;
    if (metering_ == Metering::kFirst && metered_cd_m2_) return *metered_cd_m2_;
    return metered_cd_m2(picture, white_luminance_cd_m2_);
}

bool EyeObserver::adapt(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_.white_luminance(picture);
    const double metered = adaptation_to(picture);
    const bool same = metered_cd_m2_ == metered;
    metered_cd_m2_ = metered;
    return same;
}

std::optional<wave::Psf> EyeObserver::psf(const View& display, const View& data) {
    eye_ = options_.eye(*metered_cd_m2_, display);
    return eye::eye_psf(eye_, wave::KernelGrid::full_reach(data), {}, &session_);
}

void EyeObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    parameters.update(options_.report(eye_, *metered_cd_m2_));
}

View KernelObserver::view_of(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_.white_luminance(picture);
    return view_.view_of(picture, session_);
}

std::optional<wave::Psf> KernelObserver::psf(const View& /*display*/, const View& data) {
    return read_kernel(file_, data);
}

void KernelObserver::report(nlohmann::ordered_json& json) const {
    json["parameters"]["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    json["parameters"]["psf"] = file_;
}

}  // namespace aureole::app
