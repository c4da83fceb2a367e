#include "view_options.h"

#include <fmt/core.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr float kDefaultWhiteLuminance = 100;
constexpr double kPerspectiveFromDeg = 40;

}  // namespace

void ViewOptions::add_options(CLI::App& command, const std::string& otherwise) {
    number(command.add_option("--fov", fov_deg_,
                              "Horizontal field of view of the picture in degrees (default: from "
                              "the picture's metadata, else " +
                                  otherwise + ")"))
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
                                       "whiteLuminance, else 100)"),
                    eye::kBrightestCdM2)
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

std::optional<io::FieldOfView> ViewOptions::known_field(const io::Picture& picture) const {
    if (fov_deg_) return io::FieldOfView{*fov_deg_, "--fov"};
    std::optional<io::FieldOfView> field = io::field_of_view(picture);
    if (field) field->source = "field of view in the picture's attribute " + field->source;
    return field;
}

View ViewOptions::view_with(const io::FieldOfView& field, const io::Picture& picture,
                            Session& session) const {
    if (picture.pixel_aspect_ratio() != 1) {
        session.note(fmt::format("pixel aspect ratio {}: pixels are treated as square",
                                 picture.pixel_aspect_ratio()));
    }
    const io::Window& display = picture.display_window();
    return View::from_fov(display.width, display.height, field.deg,
                          projection_for(field.deg, field.source));
}

View ViewOptions::view_of(const io::Picture& picture, Session& session) const {
    const std::optional<io::FieldOfView> known = known_field(picture);
    if (!known) {
        session.note(
            fmt::format("no field of view given or in the picture: assuming {} deg "
                        "(--fov)",
                        kDefaultFovDeg));
    }
    return view_with(known.value_or(io::FieldOfView{kDefaultFovDeg, "--fov"}), picture, session);
}

View ViewOptions::view_of_size(int width, int height, double otherwise_deg) const {
    const double fov_deg = fov_deg_.value_or(otherwise_deg);
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
