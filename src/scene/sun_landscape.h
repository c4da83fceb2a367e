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

// Radiance of hills and meadow in a unit direction; `footprint` is the size of a pixel at distance
// 1 m. Returns which of them it is, a number above 0, or 0 and no radiance for the sky.
int land_radiance(Vec3 eye, Vec3 direction, float footprint, Vec3& out);

// The tree: trunk, branches and leaves, and a fence in the meadow.
struct Crown {
    Vec3 centre;
    Vec3 half_size;
};
inline constexpr Vec3 kTreeFoot = {5.6F, 0, 15.5F};
inline constexpr Crown kCrown = {{5.6F, 5.9F, 15.5F}, {3.9F, 3.1F, 3.7F}};
inline constexpr float kTrunkRadius = 0.30F;
void add_tree(const Camera& camera, Random& random, std::vector<Stroke>& strokes);
void add_fence(const Camera& camera, Random& random, std::vector<Stroke>& strokes);
void add_grass(const Camera& camera, Random& random, std::vector<Stroke>& strokes);

// Line of the fence and of the track over the meadow: x at a depth.
float fence_x(float z);
float track_x(float z);
inline constexpr float kPostSpacing = 2.6F;
inline constexpr float kFirstPostZ = 5.5F;
inline constexpr float kRailHeights[] = {0.48F, 0.95F};

// Share of the sun's light that passes tree and fence to a point on the meadow.
float sunlight(Vec3 point, float footprint);

}  // namespace aureole::scene::daylight
