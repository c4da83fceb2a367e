// Built-in environments: procedural pictures of the whole sphere in absolute luminance, to light
// and to be mirrored. Pixels are linear sRGB whose luminance() is cd/m2.
//
// Convention: latitude-longitude as in OpenEXR's environment maps: +Y is up, +Z in the middle, +X
// a quarter of the width from the left; pixel (x, y) looks at
//
//     longitude = pi - 2 pi (x + 1/2) / width     latitude = pi / 2 - pi (y + 1/2) / height
//     (sin(longitude) cos(latitude), sin(latitude), cos(longitude) cos(latitude)).
//
// An environment is the same world at every size: edges are antialiased, and the sun keeps its
// energy however small it gets. Nothing depends on the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "aureole/image/image.h"

namespace aureole::scene {

struct EnvironmentOptions {
    int width = 2048;        // pixels, 1 to 32768
    int height = 1024;       // pixels, 1 to 32768; half the width makes square pixels
    std::uint64_t seed = 1;  // other clouds, hills and textures
};

struct Environment {
    Image rgb;                    // 3 channels, cd/m2
    double adaptation_cd_m2 = 0;  // as in scene.h
    double display_white_cd_m2 = 0;
};

struct EnvironmentInfo {
    std::string_view name;
    std::string_view description;  // one line
};

// The environments there are, in the order in which a help text should show them.
std::span<const EnvironmentInfo> list_environments();

// Throws InvalidArgument for a name that is not in list_environments() and for options out of
// range.
Environment make_environment(std::string_view name, const EnvironmentOptions& options = {});

}  // namespace aureole::scene
