// Sizes, brightness, and sources that are partly hidden.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "gallery_panels.h"

namespace aureole::app {
namespace {

constexpr double kGround = 0.5;  // cd/m2
constexpr std::array<double, 3> kDiametersDeg = {0.15, 0.4, 1};
constexpr std::array<double, 3> kLuminances = {1e3, 1e4, 1e5};
constexpr std::array<double, 3> kPlacesDeg = {-6, 0, 6};
constexpr int kFrames = 36;

// Three sources side by side.
Panel three(const std::string& label, const PanelSize& size,
            const std::array<double, 3>& diameters_deg, const std::array<double, 3>& luminances) {
    std::vector<scene::DiscLight> discs;
    for (std::size_t i = 0; i < 3; ++i) {
        discs.push_back({kPlacesDeg[i], 0, diameters_deg[i], grey(luminances[i])});
    }
    Panel panel = lights_panel(label, panel_view(size, 20), grey(kGround), discs);
    panel.white_cd_m2 = 12;
    panel.eye = adapted_eye(kGround);
    return panel;
}

std::array<double, 3> same(double value) { return {value, value, value}; }

// From `first` to `last`, equal ratios from frame to frame.
double swept(double first, double last, int frame) {
    return first * std::pow(last / first, frame / (kFrames - 1.0));
}

}  // namespace

Content sizes_case(const PanelSize& size) {
    Content content;
    for (const char* preset : {"physical", "vivid"}) {
        for (const double luminance : kLuminances) {
            const std::string label = fmt::format("{:.0f} cd/m2, {}", luminance, preset);
            content.panels.push_back(
                with_preset(three(label, size, kDiametersDeg, same(luminance)), preset, label));
        }
    }
    for (int i = 0; i < kFrames; ++i) {
        const double diameter_deg = swept(0.05, 1, i);
        content.frames.push_back(three(fmt::format("{:.2f}, {:.2f} and {:.2f} deg", diameter_deg,
                                                   2 * diameter_deg, 3 * diameter_deg),
                                       size, {diameter_deg, 2 * diameter_deg, 3 * diameter_deg},
                                       same(1e4)));
    }
    content.frames_per_second = 12;
    return content;
}

Content brightness_case(const PanelSize& size) {
    Content content;
    for (const char* preset : {"physical", "vivid"}) {
        for (const double diameter_deg : kDiametersDeg) {
            const std::string label = fmt::format("{} deg, {}", diameter_deg, preset);
            content.panels.push_back(
                with_preset(three(label, size, same(diameter_deg), kLuminances), preset, label));
        }
    }
    for (int i = 0; i < kFrames; ++i) {
        const double luminance = swept(100, 1e5, i);
        content.frames.push_back(three(fmt::format("{:.0f}, {:.0f} and {:.0f} cd/m2", luminance,
                                                   luminance / 3, luminance / 10),
                                       size, same(0.5),
                                       {luminance, luminance / 3, luminance / 10}));
    }
    content.frames_per_second = 12;
    return content;
}

Content occlusion_case(const PanelSize& size) {
    constexpr double kDiameterDeg = 1;
    const View view = panel_view(size, 12);
    const auto lamp = [&](const std::string& label, const color::Rgb& rgb, double x_deg,
                          const std::vector<scene::Plate>& plates) {
        const scene::DiscLight disc = {x_deg, 0, kDiameterDeg, rgb};
        Panel panel = lights_panel(label, view, grey(kGround), {disc});
        for (const scene::Plate& plate : plates) {
            panel.scene["plates"].push_back({{"left_deg", plate.left_deg},
                                             {"transmission", plate.transmission},
                                             {"hole_pitch_deg", plate.hole_pitch_deg},
                                             {"hole_width_deg", plate.hole_width_deg},
                                             {"rgb_cd_m2", plate.rgb_cd_m2}});
        }
        panel.draw = [view, disc, plates] {
            Image picture = scene::lights_on_ground(view, grey(kGround), {disc});
            for (const scene::Plate& plate : plates) scene::put_before(plate, view, picture);
            return picture;
        };
        panel.white_cd_m2 = 40;
        panel.eye = adapted_eye(kGround);
        return panel;
    };
    const color::Rgb white = grey(1e4);
    const color::Rgb warm = orange(1e4);
    // Edges at the middle of the lamp, or left of it.
    scene::Plate opaque;
    opaque.rgb_cd_m2 = grey(0.15);
    scene::Plate cut_out = opaque;
    cut_out.hole_pitch_deg = 0.3;
    cut_out.hole_width_deg = 0.15;
    scene::Plate half = opaque;
    half.transmission = 0.5;
    scene::Plate half_before = half;
    half_before.left_deg = -3;
    scene::Plate hundredth_before = half_before;
    hundredth_before.transmission = 0.01;

    const Panel edge = lamp("half behind an opaque plate", white, 0, {opaque});
    const Panel holes = lamp("half behind a plate with holes", white, 0, {cut_out});
    const Panel glass = lamp("half behind a plate of 50 %", white, 0, {half});
    const Panel tinted = lamp("orange, all behind a plate of 50 %", warm, 0, {half_before});
    Content content;
    content.panels = {without_glare(edge, "opaque, no glare"),
                      without_glare(holes, "holes, no glare"),
                      without_glare(glass, "50 %, no glare"),
                      without_glare(tinted, "orange behind 50 %, no glare"),
                      edge,
                      holes,
                      glass,
                      tinted,
                      lamp("nothing before it", white, 0, {}),
                      with_preset(holes, "vivid", "half behind a plate with holes, vivid"),
                      lamp("orange, nothing before it", warm, 0, {}),
                      lamp("orange, all behind a plate of 1 %", warm, 0, {hundredth_before})};
    for (int i = 0; i < kFrames; ++i) {
        const double x_deg = -1.2 + 2.4 * i / (kFrames - 1);
        content.frames.push_back(
            lamp(fmt::format("lamp at {:+.2f} deg", x_deg), white, x_deg, {opaque}));
    }
    content.frames_per_second = 12;
    return content;
}

}  // namespace aureole::app
