#include "eye_observer.h"

#include <algorithm>
#include <cmath>

#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "kernel_file.h"
#include "output_options.h"

namespace aureole::app {
namespace {

// The mean luminance of what is meant to be seen, in units of the picture.
double mean_luminance(const io::Picture& picture) {
    const Image seen = over_display_window(picture.color(), picture);
    double sum = 0;
    for (int y = 0; y < seen.height(); ++y) {
        for (int x = 0; x < seen.width(); ++x) {
            const double value =
                seen.channels() == 3
                    ? color::luminance({seen.at(x, y, 0), seen.at(x, y, 1), seen.at(x, y, 2)})
                    : seen.at(x, y, 0);
            sum += std::max(value, 0.0);
        }
    }
    return sum / static_cast<double>(seen.pixels());
}

}  // namespace

double EyeObserver::metered_cd_m2(const io::Picture& picture) const {
    if (!options_.needs_adaptation()) return 0;
    if (metering_ == Metering::kFirst && metered_cd_m2_) return *metered_cd_m2_;
    const double stored{picture.float_attribute("aureole:adaptation_cd_m2").value_or(-1.0F)};
    return std::isfinite(stored) && stored >= 0
               ? stored
               : mean_luminance(picture) * view_.white_luminance(picture);
}

bool EyeObserver::adapt(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_.white_luminance(picture);
    const double metered = metered_cd_m2(picture);
    const bool same = metered_cd_m2_ == metered;
    metered_cd_m2_ = metered;
    return same;
}

std::optional<wave::Psf> EyeObserver::psf(const View& display, const View& data) {
    eye_ = options_.eye(*metered_cd_m2_, display);
    eye::EyePsfOptions options;
    options.spectral = options_.sampling();
    return eye::eye_psf(eye_, wave::KernelGrid::full_reach(data), options, &session_);
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
