#include "gallery_panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "aureole/eye/pupil.h"

namespace aureole::app {
namespace {

// 8-bit display values, scaled in linear light so that the largest is `largest`.
color::Rgb named(const std::array<double, 3>& display, double largest) {
    color::Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] = double{color::srgb_decode(static_cast<float>(display[c] / 255))};
    }
    const double scale = largest / *std::max_element(rgb.begin(), rgb.end());
    for (double& value : rgb) value *= scale;
    return rgb;
}

nlohmann::ordered_json lights_json(const color::Rgb& ground_cd_m2,
                                   const std::vector<scene::DiscLight>& discs,
                                   const std::vector<scene::PointLight>& points) {
    nlohmann::ordered_json json;
    json["ground_rgb_cd_m2"] = ground_cd_m2;
    for (const auto& disc : discs) {
        json["discs"].push_back({{"x_deg", disc.x_deg},
                                 {"y_deg", disc.y_deg},
                                 {"diameter_deg", disc.diameter_deg},
                                 {"rgb_cd_m2", disc.rgb_cd_m2}});
    }
    for (const auto& point : points) {
        json["points"].push_back({{"x_deg", point.x_deg},
                                  {"y_deg", point.y_deg},
                                  {"illuminance_lx", color::luminance(point.illuminance_lx)}});
    }
    return json;
}

}  // namespace

View panel_view(const PanelSize& size, double fov_deg) {
    return View::from_fov(size.width, size.height, fov_deg, Projection::kPerspective);
}

eye::Eye adapted_eye(double adaptation_cd_m2) {
    eye::Eye eye;
    eye.pupil_diameter_mm = eye::pupil_diameter_mm(eye::PupilModel::kWatsonYellott,
                                                   adaptation_cd_m2, {.age_years = eye.age_years});
    return eye;
}

eye::LivingEye living_eye(double adaptation_cd_m2, eye::MotionSettings settings) {
    settings.pupil_conditions.age_years = eye::Eye().age_years;
    return {eye::Eye(), std::move(settings), eye::LuminanceCurve(adaptation_cd_m2)};
}

Panel lights_panel(const std::string& label, const View& view, const color::Rgb& ground_cd_m2,
                   const std::vector<scene::DiscLight>& discs,
                   const std::vector<scene::PointLight>& points) {
    Panel panel;
    panel.label = label;
    panel.view = view;
    panel.scene = lights_json(ground_cd_m2, discs, points);
    panel.draw = [=] { return scene::lights_on_ground(view, ground_cd_m2, discs, points); };
    return panel;
}

Panel without_glare(Panel panel, const std::string& label) {
    panel.label = label;
    panel.glare = false;
    return panel;
}

Panel with_preset(Panel panel, const std::string& preset, const std::string& label) {
    panel.label = label;
    panel.preset = preset;
    return panel;
}

Panel with_lids(Panel panel, double closure, const std::string& label) {
    panel.label = label;
    const double open = eye::open_share(panel.eye);
    panel.eye.eyelid = closure;
    panel.light_share = eye::open_share(panel.eye) / open;
    return panel;
}

Panel at_moment(Panel panel, const eye::Moment& moment, const std::string& label) {
    panel.label = label;
    panel.eye = moment.eye;
    panel.light_share = moment.light_share;
    return panel;
}

color::Rgb grey(double cd_m2) { return {cd_m2, cd_m2, cd_m2}; }
color::Rgb azure(double largest) { return named({0, 127, 255}, largest); }
color::Rgb orange(double largest) { return named({255, 127, 0}, largest); }
color::Rgb apple_green(double largest) { return named({141, 182, 0}, largest); }

color::Rgb hue(double degrees, double largest) {
    std::array<double, 3> display{};
    for (std::size_t c = 0; c < 3; ++c) {
        // Each primary is full within 60 deg of its own hue and gone beyond 120 deg.
        const double off = std::abs(std::remainder(degrees - 120.0 * static_cast<double>(c), 360));
        display[c] = 255 * std::clamp(2 - off / 60, 0.0, 1.0);
    }
    return named(display, largest);
}

}  // namespace aureole::app
