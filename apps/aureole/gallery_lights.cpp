// Large sources, small ones, and coloured ones.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "aureole/base/random.h"
#include "gallery_panels.h"

namespace aureole::app {
namespace {

constexpr double kBlinking = 0.6;  // how far the lids of a panel are closed

// Sources of about the same illuminance, somewhere in the picture; each panel the same places.
std::vector<scene::PointLight> scattered_points(double illuminance_lx, double field_deg,
                                                double shift_deg = 0) {
    constexpr int kPoints = 14;
    Random random(4, 7);
    std::vector<scene::PointLight> points;
    for (int i = 0; i < kPoints; ++i) {
        const double x = random.uniform(-0.46, 0.46) * field_deg;
        const double y = random.uniform(-0.25, 0.25) * field_deg;
        points.push_back(
            {x + shift_deg, y, grey(illuminance_lx * std::exp2(random.uniform(-1, 1)))});
    }
    return points;
}

}  // namespace

Content large_source_case(const PanelSize& size) {
    const View view = panel_view(size, 24);
    Panel day =
        lights_panel("sun through haze, open", view, {1700, 2000, 2700}, {{0, 0, 0.53, grey(2e7)}});
    day.white_cd_m2 = 6000;
    day.eye = adapted_eye(2000);
    Panel night =
        lights_panel("lamp on a dark ground, open", view, grey(0.5), {{0, 0, 0.53, grey(1e5)}});
    night.white_cd_m2 = 12;
    night.eye = adapted_eye(0.5);
    Content content;
    content.panels = {without_glare(day, "sun through haze, no glare"),
                      day,
                      with_lids(day, kBlinking, "sun through haze, blinking"),
                      with_preset(day, "vivid", "sun through haze, vivid"),
                      without_glare(night, "lamp on a dark ground, no glare"),
                      night,
                      with_lids(night, kBlinking, "lamp on a dark ground, blinking"),
                      with_preset(night, "vivid", "lamp on a dark ground, vivid")};

    constexpr int kFrames = 25;
    constexpr double kHertz = 64;
    eye::MotionSettings settings;
    settings.blinks = {eye::Blinking::kVoluntary, 15, {0.02}, false};
    const eye::LivingEye living = living_eye(0.5, settings);
    for (int i = 0; i < kFrames; ++i) {
        const double time_s = i / kHertz;
        content.frames.push_back(
            at_moment(night, living.at(time_s), fmt::format("{:.0f} ms", 1e3 * time_s)));
    }
    content.frames_per_second = kHertz / 8;
    return content;
}

Content stars_case(const PanelSize& size) {
    constexpr double kFieldDeg = 6;
    constexpr double kSky = 3e-4;  // cd/m2, a moonless night
    const View view = panel_view(size, kFieldDeg);
    const auto star = [&](const std::string& label, double magnitude) {
        Panel panel = lights_panel(label, view, grey(kSky), {},
                                   {{0, 0, grey(scene::star_illuminance_lx(magnitude))}});
        panel.white_cd_m2 = 0.02;
        panel.eye = adapted_eye(kSky);
        return panel;
    };
    const auto lamps = [&](const std::string& label, double ground, double illuminance_lx) {
        Panel panel = lights_panel(label, view, grey(ground), {},
                                   scattered_points(illuminance_lx, kFieldDeg));
        panel.white_cd_m2 = 1.2;
        panel.eye = adapted_eye(ground);
        return panel;
    };
    const Panel dark = lamps("far lamps at night", 0.01, 5e-4);
    Panel bright =
        lights_panel("far lamps at dusk, one of them near", view, grey(0.3), {},
                     {{-1.2, 0, grey(0.02)}, {1.5, 0.4, grey(5e-4)}, {2.1, -0.6, grey(5e-4)}});
    bright.white_cd_m2 = dark.white_cd_m2;
    bright.eye = adapted_eye(0.3);
    Content content;
    content.panels = {star("a star of magnitude 3", 3),
                      star("magnitude 0", 0),
                      star("magnitude -4.5: Venus", -4.5),
                      with_preset(star("", -4.5), "vivid", "Venus, vivid"),
                      lamps("far lamps at dusk", 0.3, 5e-4),
                      bright,
                      dark,
                      with_lids(dark, kBlinking, "far lamps at night, blinking")};

    constexpr int kFrames = 48;
    const double step_deg = view.pitch_deg / 8;
    for (int i = 0; i < kFrames; ++i) {
        Panel frame = lights_panel(fmt::format("{:.3f} pixels", i / 8.0), view, grey(0.01), {},
                                   scattered_points(5e-4, kFieldDeg, i * step_deg));
        frame.white_cd_m2 = dark.white_cd_m2;
        frame.eye = dark.eye;
        content.frames.push_back(std::move(frame));
    }
    return content;
}

Content colors_case(const PanelSize& size) {
    constexpr double kLargest = 5e4;
    const View view = panel_view(size, 20);
    const auto panel = [&](const std::string& label, const std::vector<scene::DiscLight>& discs) {
        Panel result = lights_panel(label, view, grey(0.5), discs);
        result.white_cd_m2 = 12;
        result.eye = adapted_eye(0.5);
        return result;
    };
    const auto disc = [](double x_deg, const color::Rgb& rgb) {
        return scene::DiscLight{x_deg, 0, 0.5, rgb};
    };
    const Panel three = panel(
        "azure, orange, apple green",
        {disc(-6, azure(kLargest)), disc(0, orange(kLargest)), disc(6, apple_green(kLargest))});
    Content content;
    content.panels = {without_glare(three, "azure, orange, apple green, no glare"),
                      three,
                      with_preset(three, "vivid", "azure, orange, apple green, vivid"),
                      panel("azure", {disc(0, azure(kLargest))}),
                      panel("orange", {disc(0, orange(kLargest))}),
                      panel("apple green", {disc(0, apple_green(kLargest))})};
    for (int degrees = 0; degrees < 360; degrees += 60) {
        content.panels.push_back(
            panel(fmt::format("hue {} deg", degrees), {disc(0, hue(degrees, kLargest))}));
    }
    for (int degrees = 0; degrees < 360; degrees += 10) {
        content.frames.push_back(
            panel(fmt::format("hue {} deg", degrees), {disc(0, hue(degrees, kLargest))}));
    }
    content.frames_per_second = 12;
    return content;
}

}  // namespace aureole::app
