#include "display_options.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/color/antialias.h"
#include "aureole/color/tone_curve.h"
#include "option_checks.h"
#include "output_options.h"

namespace aureole::app {
namespace {

constexpr double kMostStops = 100;

}  // namespace

void DisplayOptions::add_options(CLI::App& command) {
    CLI::Option_group& group = *command.add_option_group("PNG and JPEG output");
    tone_map_option_ =
        one_of(
            group.add_option("--tone-map", tone_map_,
                             "none: clip; narkowicz, hill, unity: fits of ACES; aces: its output "
                             "transform; xyz: keeps hue; ocio: a configuration"),
            {"none", "narkowicz", "hill", "aces", "xyz", "unity", "ocio"})
            ->capture_default_str();
    number(group.add_option("--exposure", exposure_ev_,
                            "Stops (default: attribute aureole:exposure_ev, else 0)"),
           -kMostStops, kMostStops)
        ->type_name("EV");
    antialias_option_ =
        one_of(group.add_option("--antialias", antialias_,
                                "edges: blurs along jagged edges of the finished picture, for "
                                "renderings with one sample per pixel"),
               {"none", "edges"})
            ->capture_default_str();
    ocio_options_ = {
        group
            .add_option("--ocio-config", ocio_.config, "OpenColorIO configuration (default: $OCIO)")
            ->type_name("FILE"),
        group
            .add_option("--ocio-input", ocio_.input_space,
                        "Colour space of the picture (default: role scene_linear)")
            ->type_name("NAME"),
        group.add_option("--ocio-display", ocio_.display, "Display (default: the configuration's)")
            ->type_name("NAME"),
        group.add_option("--ocio-view", ocio_.view, "View (default: the display's)")
            ->type_name("NAME")};
}

void DisplayOptions::prepare(const std::vector<std::string>& outputs) {
    const bool any_display = std::any_of(outputs.begin(), outputs.end(), is_display_file);
    for (const CLI::Option* option : {tone_map_option_, antialias_option_}) {
        if (any_display || option->count() == 0) continue;
        throw InvalidArgument(option->get_name(), option->results().front(),
                              "applies to PNG and JPEG; EXR, HDR and TIFF are written linear");
    }
    for (const CLI::Option* option : ocio_options_) {
        if (option->count() > 0 && tone_map_ != "ocio") {
            throw InvalidArgument(option->get_name(), option->results().front(),
                                  "needs --tone-map ocio");
        }
    }
    if (!any_display) return;
    if (tone_map_ == "aces") {
        transform_ = std::make_unique<io::DisplayTransform>(io::DisplayTransform::aces());
    } else if (tone_map_ == "ocio") {
        transform_ = std::make_unique<io::DisplayTransform>(io::DisplayTransform::ocio(ocio_));
    }
}

double DisplayOptions::exposure_ev(const io::Picture& picture) const {
    if (exposure_ev_) return *exposure_ev_;
    const double stored{picture.float_attribute("aureole:exposure_ev").value_or(0.0F)};
    return std::abs(stored) <= kMostStops ? stored : 0;
}

Image DisplayOptions::encode(const ConstImageView& linear, double exposure_ev) const {
    ConstImageView rgb = linear;
    if (linear.channels == 1) {  // grey: the same plane three times
        rgb.channels = 3;
        rgb.channel_stride = 0;
    }
    const auto scale = static_cast<float>(std::exp2(exposure_ev));
    Image encoded(linear.width, linear.height, 3);
    if (transform_) {
        transform_->apply(rgb, encoded, scale);
    } else {
        color::tone_map_to_srgb(color::tone_curve_from_name(tone_map_), scale, rgb, encoded);
    }
    if (antialias_ == "edges") {
        Image smooth(encoded.width(), encoded.height(), 3);
        color::antialias_edges(encoded, smooth);
        encoded = std::move(smooth);
    }
    return linear.channels == 1 ? copy(encoded.view().channel_range(0, 1)) : encoded;
}

}  // namespace aureole::app
