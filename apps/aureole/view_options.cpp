#include "view_options.h"

#include <fmt/core.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/io/field_of_view.h"

namespace aureole::app {
namespace {

constexpr double kDefaultFovDeg = 60;
constexpr double kDefaultWhiteLuminance = 100;
constexpr double kPerspectiveFromDeg = 40;

}  // namespace

void ViewOptions::add_options(CLI::App& command) {
    command
        .add_option("--fov", fov_deg_,
                    "Horizontal field of view of the picture in degrees (default: from its "
                    "metadata, else 60)")
        ->type_name("DEG");
    command
        .add_option("--perspective", perspective_,
                    "on: pixels of a rectilinear camera; off: equal angles and plain sums; auto: "
                    "on above 40 deg")
        ->check(CLI::IsMember({"auto", "on", "off"}))
        ->capture_default_str();
    command
        .add_option("--white-luminance", white_luminance_cd_m2_,
                    "What pixel value 1 means, in cd/m2 (default: attribute whiteLuminance, else "
                    "100)")
        ->type_name("CD_M2");
}

Projection ViewOptions::projection_for(double fov_deg) const {
    const bool on =
        perspective_ == "on" || (perspective_ == "auto" && fov_deg > kPerspectiveFromDeg);
    return on ? Projection::kPerspective : Projection::kConstantPitch;
}

View ViewOptions::view_of(const io::Picture& picture, Session& session) const {
    double fov_deg = kDefaultFovDeg;
    if (fov_deg_) {
        fov_deg = *fov_deg_;
    } else if (const auto from_file = io::field_of_view(picture)) {
        fov_deg = from_file->deg;
    } else {
        session.note(
            fmt::format("no field of view given or in the picture: assuming {} deg "
                        "(--fov)",
                        kDefaultFovDeg));
    }
    const io::Window display = picture.display_window();
    const io::Window data = picture.data_window();
    View view = View::from_fov(display.width, display.height, fov_deg, projection_for(fov_deg));
    view.axis_x += display.x - data.x;
    view.axis_y += display.y - data.y;
    view.width = data.width;
    view.height = data.height;
    if (picture.pixel_aspect_ratio() != 1) {
        session.note(fmt::format("pixel aspect ratio {}: pixels are treated as square",
                                 picture.pixel_aspect_ratio()));
    }
    return view;
}

View ViewOptions::view_of_size(int width, int height) const {
    const double fov_deg = fov_deg_.value_or(kDefaultFovDeg);
    return View::from_fov(width, height, fov_deg, projection_for(fov_deg));
}

double ViewOptions::white_luminance(const io::Picture& picture) const {
    const double luminance = white_luminance_cd_m2_.value_or(
        picture.float_attribute("whiteLuminance").value_or(kDefaultWhiteLuminance));
    if (!(luminance > 0) || !std::isfinite(luminance)) {
        throw InvalidArgument("white luminance (cd/m2)", std::to_string(luminance),
                              "must be positive");
    }
    return luminance;
}

}  // namespace aureole::app
