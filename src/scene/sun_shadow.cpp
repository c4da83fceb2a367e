// What stands between the sun and the meadow.
#include <cmath>

#include "scene/noise.h"
#include "scene/sun_landscape.h"

namespace aureole::scene::daylight {
namespace {

// Width over which the half-degree disc of the sun blurs the edge of a shadow thrown from a
// distance, plus the pixel's own width.
float penumbra(float distance, float footprint) { return 0.5F * (0.0093F * distance + footprint); }

// Share of the sun's light that reaches a point on the meadow past the tree.
float past_tree(Vec3 p, float footprint) {
    const Vec3 sun = sun_direction();
    // The trunk, as a wall across the light with a soft edge: the sun is half a degree wide.
    float light = 1;
    const Vec3 to_tree = kTreeFoot - p;
    const float reach = to_tree.x * sun.x + to_tree.z * sun.z;
    if (reach <= 0) return 1;
    const float level = sun.x * sun.x + sun.z * sun.z;
    const float t = reach / level;
    const float aside = std::abs((to_tree.x * sun.z - to_tree.z * sun.x) / std::sqrt(level));
    const float blur = penumbra(t, footprint) + 0.02F;
    const float height = t * sun.y;
    if (height < kCrown.centre.y) light *= smoothstep(-blur, blur, aside - kTrunkRadius);
    // The crown: density of leaves along the ray, dappled.
    const Vec3 c = (kCrown.centre - p);
    const Vec3 scale = {1 / kCrown.half_size.x, 1 / kCrown.half_size.y, 1 / kCrown.half_size.z};
    const Vec3 d = sun * scale;
    const Vec3 m = c * scale;
    const float along = dot(m, d) / dot(d, d);
    const Vec3 nearest = m - d * along;
    const float inside = 1 - dot(nearest, nearest);
    if (along > 0 && inside > -0.4F) {
        const Vec3 q = p + sun * along;
        const float holes = fractal_noise(q.x * 1.3F, q.y * 1.3F, 1.0F, 3, footprint, 91);
        const float density = smoothstep(-0.25F, 0.35F, inside + 0.55F * holes);
        light *= 1 - 0.96F * density;
    }
    return light;
}

float past_fence(Vec3 p, float footprint) {
    const Vec3 sun = sun_direction();
    // The light crosses the line of the fence at a small angle: two steps of the secant find where.
    float t = 0;
    for (int i = 0; i < 3; ++i) {
        const float z = p.z + t * sun.z;
        t = (fence_x(z) - p.x) / sun.x;
    }
    if (t < 0 || t > 6) return 1;
    const float height = t * sun.y;
    const float z = p.z + t * sun.z;
    if (z < kFirstPostZ) return 1;
    const float blur = penumbra(t, footprint) + 0.01F;
    float light = 1;
    for (const float rail : kRailHeights) {
        light *= smoothstep(-blur, blur, std::abs(height - rail) - 0.038F);
    }
    // Posts stand upright: their width counts across the light.
    const float cell = (z - kFirstPostZ) / kPostSpacing;
    const float along = (cell - std::round(cell)) * kPostSpacing * std::abs(sun.x);
    if (height < 1.1F) light *= smoothstep(-blur, blur, std::abs(along) - 0.06F);
    return light;
}

}  // namespace

float sunlight(Vec3 point, float footprint) {
    return past_tree(point, footprint) * past_fence(point, footprint);
}

}  // namespace aureole::scene::daylight
