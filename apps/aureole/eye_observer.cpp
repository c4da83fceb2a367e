#include "eye_observer.h"

#include <cmath>

#include "aureole/base/random.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/field_psf.h"
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

Spreading spreading_of(const eye::Eye& eye, Passes passes, const View& data,
                       const eye::SpectralSampling& sampling, Session& session) {
    const wave::KernelGrid grid = wave::KernelGrid::full_reach(data);
    eye::EyePsfOptions options;
    options.spectral = sampling;
    Spreading result;
    if (passes == Passes::kBoth || passes == Passes::kStreaks) {
        result.streaks = eye::streaks_psf(eye, grid, options, &session);
    }
    if (passes == Passes::kStreaks) return result;
    eye::Eye behind_lashes = eye;
    if (passes != Passes::kOne) behind_lashes.streaks = 0;
    result.rest = eye::eye_psf(behind_lashes, grid, options, &session);
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
    if (field_spacing_deg_ == 0) return std::nullopt;
    eye_ = options_.eye(*metered_cd_m2_, display);
    eye::FieldPsfOptions options;
    options.psf.spectral = options_.sampling();
    options.spacing_deg = field_spacing_deg_;
    wave::VaryingPsf psf = eye::eye_field_psf(eye_, data, options, &session_);
    measure_field(psf, options.psf);
    return psf;
}

// The blend against streaks computed for positions of their own.
void EyeObserver::measure_field(const wave::VaryingPsf& psf, const eye::EyePsfOptions& options) {
    constexpr int kPositions = 16;
    Random random(1, 0);
    double difference = 0;
    double energy = 0;
    // Streaks have ended 11 deg from their light.
    wave::KernelGrid grid = psf.base.grid;
    const int side = 2 * static_cast<int>(0.2 * psf.view.focal_length_px()) + 1;
    grid.width = std::min(grid.width, side);
    grid.height = std::min(grid.height, side);
    std::size_t kernels = 0;
    for (const auto& part : psf.parts) kernels += part.halves.size();
    for (int i = 0; i < kPositions; ++i) {
        const int x = static_cast<int>(random.uniform() * psf.view.width);
        const int y = static_cast<int>(random.uniform() * psf.view.height);
        const Image truth =
            eye::streaks_at(eye_, eye::field_position(psf.view, x + 0.5, y + 0.5), grid, options);
        const Image blend = fourier::kernel_at(psf.parts, psf.view.width, psf.view.height, x, y);
        const int dx = (truth.width() - blend.width()) / 2;
        const int dy = (truth.height() - blend.height()) / 2;
        for (int c = 0; c < 3; ++c) {
            for (int ky = 0; ky < truth.height(); ++ky) {
                for (int kx = 0; kx < truth.width(); ++kx) {
                    const int bx = kx - dx;
                    const int by = ky - dy;
                    const bool held =
                        bx >= 0 && by >= 0 && bx < blend.width() && by < blend.height();
                    const auto value = static_cast<double>(truth.at(kx, ky, c));
                    difference +=
                        std::abs((held ? static_cast<double>(blend.at(bx, by, c)) : 0.0) - value);
                    energy += value;
                }
            }
        }
    }
    field_report_ = {{"spacing_deg", field_spacing_deg_},
                     {"kernels", kernels},
                     {"bytes", fourier::bytes(psf.parts)},
                     {"held_out_positions", kPositions},
                     {"error", energy > 0 ? difference / energy : 0.0}};
}

void EyeObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    parameters.update(options_.report(eye_, *metered_cd_m2_));
    parameters["field_varying"] = field_spacing_deg_ != 0;
    if (!field_report_.empty()) json["field_varying"] = field_report_;
}

View KernelObserver::view_of(const io::Picture& picture) {
    white_luminance_cd_m2_ = view_.white_luminance(picture);
    return view_.view_of(picture, session_);
}

Spreading KernelObserver::spreading(const View& /*display*/, const View& data) {
    return {.streaks = std::nullopt, .rest = read_kernel(file_, data)};
}

void KernelObserver::report(nlohmann::ordered_json& json) const {
    json["parameters"]["white_luminance_cd_m2"] = white_luminance_cd_m2_;
    json["parameters"]["psf"] = file_;
}

}  // namespace aureole::app
