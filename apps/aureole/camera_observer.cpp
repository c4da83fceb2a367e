#include "camera_observer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/lens/field_starburst.h"
#include "aureole/lens/starburst.h"

namespace aureole::app {
namespace {

constexpr double kSameField = 0.02;  // relative difference that is not worth a word

// What there would be without dropping any ghost.
double flare_energy(const lens::FlareReport& report) {
    double sum = 0;
    for (const lens::GhostReport& ghost : report.ghosts) sum += ghost.energy;
    return sum;
}

}  // namespace

CameraObserver::CameraObserver(const CameraOptions& camera, const GhostOptions& ghosts,
                               const LightOptions& lights, const ViewOptions& view,
                               const CameraSpread& spread, const FieldVaryingOption& field,
                               Session& session)
    : camera_options_(camera),
      ghost_options_(ghosts),
      light_options_(lights),
      view_options_(view),
      spread_(spread),
      field_(field),
      session_(session),
      camera_(camera.camera(session)),
      flare_options_(ghosts.options(camera_.lens)) {
    if (!field_.on()) return;
    if (camera_.iris.is_image()) {
        throw InvalidArgument(
            "--field-varying: cannot be combined with --iris: a picture has no "
            "outline to be seen from off the axis");
    }
    if (camera_.occluder) {
        throw InvalidArgument("--field-varying: cannot be combined with --occluder");
    }
}

View CameraObserver::view_of(const io::Picture& picture) {
    const io::Window& window = picture.display_window();
    const double used_mm = camera_.used_width_mm(window.width, window.height);
    lens_field_deg_ = camera_.field_deg(window.width, window.height);
    const std::string lens =
        fmt::format("{:.4g} mm on {:.4g} mm of sensor", camera_.lens.efl_mm(), used_mm);
    const std::optional<io::FieldOfView> known = view_options_.known_field(picture);
    if (!known) {
        session_.note(
            fmt::format("no field of view given or in the picture: using that of the "
                        "lens, {:.4g} deg ({}; --fov)",
                        lens_field_deg_, lens));
        return view_options_.view_with({lens_field_deg_, "field of view of the lens"}, picture,
                                       session_);
    }
    const View view = view_options_.view_with(*known, picture, session_);
    if (std::abs(known->deg / lens_field_deg_ - 1) > kSameField) {
        const double pictured_mm = camera_.lens.efl_mm() / view.focal_length_px() * window.width;
        session_.note(fmt::format(
            "{} = {:.4g} deg wins over the lens's {:.4g} deg ({}): as on a sensor {:.4g} mm wide, "
            "crop factor {:.3g}",
            known->source, known->deg, lens_field_deg_, lens, pictured_mm, used_mm / pictured_mm));
    }
    return view;
}

Spreading CameraObserver::spreading(const View& /*display*/, const View& data) {
    if (!spread_.starburst) return {};
    const wave::KernelGrid grid = wave::KernelGrid::full_reach(data);
    Spreading result;
    if (spread_.passes != Passes::kBloom) {
        (spread_.passes == Passes::kOne ? result.rest : result.streaks) =
            shared(lens::starburst_psf(camera_.iris, camera_.entrance_pupil_mm(), grid, {},
                                       camera_.dirt(), &session_));
    }
    if (spread_.passes == Passes::kBoth || spread_.passes == Passes::kBloom) {
        result.rest = shared(lens::halation_psf(spread_.halation, camera_.lens.efl_mm(), grid));
    }
    return result;
}

std::optional<wave::VaryingPsf> CameraObserver::varying_psf(const View& /*display*/,
                                                            const View& data) {
    if (!field_.on()) return std::nullopt;
    lens::FieldStarburstOptions options;
    if (field_.spacing_deg() > 0) options.spacing_deg = field_.spacing_deg();
    options.rank = field_.rank();
    wave::VaryingPsf psf = lens::field_starburst(
        camera_.lens, camera_.iris, camera_.entrance_pupil_mm(), data, options, &session_);
    const wave::FieldError error = lens::field_starburst_error(
        camera_.lens, camera_.iris, camera_.entrance_pupil_mm(), psf, options, kHeldOutPositions);
    session_.note(
        fmt::format("stars over the field: {:.1f} % from those of each position", 100 * error.l1));
    field_report_ = FieldVaryingOption::nodes(options.spacing_deg, options.rank, psf, error);
    return psf;
}

void CameraObserver::plan(const View& data) {
    if (!ghost_options_.any()) return;
    flare_.emplace(camera_.lens, camera_.iris, data, flare_options_, camera_.dirt());
    ghosts_ = Image(data.width, data.height, 3);
}

const Image* CameraObserver::ghosts(const io::Picture& picture, const View& display,
                                    const View& data, const float* matte) {
    if (!ghost_options_.any()) return nullptr;
    display_ = display;
    session_.timed("lights", [&] {
        lights_ = light_options_.lights(picture, display, data, matte, session_);
    });
    session_.check_interrupt();
    session_.timed("ghosts", [&] {
        for (int c = 0; c < 3; ++c) std::fill_n(ghosts_.plane(c), ghosts_.pixels(), 0.0F);
        flare_->render(lights_.lights, ghosts_, &session_);
    });
    if (!lights_.lights.empty() && flare_energy(flare_->report()) == 0) {
        session_.note("the lens does not see the light, or all ghosts are off: no ghosts");
    }
    if (!ghost_options_.dump_file().empty()) {
        ghost_options_.dump(camera_options_.lens_name(), camera_.lens, flare_options_,
                            flare_->report());
    }
    return &ghosts_;
}

void CameraObserver::report(nlohmann::ordered_json& json) const {
    auto& parameters = json["parameters"];
    parameters.update(camera_options_.report(camera_));
    parameters["lens_fov_deg"] = lens_field_deg_;
    parameters["starburst"] = spread_.starburst && spread_.passes != Passes::kBloom;
    if (spread_.passes == Passes::kBoth || spread_.passes == Passes::kBloom) {
        parameters["halation"] = spread_.halation.share;
        parameters["halation_layer_mm"] = spread_.halation.layer_mm;
        parameters["halation_index"] = spread_.halation.refractive_index;
        parameters["halation_backing"] = spread_.halation.backing;
    }
    field_.report(parameters);
    if (!field_report_.empty()) json["field_varying"] = field_report_;
    parameters.update(ghost_options_.report(flare_options_));
    if (!ghost_options_.any()) return;
    parameters.update(light_options_.report());
    if (lights_.searched) parameters["light_threshold"] = lights_.search.threshold;
    json["lights"] = report_of(lights_, display_);
    json["ghosts"] = report_of(flare_->report());
}

}  // namespace aureole::app
