// The parts of the `sun` scene. Metres; +z is ahead, y = 0 the meadow.
#pragma once

#include <vector>

#include "aureole/base/random.h"
#include "scene/camera.h"
#include "scene/silhouette.h"
#include "scene/vec.h"

namespace aureole::scene::daylight {

inline constexpr double kSunRadiusDeg = 0.265;   // half of 0.53 deg
inline constexpr float kSunLuminance = 1.6e9F;   // cd/m2
inline constexpr double kSunAzimuthDeg = -12.5;  // right of straight ahead
inline constexpr double kSunElevationDeg = 15;
inline constexpr Vec3 kEye = {0, 1.65F, 0};
inline constexpr double kEyePitchDeg = 4.5;

// Unit vector towards the sun, and its colour at luminance 1.
Vec3 sun_direction();
Vec3 sun_colour();

// Radiance of the clear sky with a few thin clouds. Unit direction, above the horizon.
Vec3 sky_radiance(Vec3 direction);

// Illuminance (lx as rgb) on a level surface from the sky without the sun.
Vec3 sky_illuminance();

// Radiance of hills and meadow in a direction; `footprint` is the size of a pixel at distance 1 m.
// False if the direction shows sky.
bool land_radiance(Vec3 eye, Vec3 direction, float footprint, Vec3& out);

// The tree: trunk, branches and leaves, and a fence in the meadow.
struct Crown {
    Vec3 centre;
    Vec3 half_size;
};
inline constexpr Vec3 kTreeFoot = {4.9F, 0, 13.5F};
inline constexpr Crown kCrown = {{4.9F, 5.6F, 13.5F}, {3.7F, 2.9F, 3.5F}};
inline constexpr float kTrunkRadius = 0.30F;
void add_tree(const Camera& camera, Random& random, std::vector<Stroke>& strokes);
void add_fence(const Camera& camera, Random& random, std::vector<Stroke>& strokes);

}  // namespace aureole::scene::daylight
