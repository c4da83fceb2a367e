// What the small scenes of studies.h share.
#pragma once

#include "aureole/color/rgb.h"
#include "scene/vec.h"

namespace aureole::scene {

// Throws InvalidArgument unless the value is in [low, high].
void check_range(const char* what, double value, double low, double high);
// Throws InvalidArgument unless all three are finite and not negative.
void check_light(const char* what, const color::Rgb& rgb);

inline Vec3 vec(const color::Rgb& rgb) {
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

}  // namespace aureole::scene
