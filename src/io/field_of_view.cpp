#include "aureole/io/field_of_view.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::io {
namespace {

// Half the width over the distance.
std::optional<double> angle_deg(double half_width) {
    if (!(half_width > 0) || !std::isfinite(half_width)) return std::nullopt;
    return deg_from_rad(2 * std::atan(half_width));
}

}  // namespace

std::optional<FieldOfView> field_of_view(const Picture& picture) {
    const char* const own = "aureole:fov_deg";
    if (const auto deg = picture.float_attribute(own)) {
        if (*deg > 0 && *deg < 360) return FieldOfView{double{*deg}, own};
    }
    const char* const screen = "screenWindowWidth";
    if (const auto width = picture.float_attribute(screen)) {
        const auto deg = angle_deg(double{*width} / 2);
        if (deg && *width != 1.0F) return FieldOfView{*deg, screen};
    }
    // The 36 mm of the equivalent frame are its long side, which is upright in a portrait.
    const char* const exif = "Exif:FocalLengthIn35mmFilm";
    if (const auto focal_mm = picture.float_attribute(exif)) {
        const Window& window = picture.display_window();
        const double long_side = std::max(window.width, window.height);
        const auto deg = angle_deg(18 / double{*focal_mm} * window.width / long_side);
        if (deg && *focal_mm > 0) return FieldOfView{*deg, exif};
    }
    return std::nullopt;
}

}  // namespace aureole::io
