// The test cases of `aureole gallery`: what is in them. How they are rendered: gallery_render.h.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aureole/color/illuminant.h"
#include "aureole/eye/anatomy.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"

namespace aureole::app {

// One picture: a scene, and the eye that looks at it.
struct Panel {
    std::string label;  // one short line
    View view;
    // The scene, linear sRGB in cd/m2, of the view's size; its parameters, for the index.
    std::function<Image()> draw;
    nlohmann::ordered_json scene;
    double white_cd_m2 = 1;  // shown as white
    bool glare = true;       // false: the scene as it is, to compare with
    // The eye before its preset, which gives it its look (gallery_render.h).
    eye::Eye eye;
    std::string preset = "physical";
    color::Illuminant spectrum = color::Illuminant::kD65;  // of the light that makes glare
    double light_share = 1;                                // what the lids let through
};

struct Content {
    std::vector<Panel> panels;  // of the contact sheet, row by row
    std::vector<Panel> frames;  // of a short sequence; may be empty
    double frames_per_second = 24;
};

struct PanelSize {
    int width = 480;
    int height = 270;
};

struct Case {
    std::string_view name;  // of its files, and for --only
    std::string_view title;
    std::string_view text;    // what to look at
    std::string_view frames;  // what the sequence shows; empty without one
    int columns = 3;          // of the contact sheet
    Content (*make)(const PanelSize& size);
};

// In the order of the index.
std::span<const Case> gallery_cases();

// gallery_lights.cpp
Content large_source_case(const PanelSize& size);
Content stars_case(const PanelSize& size);
Content colors_case(const PanelSize& size);
// gallery_sweeps.cpp
Content sizes_case(const PanelSize& size);
Content brightness_case(const PanelSize& size);
Content occlusion_case(const PanelSize& size);
// gallery_nature.cpp
Content water_case(const PanelSize& size);
Content candle_case(const PanelSize& size);
Content sunset_case(const PanelSize& size);

}  // namespace aureole::app
