// Hills one behind the other, and the meadow with the shadow of the tree.
#include <cmath>

#include "aureole/base/units.h"
#include "scene/noise.h"
#include "scene/sun_landscape.h"

namespace aureole::scene::daylight {
namespace {

constexpr float kInversePi = 0.31830989F;

struct Ridge {
    float distance_m;
    float height_m;  // mean height of the skyline above the eye
    float relief_m;
    float period_m;
    int seed;
    Vec3 albedo;
    float trees_m;  // height of woods along the skyline
};

constexpr Ridge kRidges[] = {
    {420, 5, 9, 260, 3, {0.060F, 0.080F, 0.028F}, 9},
    {1500, 62, 60, 900, 4, {0.050F, 0.070F, 0.030F}, 14},
    {4200, 190, 190, 2300, 5, {0.055F, 0.070F, 0.045F}, 12},
    {11000, 500, 520, 4600, 6, {0.06F, 0.07F, 0.06F}, 0},
};

float skyline(const Ridge& ridge, float along, float pixel_m) {
    float height =
        ridge.height_m +
        ridge.relief_m * 1.6F * fractal_noise(along, 0, ridge.period_m, 6, pixel_m, ridge.seed);
    if (ridge.trees_m > 0) {
        const float wood = smoothstep(
            -0.15F, 0.25F, fractal_noise(along, 7, 0.5F * ridge.period_m, 3, 0, ridge.seed + 9));
        const float crowns =
            0.55F +
            0.45F * fractal_noise(along, 3, ridge.trees_m * 0.9F, 3, pixel_m, ridge.seed + 20) +
            0.25F * fractal_noise(along, 9, ridge.trees_m * 4, 2, pixel_m, ridge.seed + 30);
        height += ridge.trees_m * wood * crowns;
    }
    return height;
}

// Air between: what is far takes on the light that the air scatters towards the eye, most of all
// under the sun (Koschmieder's law).
Vec3 through_air(Vec3 radiance, float distance_m, Vec3 direction) {
    constexpr float kVisualRange = 9000;
    const float clear = std::exp(-distance_m / kVisualRange);
    const Vec3 level = normalize({direction.x, 0.03F, direction.z});
    return mix(sky_radiance(level) * 0.72F, radiance, clear);
}

Vec3 meadow(Vec3 p, float distance, float footprint, Vec3 direction) {
    const float across = footprint;
    const float filter = footprint * std::min(1 / std::max(-direction.y, 0.01F), 12.0F) * 0.5F;
    // Blades seen against the light: clumps, brighter where tops are lit through.
    const float clumps = fractal_noise(p.x, 0.6F * p.z, 1.3F, 4, filter, 51);
    const float blades = fractal_noise(p.x * 1.0F, 0.28F * p.z, 0.09F, 3, across, 57);
    const float wide = fractal_noise(p.x, p.z, 17.0F, 3, filter, 61);
    const float dry = smoothstep(-0.1F, 0.5F, fractal_noise(p.x, p.z, 8.0F, 4, filter, 63));
    Vec3 albedo = mix(Vec3{0.085F, 0.125F, 0.030F}, Vec3{0.20F, 0.17F, 0.065F}, 0.75F * dry);
    albedo = albedo * std::max(1 + 0.45F * clumps + 0.75F * blades + 0.35F * wide, 0.15F);
    // A track of two ruts that winds towards the hills.
    const float centre = track_x(p.z);
    const float rut = std::abs(std::abs(p.x - centre) - 0.75F) +
                      0.10F * fractal_noise(p.x, p.z, 0.5F, 3, filter, 73);
    const float bare = smoothstep(0.36F + 0.5F * filter, 0.20F - 0.3F * filter, rut);
    const float gravel = 1 + 0.5F * fractal_noise(p.x, 0.5F * p.z, 0.12F, 3, across, 77);
    albedo = mix(albedo, Vec3{0.24F, 0.20F, 0.145F} * gravel, 0.85F * bare);

    const float light = sunlight(p, footprint);
    const Vec3 sun = sun_colour() * (1.05e5F * sun_direction().y);
    // Towards the sun leaves of grass glow by transmission.
    const float against =
        std::max(dot(direction, normalize({sun_direction().x, 0, sun_direction().z})), 0.0F);
    const Vec3 through = Vec3{1.25F, 1.15F, 0.5F} * (0.9F * against * against * (1 - bare));
    const Vec3 lit = albedo * (sun * (light * 0.75F) + sky_illuminance()) * kInversePi;
    const Vec3 glow = albedo * through * sun * (light * kInversePi);
    return through_air(lit + glow, distance, direction);
}

}  // namespace

float track_x(float z) {
    return -1.0F - 0.055F * z + 2.6F * std::sin(z * 0.045F) +
           0.3F * fractal_noise(z, 0, 9, 3, 0, 71);
}

int land_radiance(Vec3 eye, Vec3 direction, float footprint, Vec3& out) {
    const float level = std::hypot(direction.x, direction.z);
    const float slope = direction.y / level;
    const float azimuth = std::atan2(direction.x, direction.z);
    // The meadow ends where the nearest ridge stands.
    if (slope < 0) {
        const float distance = -eye.y / slope;
        if (distance < kRidges[0].distance_m * 0.9F) {
            const Vec3 p = eye + direction * (distance / level);
            out = meadow(p, distance, distance * footprint, direction);
            return 1;
        }
    }
    int which = 1;
    for (const Ridge& ridge : kRidges) {
        ++which;
        const float y = slope * ridge.distance_m;
        if (y > ridge.height_m + 1.6F * ridge.relief_m + 1.7F * ridge.trees_m) continue;
        const float pixel_m = footprint * ridge.distance_m;
        const float along = azimuth * ridge.distance_m;
        const float top = skyline(ridge, along, pixel_m);
        if (y > top) continue;
        // Slopes that face the eye lie in their own shadow; hedges and fields give them texture.
        const float fields = fractal_noise(along, (top - y) * 2.2F, 0.22F * ridge.period_m, 4,
                                           pixel_m, ridge.seed + 40);
        const float crest = std::exp(-(top - y) / (0.10F * ridge.relief_m + 2));
        const Vec3 light = sky_illuminance() * 0.75F + sun_colour() * (9000 + 16000 * crest);
        const Vec3 surface =
            ridge.albedo * light * (kInversePi * std::max(1 + 0.8F * fields, 0.3F));
        out = through_air(surface, ridge.distance_m * 0.8F, direction);
        return which;
    }
    return 0;
}

}  // namespace aureole::scene::daylight
