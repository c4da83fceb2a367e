// Water, a candle, a sunset.
#include <fmt/format.h>

#include "gallery_panels.h"

namespace aureole::app {
namespace {

// The lamp nearest to a flame: glowing soot is a black body at about 1900 K, tungsten one at 2856
// K.
constexpr color::Illuminant kFlame = color::Illuminant::kTungsten;

// A scene as a panel; exposed and adapted to what the scene says of itself. `make`: View -> Scene.
template <class Make>
Panel scene_panel(const std::string& label, const PanelSize& size, double fov_deg,
                  const Make& make) {
    Panel panel;
    panel.label = label;
    panel.view = panel_view(size, fov_deg);
    const scene::Scene small = make(panel_view({32, 18}, fov_deg));
    panel.white_cd_m2 = small.display_white_cd_m2;
    panel.eye = adapted_eye(small.adaptation_cd_m2);
    panel.scene["adaptation_cd_m2"] = small.adaptation_cd_m2;
    panel.draw = [make, view = panel.view] { return make(view).rgb; };
    return panel;
}

Panel water_panel(const std::string& label, const PanelSize& size, double fov_deg,
                  const scene::Water& water) {
    Panel panel = scene_panel(label, size, fov_deg,
                              [water](const View& view) { return scene::make_water(view, water); });
    panel.scene.update({{"time_s", water.time_s},
                        {"eye_height_m", water.eye_height_m},
                        {"pitch_deg", water.pitch_deg},
                        {"sun_elevation_deg", water.sun_elevation_deg},
                        {"wind_m_s", water.wind_m_s}});
    return panel;
}

Panel candle_panel(const std::string& label, const PanelSize& size, double time_s) {
    scene::Candle candle;
    candle.time_s = time_s;
    Panel panel = scene_panel(
        label, size, 6, [candle](const View& view) { return scene::make_candle(view, candle); });
    panel.spectrum = kFlame;
    panel.scene.update({{"time_s", candle.time_s},
                        {"distance_m", candle.distance_m},
                        {"intensity_cd", candle.intensity_cd}});
    return panel;
}

Panel sunset_panel(const PanelSize& size, double elevation_deg) {
    const std::string label = fmt::format("sun at {:+.2f} deg", elevation_deg);
    Panel panel = scene_panel(label, size, 20, [elevation_deg](const View& view) {
        return scene::make_sunset(view, {elevation_deg});
    });
    panel.scene.update({{"sun_elevation_deg", elevation_deg},
                        {"sun_rgb_cd_m2", scene::setting_sun_cd_m2(elevation_deg)}});
    return panel;
}

}  // namespace

Content water_case(const PanelSize& size) {
    constexpr double kBlinking = 0.6;
    constexpr double kNearDeg = 30;
    constexpr double kFarDeg = 20;
    scene::Water close;
    close.sun_elevation_deg = 38;
    scene::Water far;
    far.eye_height_m = 40;
    far.sun_elevation_deg = 50;
    const Panel near_panel = water_panel("near", size, kNearDeg, close);
    const Panel far_panel = water_panel("far", size, kFarDeg, far);
    Content content;
    content.panels = {without_glare(near_panel, "near, no glare"),
                      near_panel,
                      with_lids(near_panel, kBlinking, "near, blinking"),
                      without_glare(far_panel, "far, no glare"),
                      far_panel,
                      with_lids(far_panel, kBlinking, "far, blinking")};

    constexpr int kFrames = 48;
    const eye::LivingEye living = living_eye(1500, {});
    for (int i = 0; i < kFrames; ++i) {
        close.time_s = i / content.frames_per_second;
        const std::string label = fmt::format("{:.2f} s", close.time_s);
        content.frames.push_back(
            at_moment(water_panel(label, size, kNearDeg, close), living.at(close.time_s), label));
    }
    return content;
}

Content candle_case(const PanelSize& size) {
    const Panel candle = candle_panel("candle", size, 0);
    Panel point = lights_panel("a point of the same light, vivid", candle.view, grey(0.02), {},
                               {{0, 0, scene::flame_illuminance_lx({})}});
    point.eye = candle.eye;
    point.white_cd_m2 = candle.white_cd_m2;
    point.preset = "vivid";
    point.spectrum = kFlame;
    Content content;
    content.panels = {without_glare(candle, "candle, no glare"), candle,
                      with_preset(candle, "vivid", "candle, vivid"), point};

    constexpr int kFrames = 48;
    eye::MotionSettings settings;
    settings.gaze = eye::Gaze::saccades(1);
    const eye::LivingEye living = living_eye(candle.scene["adaptation_cd_m2"], settings);
    for (int i = 0; i < kFrames; ++i) {
        const double time_s = i / content.frames_per_second;
        const std::string label = fmt::format("{:.2f} s", time_s);
        Panel frame = at_moment(candle_panel(label, size, time_s), living.at(time_s), label);
        frame.preset = "vivid";
        content.frames.push_back(std::move(frame));
    }
    return content;
}

Content sunset_case(const PanelSize& size) {
    Content content;
    for (const double elevation_deg : {5.0, 3.5, 2.5, 1.5, 0.8, 0.3, 0.0, -0.2}) {
        content.panels.push_back(sunset_panel(size, elevation_deg));
    }
    content.panels.push_back(
        with_preset(sunset_panel(size, 0.8), "vivid", "sun at +0.80 deg, vivid"));
    // Slower towards the end, where each step takes away more of what is left of the sun.
    constexpr int kFrames = 48;
    for (int i = 0; i < kFrames; ++i) {
        const double to_go = 1 - i / (kFrames - 1.0);
        content.frames.push_back(sunset_panel(size, -0.3 + 4.3 * to_go * to_go * to_go));
    }
    content.frames_per_second = 12;
    return content;
}

}  // namespace aureole::app
