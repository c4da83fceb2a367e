#include "display_options.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "aureole/base/error.h"
#include "aureole/color/tone_curve.h"

namespace aureole::app {

void DisplayOptions::add_options(CLI::App& command) {
    CLI::Option_group& group = *command.add_option_group("PNG and JPEG output");
    tone_map_option_ =
        group
            .add_option("--tone-map", tone_map_,
                        "none: clip; narkowicz, hill: fits of ACES; aces: its output transform; "
                        "xyz: keeps hue; ocio: a configuration")
            ->check(CLI::IsMember({"none", "narkowicz", "hill", "aces", "xyz", "ocio"}))
            ->capture_default_str();
    group
        .add_option("--exposure", exposure_ev_,
                    "Stops (default: attribute aureole:exposure_ev, else 0)")
        ->type_name("EV");
    group.add_option("--ocio-config", ocio_.config, "OpenColorIO configuration (default: $OCIO)")
        ->type_name("FILE");
    group.add_option("--ocio-input", ocio_.input_space,
                     "Colour space of the picture (default: role scene_linear)");
    group.add_option("--ocio-display", ocio_.display, "Display (default: the configuration's)");
    group.add_option("--ocio-view", ocio_.view, "View (default: the display's)");
}

void DisplayOptions::prepare(const std::vector<std::string>& outputs) {
    const bool any_display = std::any_of(outputs.begin(), outputs.end(), is_display_file);
    if (!any_display && tone_map_option_->count() > 0) {
        throw InvalidArgument("--tone-map", tone_map_,
                              "applies to PNG and JPEG; EXR, HDR and TIFF are written linear");
    }
    if (!any_display) return;
    if (tone_map_ == "aces") {
        transform_ = std::make_unique<io::DisplayTransform>(io::DisplayTransform::aces());
    } else if (tone_map_ == "ocio") {
        transform_ = std::make_unique<io::DisplayTransform>(io::DisplayTransform::ocio(ocio_));
    }
}

double DisplayOptions::exposure_ev(const io::Picture& picture) const {
    const double ev =
        exposure_ev_.value_or(picture.float_attribute("aureole:exposure_ev").value_or(0.0F));
    if (!std::isfinite(ev) || std::abs(ev) > 100) {
        throw InvalidArgument("exposure (EV)", std::to_string(ev), "must be in [-100, 100]");
    }
    return ev;
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
    return linear.channels == 1 ? copy(encoded.view().channel_range(0, 1)) : encoded;
}

bool is_display_file(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

Image side_by_side(const ConstImageView& before, const ConstImageView& after) {
    constexpr int kLine = 4;  // pixels of white between the two
    Image both(2 * before.width + kLine, before.height, before.channels);
    for (int c = 0; c < before.channels; ++c) {
        for (int y = 0; y < before.height; ++y) {
            float* out = both.row(y, c);
            for (int x = 0; x < before.width; ++x) {
                out[x] = before.at(x, y, c);
                out[before.width + kLine + x] = after.at(x, y, c);
            }
            std::fill(out + before.width, out + before.width + kLine, 1.0F);
        }
    }
    return both;
}

}  // namespace aureole::app
