// One function per scene. Options have been checked and the field of view filled in.
#pragma once

#include "aureole/scene/scene.h"
#include "scene/vec.h"

namespace aureole::scene {

Scene make_night_street(const SceneOptions& options, const View& view);
Scene make_sun(const SceneOptions& options, const View& view);
Scene make_stars(const SceneOptions& options, const View& view);
Scene make_point(const SceneOptions& options, const View& view);
Scene make_bars(const SceneOptions& options, const View& view);

// Colour of a black body, luminance 1, components that leave the sRGB gamut lifted to 0.
Vec3 black_body_rgb(double temperature_k);

// Mean luminance of the darker `share` of a picture's pixels, cd/m2.
double mean_luminance(const Image& rgb, double share = 1);

}  // namespace aureole::scene
