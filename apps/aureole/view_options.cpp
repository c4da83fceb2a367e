#include "view_options.h"

#include <fmt/core.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/io/field_of_view.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr double kDefaultFovDeg = 60;
constexpr float kDefaultWhiteLuminance = 100;
constexpr double kPerspectiveFromDeg = 40;

}  // namespace

void ViewOptions::add_options(CLI::App& command) {
    number(command.add_option("--fov", fov_deg_,
                              "Horizontal field of view of the picture in degrees (default: from "
                              "the picture's metadata, else 60)"))
        ->type_name("DEG");
    one_of(command.add_option("--perspective", perspective_,
                              "on: pixels of a rectilinear camera; off: equal angles and plain "
                              "sums; auto: on above 40 deg"),
           {"auto", "on", "off"})
        ->capture_default_str();
}

void ViewOptions::add_white_luminance_option(CLI::App& command) {
    positive_number(command.add_option("--white-luminance", white_luminance_cd_m2_,
                                       "What pixel value 1 means, in cd/m2 (default: attribute "
                                       "whiteLuminance, else 100)"))
        ->type_name("CD_M2");
}

Projection ViewOptions::projection_for(double fov_deg, const std::string& source) const {
    const bool on =
        perspective_ == "on" || (perspective_ == "auto" && fov_deg > kPerspectiveFromDeg);
    if (on && !(fov_deg > 0 && fov_deg < 180)) {
        throw InvalidArgument(source, fmt::format("{}", fov_deg),
                              "must be above 0 and below 180 deg in perspective (up to 360 with "
                              "--perspective off)");
    }
    if (!(fov_deg > 0 && fov_deg <= 360)) {
        throw InvalidArgument(source, fmt::format("{}", fov_deg),
                              "must be above 0, and at most 360 deg");
    }
    return on ? Projection::kPerspective : Projection::kConstantPitch;
}

void ViewOptions::check() const {
    if (fov_deg_) projection_for(*fov_deg_, "--fov");
}

View ViewOptions::view_of(const io::Picture& picture, Session& session) const {
    double fov_deg = kDefaultFovDeg;
    std::string source = "--fov";
    if (fov_deg_) {
        fov_deg = *fov_deg_;
    } else if (const auto from_file = io::field_of_view(picture)) {
        fov_deg = from_file->deg;
        source = "field of view in the picture's attribute " + from_file->source;
    } else {
        session.note(
            fmt::format("no field of view given or in the picture: assuming {} deg "
                        "(--fov)",
                        kDefaultFovDeg));
    }
    if (picture.pixel_aspect_ratio() != 1) {
        session.note(fmt::format("pixel aspect ratio {}: pixels are treated as square",
                                 picture.pixel_aspect_ratio()));
    }
    const io::Window& display = picture.display_window();
    return View::from_fov(display.width, display.height, fov_deg, projection_for(fov_deg, source));
}

View ViewOptions::view_of_size(int width, int height) const {
    const double fov_deg = fov_deg_.value_or(kDefaultFovDeg);
    return View::from_fov(width, height, fov_deg, projection_for(fov_deg, "--fov"));
}

double ViewOptions::white_luminance(const io::Picture& picture) const {
    if (white_luminance_cd_m2_) return *white_luminance_cd_m2_;
    const float stored = picture.float_attribute("whiteLuminance").value_or(kDefaultWhiteLuminance);
    return double{std::isfinite(stored) && stored > 0 ? stored : kDefaultWhiteLuminance};
}

View data_view(const View& display, const io::Picture& picture) {
    const io::Window data = picture.data_window();
    View view = display;
    view.axis_x += picture.display_window().x - data.x;
    view.axis_y += picture.display_window().y - data.y;
    view.width = data.width;
    view.height = data.height;
    return view;
}

}  // namespace aureole::app
