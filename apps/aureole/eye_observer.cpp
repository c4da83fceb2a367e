#include "eye_observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/field_error.h"
#include "aureole/eye/field_needles.h"
#include "aureole/eye/field_psf.h"
#include "aureole/eye/metering.h"
#include "aureole/eye/ranges.h"
#include "kernel_file.h"
#include "output_options.h"

namespace aureole::app {

double metered_cd_m2(const io::Picture& picture, double white_luminance_cd_m2) {
    const double stored{picture.float_attribute("aureole:adaptation_cd_m2").value_or(-1.0F)};
    const double seen = std::isfinite(stored) && stored >= 0
                            ? stored
                            : eye::mean_luminance(over_display_window(picture.color(), picture)) *
                                  white_luminance_cd_m2;
    return std::min(seen, eye::kBrightestCdM2);
}

Spreading spreading_of(const eye::Eye& eye, Passes passes, const View& data,
                       const eye::SpectralSampling& sampling, Session& session) {
    const wave::KernelGrid grid = wave::KernelGrid::full_reach(data);
    eye::EyePsfOptions options;
    options.spectral = sampling;
    Spreading result;
    if (passes == Passes::kBoth || passes == Passes::kStreaks) {
        result.streaks = shared(eye::streaks_psf(eye, grid, options, &session));
    }
    if (passes == Passes::kStreaks) return result;
    eye::Eye behind_lashes = eye;
    if (passes != Passes::kOne) behind_lashes.streaks = 0;
    result.rest = shared(eye::eye_psf(behind_lashes, grid, options, &session));
    return result;
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

Spreading EyeObserver::spreading(const View& display, const View& data) {
    eye_ = options_.eye(*metered_cd_m2_, display);
    return spreading_of(eye_, passes_, data, options_.sampling(), session_);
}

std::optional<wave::VaryingPsf> EyeObserver::varying_psf(const View& display, const View& data) {
    if (!field_.on()) return std::nullopt;
    eye_ = options_.eye(*metered_cd_m2_, display);
    eye::FieldPsfOptions options;
    options.psf.spectral = options_.sampling();
    wave::VaryingPsf psf;
    if (field_.streaks()) {
        if (field_.spacing_deg() > 0) options.spacing_deg = field_.spacing_deg();
        options.rank = field_.rank();
        psf = eye::eye_field_psf(eye_, data, options, &session_);
        measure_field(psf, options);
    } else {
        psf.view = data;
        psf.base = eye::eye_psf(eye_, wave::KernelGrid::full_reach(data), options.psf, &session_);
    }
    if (field_.needles()) {
        eye::FieldNeedlesOptions needles;
        needles.psf = options.psf;
        eye::vary_needles(psf, eye_, needles, &session_);
    }
    return psf;
}

// The blend against streaks computed for positions of their own.
void EyeObserver::measure_field(const wave::VaryingPsf& psf, const eye::FieldPsfOptions& options) {
    const wave::FieldError error = eye::field_error(eye_, psf, options.psf, kHeldOutPositions);
    session_.note(fmt::format("streaks over the field: {:.1f} % from those of each position",
                              100 * error.l1));
    field_report_ = FieldVaryingOption::nodes(options.spacing_deg, options.rank, psf, error);
}

void EyeObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    parameters.update(options_.report(eye_, *metered_cd_m2_));
    field_.report(parameters);
    if (!field_report_.empty()) json["field_varying"] = field_report_;
}

View KernelObserver::view_of(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_.white_luminance(picture);
    return view_.view_of(picture, session_);
}

Spreading KernelObserver::spreading(const View& /*display*/, const View& data) {
    return {.streaks = nullptr, .rest = shared(read_kernel(file_, data))};
}

void KernelObserver::report(nlohmann::ordered_json& json) const {
    json["parameters"]["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    json["parameters"]["psf"] = file_;
}

}  // namespace aureole::app
