// Built-in HDR pictures in absolute luminance, computed when asked for: something real to make
// glare on without any file. Pixels are linear sRGB whose luminance() is cd/m2.
//
// A scene is the same world at every picture size: lights keep their energy (luminance times
// solid angle) to 0.5 % however small they get, textures are filtered, and nothing depends on the
// number of threads. The camera is a true perspective one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "aureole/image/image.h"
#include "aureole/image/view.h"

namespace aureole::scene {

struct SceneOptions {
    int width = 1920;               // pixels, 1 to 32768
    int height = 1080;              // pixels, 1 to 32768
    std::optional<double> fov_deg;  // horizontal field of view, (0, 170]; default: the scene's own
    std::uint64_t seed = 1;         // another town, another sky; `point` and `bars` have none

    // `point` only: the pixel that is lit (default: width / 2, height / 2) and its value in each
    // of R, G and B.
    std::optional<int> point_x;
    std::optional<int> point_y;
    double point_cd_m2 = 1e6;  // >= 0
};

struct Scene {
    Image rgb;  // 3 channels, cd/m2
    View view;  // Projection::kPerspective
    // What an eye in the scene is adapted to: the mean luminance without the small bright lights.
    double adaptation_cd_m2 = 0;
    // A luminance to show as white with a filmic tone curve.
    double display_white_cd_m2 = 0;
};

struct SceneInfo {
    std::string_view name;
    std::string_view description;  // one line
    double default_fov_deg = 60;
};

// The scenes there are, in the order in which a help text should show them.
std::span<const SceneInfo> list_scenes();

// Throws InvalidArgument for a name that is not in list_scenes() and for options out of range.
Scene make_scene(std::string_view name, const SceneOptions& options = {});

}  // namespace aureole::scene
