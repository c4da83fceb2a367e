#include <cmath>

#include "aureole/base/units.h"
#include "scene/builders.h"
#include "scene/noise.h"
#include "scene/sun_landscape.h"

namespace aureole::scene::daylight {

Vec3 sun_direction() {
    static const Vec3 direction = [] {
        const double azimuth = rad_from_deg(kSunAzimuthDeg);
        const double elevation = rad_from_deg(kSunElevationDeg);
        return Vec3{static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                    static_cast<float>(std::sin(elevation)),
                    static_cast<float>(std::cos(elevation) * std::cos(azimuth))};
    }();
    return direction;
}

Vec3 sun_colour() {
    static const Vec3 colour = black_body_rgb(5300);
    return colour;
}

Vec3 sky_radiance(Vec3 direction) {
    // ISO 15469 / CIE S 011, sky type 12 (clear), with a softer aureole as of a slightly hazy day:
    // gradation by height times indicatrix by angle to the sun.
    constexpr float kZenithLuminance = 1150;
    const float up = std::max(direction.y, 0.015F);
    const float gradation = (1 - std::exp(-0.32F / up)) / (1 - std::exp(-0.32F));
    const float cosine = std::clamp(dot(direction, sun_direction()), -1.0F, 1.0F);
    const float angle = std::acos(cosine);
    const float indicatrix =
        1 + 4.0F * std::exp(-3 * angle) + 7 * std::exp(-angle / 0.06F) + 0.45F * cosine * cosine;
    const float level = kZenithLuminance * gradation * indicatrix * 0.62F;

    static const Vec3 blue = unit_luminance({0.33F, 0.72F, 1.95F});
    static const Vec3 pale = unit_luminance({0.96F, 1.0F, 1.10F});
    static const Vec3 warm = unit_luminance({1.14F, 1.0F, 0.80F});
    const float height = 1 - std::exp(-up / 0.20F);
    Vec3 colour = mix(pale, blue, height * (1 - 0.5F * std::exp(-angle / 0.5F)));
    colour = mix(colour, warm, 0.8F * std::exp(-angle / 0.16F) + 0.25F * std::exp(-up / 0.05F));
    Vec3 sky = colour * level;

    // Cirrus: streaks on a plane far above, bright near the sun.
    const float x = direction.x / up;
    const float z = direction.z / up;
    const float warp = 0.8F * fractal_noise(x, z, 3.0F, 3, 0, 11);
    const float wisps = fractal_noise(0.55F * x + 0.25F * z + warp, 1.6F * z - 0.5F * x, 1.9F, 6,
                                      0.004F / (up * up), 5);
    const float amount = smoothstep(-0.02F, 0.62F, wisps) * smoothstep(0.02F, 0.16F, direction.y);
    const Vec3 cloud = mix(pale, warm, 0.5F * std::exp(-angle / 0.35F)) * (2600 + 1.05F * level);
    return mix(sky, cloud, 0.62F * amount);
}

Vec3 sky_illuminance() { return unit_luminance({0.75F, 0.95F, 1.35F}) * 9500; }

}  // namespace aureole::scene::daylight
