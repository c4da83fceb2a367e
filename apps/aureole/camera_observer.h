// A camera as an observer: iris and film spread light, the lens adds ghosts.
#pragma once

#include <optional>

#include "aureole/lens/flare.h"
#include "aureole/lens/halation.h"
#include "camera_options.h"
#include "field_varying_option.h"
#include "ghost_options.h"
#include "light_options.h"
#include "observer.h"
#include "session.h"
#include "spread_options.h"
#include "view_options.h"

namespace aureole::app {

// What of the camera spreads light: the iris makes streaks, the film blooms.
struct CameraSpread {
    bool starburst = true;  // false: nothing does
    Passes passes = Passes::kOne;
    lens::HalationOptions halation;  // where passes ask for bloom
};

class CameraObserver : public Observer {
  public:
    // Loads lens, iris and all other files of the options: throws InvalidArgument, FileError.
    CameraObserver(const CameraOptions& camera, const GhostOptions& ghosts,
                   const LightOptions& lights, const ViewOptions& view, const CameraSpread& spread,
                   const FieldVaryingOption& field, Session& session);

    View view_of(const io::Picture& picture) override;
    Spreading spreading(const View& display, const View& data) override;
    std::optional<wave::VaryingPsf> varying_psf(const View& display, const View& data) override;
    void plan(const View& data) override;
    // Writes --dump-ghosts too.
    const Image* ghosts(const io::Picture& picture, const View& display, const View& data,
                        const float* matte) override;
    void report(nlohmann::ordered_json& json) const override;

  private:
    const CameraOptions& camera_options_;
    const GhostOptions& ghost_options_;
    const LightOptions& light_options_;
    const ViewOptions& view_options_;
    CameraSpread spread_;
    const FieldVaryingOption& field_;
    Session& session_;
    Camera camera_;
    lens::FlareOptions flare_options_;
    std::optional<lens::Flare> flare_;
    Image ghosts_;
    // Of the last picture, for the report.
    PictureLights lights_;
    View display_;
    double lens_field_deg_ = 0;
    nlohmann::ordered_json field_report_;
};

}  // namespace aureole::app
