// Environments under the sky: overcast, and clear with the sun.
#include <algorithm>
#include <cmath>

#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/environments.h"
#include "scene/noise.h"

namespace aureole::scene {
namespace {

constexpr float kEyeHeight = 1.7F;  // m

// A field to the horizon: grass in patches, with a path of sand. Reflectance.
Vec3 field_albedo(float x, float z, float footprint, int seed) {
    const Vec3 grass = {0.075F, 0.115F, 0.035F};
    const Vec3 dry = {0.17F, 0.16F, 0.075F};
    const Vec3 sand = {0.34F, 0.29F, 0.22F};
    const float patches = fractal_noise(x, z, 9, 5, footprint, seed);
    const float blades = fractal_noise(x, z, 0.3F, 6, footprint, seed + 40);
    Vec3 albedo = mix(grass, dry, smoothstep(-0.25F, 0.45F, patches + 0.25F * blades));
    albedo *= 1 + 0.7F * blades;
    const float bend = 1.4F * std::sin(0.11F * z) + 0.5F * fractal_noise(z, 3, 5, 2, 0, seed + 80);
    const float edge = std::abs(x - 1.2F - bend) + 0.25F * patches + 0.12F * blades;
    const float path = smoothstep(1.15F, 0.85F - footprint, edge);
    const float pebbles = fractal_noise(x, z, 0.07F, 4, footprint, seed + 120);
    return mix(albedo, sand * (1 + 0.5F * pebbles), path);
}

// Elevation of the hills on the horizon, as a tangent; `turn` goes round once in [0, 1).
float hill_height(float turn, float size, int seed) {
    // A loop in the plane of the noise, so that the ends meet.
    const auto angle = static_cast<float>(2 * kPi) * turn;
    const float x = 3 * std::cos(angle) + 11;
    const float z = 3 * std::sin(angle) + 7;
    return size * (0.55F + fractal_noise(x, z, 2.2F, 6, 0, seed));
}

struct Air {
    Vec3 haze;          // radiance at the horizon
    Vec3 ground_light;  // irradiance over pi, of what lies flat
    Vec3 hill_light;    // the same of what stands upright
};

// What lies below the sky: false if a direction misses it.
bool look_at_land(Vec3 direction, float pixel_rad, int seed, const Air& air, Vec3& radiance) {
    const auto turn = static_cast<float>(std::atan2(direction.x, direction.z) / (2 * kPi));
    const float level = std::hypot(direction.x, direction.z);
    const float tangent = direction.y / std::max(level, 1e-6F);
    if (tangent < 0) {
        const float distance = kEyeHeight / std::max(-direction.y, 1e-5F);
        const float footprint = pixel_rad * distance * std::sqrt(distance / kEyeHeight);
        const Vec3 albedo =
            field_albedo(direction.x * distance, direction.z * distance, footprint, seed);
        // Koschmieder's law, visibility as of a slightly hazy day.
        const float clear = std::exp(-distance / 900);
        radiance = mix(air.haze, albedo * air.ground_light, clear);
        return true;
    }
    const float sizes[] = {0.035F, 0.075F, 0.12F};
    const float clears[] = {0.75F, 0.5F, 0.28F};
    for (int i = 0; i < 3; ++i) {
        const float height = hill_height(turn, sizes[i], seed + 500 * i);
        if (tangent > height) continue;
        const float woods = fractal_noise(turn * 60, tangent * 90, 0.8F, 4, 12 * pixel_rad, seed);
        const Vec3 albedo = Vec3{0.06F, 0.085F, 0.04F} * (1 + 0.6F * woods);
        radiance = mix(air.haze, albedo * air.hill_light,
                       clears[i] * (1 - 0.4F * (1 - tangent / std::max(height, 1e-4F))));
        return true;
    }
    return false;
}

struct SunPlace {
    Vec3 direction;
    double elevation_rad;
};

SunPlace sun_place() {
    const double azimuth = rad_from_deg(-38);
    const double elevation = rad_from_deg(41);
    return {{static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
             static_cast<float>(std::sin(elevation)),
             static_cast<float>(std::cos(elevation) * std::cos(azimuth))},
            elevation};
}

// ISO 15469 / CIE S 011, sky type 12, "CIE standard clear sky, low illuminance turbidity": relative
// to the zenith.
float clear_sky_level(Vec3 direction, float to_sun_rad, float sun_from_zenith_rad) {
    const auto gradation = [](float sine) { return 1 - std::exp(-0.32F / std::max(sine, 0.01F)); };
    const auto indicatrix = [](float angle) {
        const float cosine = std::cos(angle);
        return 1 + 10 * (std::exp(-3 * angle) - std::exp(-3 * static_cast<float>(kPi) / 2)) +
               0.45F * cosine * cosine;
    };
    return gradation(direction.y) * indicatrix(to_sun_rad) /
           (gradation(1) * indicatrix(sun_from_zenith_rad));
}

// Adds the disc: points of equal energy spread evenly over it, each put into its pixel, so that the
// sum over pixels of luminance times solid angle is exact at every size.
void add_sun(const SunPlace& sun, Image& picture) {
    constexpr double kLuminance = 1.6e9;
    const double radius_rad = rad_from_deg(0.265);
    const double solid_angle_sr = 2 * kPi * (1 - std::cos(radius_rad));
    const int width = picture.width();
    const int height = picture.height();
    const Vec3 colour = black_body_rgb(5400) * static_cast<float>(kLuminance);
    // A thousand points to a pixel, of those that the disc covers.
    const double pixels = solid_angle_sr * width * height / (2 * kPi * kPi);
    const int points = static_cast<int>(std::clamp(1000 * pixels, 65536.0, 4e6));
    const Vec3 side = normalize(Vec3{sun.direction.z, 0, -sun.direction.x});
    const Vec3 up = {sun.direction.y * side.z, sun.direction.z * side.x - sun.direction.x * side.z,
                     -sun.direction.y * side.x};
    for (int i = 0; i < points; ++i) {
        // Vogel 1979, "A better way to construct the sunflower head".
        const double cosine = 1 - (i + 0.5) / points * (1 - std::cos(radius_rad));
        const double sine = std::sqrt(1 - cosine * cosine);
        const double angle = 2.399963229728653 * i;
        const double a = sine * std::cos(angle);
        const double b = sine * std::sin(angle);
        const auto mixed = [&](float along, float across, float upwards) {
            return cosine * double{along} + a * double{across} + b * double{upwards};
        };
        const double dx = mixed(sun.direction.x, side.x, up.x);
        const double dy = mixed(sun.direction.y, side.y, up.y);
        const double dz = mixed(sun.direction.z, side.z, up.z);
        const double u = width * (0.5 - std::atan2(dx, dz) / (2 * kPi));
        const double v = height * (0.5 - std::asin(std::clamp(dy, -1.0, 1.0)) / kPi);
        const int x = std::clamp(static_cast<int>(u), 0, width - 1);
        const int y = std::clamp(static_cast<int>(v), 0, height - 1);
        const double pixel_sr =
            4 * kPi / width * std::sin(kPi * (y + 0.5) / height) * std::sin(kPi / (2 * height));
        const auto share = static_cast<float>(solid_angle_sr / points / pixel_sr);
        picture.at(x, y, 0) += share * colour.x;
        picture.at(x, y, 1) += share * colour.y;
        picture.at(x, y, 2) += share * colour.z;
    }
}

}  // namespace

Environment make_overcast(const EnvironmentOptions& options) {
    constexpr float kZenith = 7000;
    const Vec3 white = unit_luminance({0.95F, 1.0F, 1.08F});
    const int seed = texture_seed(options);
    const auto pixel_rad = static_cast<float>(2 * kPi / options.width);
    // The illuminance of this sky is 7 pi / 9 of the zenith's luminance.
    const Air air = {white * (kZenith / 3), white * (kZenith * 7 / 9), white * (kZenith * 0.4F)};
    Environment out;
    out.rgb = render_sphere(options, 8000, [&](Vec3 direction) {
        Vec3 radiance;
        if (look_at_land(direction, pixel_rad, seed, air, radiance)) return radiance;
        // Moon & Spencer 1942, "Illumination from a non-uniform sky"; the CIE overcast sky.
        const float level = kZenith * (1 + 2 * direction.y) / 3;
        const float up = direction.y + 0.12F;
        const float x = direction.x / up;
        const float z = direction.z / up;
        const float warp = 0.7F * fractal_noise(x, z, 2.5F, 3, 0, seed + 7);
        const float clouds =
            fractal_noise(x + warp, z - warp, 1.7F, 6, pixel_rad / (up * up), seed + 3);
        const float seen = smoothstep(0, 0.25F, direction.y);
        const Vec3 shade = mix(white, unit_luminance({0.88F, 1.0F, 1.2F}), 0.5F - 0.5F * clouds);
        return shade * (level * (1 + 0.45F * seen * clouds));
    });
    out.adaptation_cd_m2 = 3000;
    out.display_white_cd_m2 = 6500;
    return out;
}

Environment make_clear_sky(const EnvironmentOptions& options) {
    constexpr float kZenith = 2300;
    const SunPlace sun = sun_place();
    const auto sun_from_zenith = static_cast<float>(kPi / 2 - sun.elevation_rad);
    const int seed = texture_seed(options);
    const auto pixel_rad = static_cast<float>(2 * kPi / options.width);
    const Vec3 blue = unit_luminance({0.36F, 0.74F, 1.85F});
    const Vec3 pale = unit_luminance({0.92F, 1.0F, 1.16F});
    const Vec3 warm = unit_luminance({1.12F, 1.0F, 0.82F});
    // Sun 1.6e9 cd/m2 x 6.7e-5 sr x sin(41 deg) and the sky's 12000 lx, over pi.
    const Vec3 sunlight = black_body_rgb(5400) * (1.075e5F / static_cast<float>(kPi));
    const Vec3 skylight = unit_luminance({0.7F, 0.95F, 1.4F}) * (12000 / static_cast<float>(kPi));
    const Air air = {pale * 6500, sunlight * sun.direction.y + skylight,
                     sunlight * 0.55F + skylight * 0.6F};
    Environment out;
    out.rgb = render_sphere(options, 12000, [&](Vec3 direction) {
        Vec3 radiance;
        if (look_at_land(direction, pixel_rad, seed, air, radiance)) return radiance;
        const float to_sun = std::acos(std::clamp(dot(direction, sun.direction), -1.0F, 1.0F));
        const float level = kZenith * clear_sky_level(direction, to_sun, sun_from_zenith);
        const float height = 1 - std::exp(-direction.y / 0.22F);
        Vec3 colour = mix(pale, blue, height * (1 - 0.45F * std::exp(-to_sun / 0.5F)));
        colour = mix(colour, warm, 0.7F * std::exp(-to_sun / 0.12F));
        // The aureole: forward scattering by haze.
        const Vec3 sky = colour * (level + 24000 * std::exp(-to_sun / 0.05F));
        const float up = direction.y + 0.10F;
        const float x = direction.x / up;
        const float z = direction.z / up;
        const float warp = 0.9F * fractal_noise(x, z, 3.0F, 3, 0, seed + 11);
        const float wisps = fractal_noise(0.6F * x + 0.3F * z + warp, 1.5F * z - 0.5F * x, 2.1F, 6,
                                          pixel_rad / (up * up), seed + 5);
        const float amount = smoothstep(0.02F, 0.62F, wisps) * smoothstep(0.02F, 0.2F, direction.y);
        const Vec3 cloud = mix(pale, warm, 0.4F * std::exp(-to_sun / 0.3F)) * (7500 + 0.8F * level);
        return mix(sky, cloud, 0.7F * amount);
    });
    out.adaptation_cd_m2 = mean_luminance(out.rgb);
    out.display_white_cd_m2 = 16000;
    add_sun(sun, out.rgb);
    return out;
}

}  // namespace aureole::scene
