// The sun going down behind the sea.
#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/coverage.h"
#include "scene/noise.h"
#include "scene/study_checks.h"

namespace aureole::scene {
namespace {

constexpr double kSunRadiusDeg = 0.265;
constexpr double kSunLuminance = 1.6e9;  // cd/m2, outside the air
constexpr double kSunSolidAngleSr = 6.72e-5;
constexpr double kViewPitchDeg = 1.5;
constexpr double kGlowDeg = 5;       // e-folding angle of the glow around the sun
constexpr double kScattered = 0.05;  // share of the sun's light that haze scatters into it

// Kasten & Young 1989, "Revised optical air mass tables and approximation formula". Made for
// elevations from 0 on; below, the last slope of its logarithm goes on.
double air_mass(double elevation_deg) {
    const double e = std::max(elevation_deg, 0.0);
    const double mass = 1 / (std::sin(rad_from_deg(e)) + 0.50572 * std::pow(e + 6.07995, -1.6364));
    return mass * std::exp(-0.26 * std::min(elevation_deg, 0.0));
}

// Luminance at the horizon away from the sun.
float horizon_luminance(double sun_elevation_deg) {
    return static_cast<float>(400 * std::pow(10.0, sun_elevation_deg / 5.6));
}

class Evening {
  public:
    explicit Evening(double sun_elevation_deg)
        : level_(horizon_luminance(sun_elevation_deg)),
          glow_(vec(setting_sun_cd_m2(sun_elevation_deg)) *
                static_cast<float>(kSunSolidAngleSr * kScattered /
                                   (2 * kPi * std::pow(rad_from_deg(kGlowDeg), 2)))) {
        const auto e = static_cast<float>(rad_from_deg(sun_elevation_deg));
        sun_ = {0, std::sin(e), std::cos(e)};
    }

    Vec3 sky(Vec3 direction) const {
        static const Vec3 zenith = unit_luminance({0.5F, 0.8F, 1.6F});
        static const Vec3 pale = unit_luminance({1.0F, 0.95F, 1.0F});
        static const Vec3 ember = unit_luminance({1.6F, 0.85F, 0.4F});
        const float up = std::max(direction.y, 0.0F);
        const float to_sun = deg(std::acos(std::clamp(dot(direction, sun_), -1.0F, 1.0F)));
        const Vec3 colour = mix(mix(pale, ember, std::exp(-up / 0.06F) * std::exp(-to_sun / 30)),
                                zenith, 1 - std::exp(-up / 0.25F));
        return colour * (level_ * (0.45F + 0.55F * std::exp(-up / 0.2F))) +
               glow_ * std::exp(-to_sun / static_cast<float>(kGlowDeg));
    }

    // Ripples mirror the sky above, stretched downwards; `footprint_m` is along the view.
    Vec3 sea(Vec3 direction, float x_m, float z_m, float footprint_m) const {
        constexpr float kReflectance = 0.45F;
        const float ripples = fractal_noise(2 * x_m, z_m, 12, 4, footprint_m, 41);
        const float up = 0.03F - direction.y * (1 + 0.4F * ripples);
        const Vec3 mirrored = normalize({0.5F * direction.x, up, direction.z});
        return sky(mirrored) * (kReflectance * (1 + 0.5F * ripples));
    }

  private:
    static float deg(float rad) { return rad * 57.2957795F; }

    float level_;
    Vec3 glow_;
    Vec3 sun_;
};

}  // namespace

color::Rgb setting_sun_cd_m2(double elevation_deg) {
    constexpr color::Rgb kRayleigh = {0.062, 0.098, 0.20};
    constexpr color::Rgb kHaze = {0.06, 0.07, 0.085};
    const double mass = air_mass(elevation_deg);
    const Vec3 white = black_body_rgb(5900);
    color::Rgb rgb = {double{white.x}, double{white.y}, double{white.z}};
    for (std::size_t c = 0; c < 3; ++c) {
        rgb[c] *= kSunLuminance * std::exp(-mass * (kRayleigh[c] + kHaze[c]));
    }
    return rgb;
}

Scene make_sunset(const View& view, const Sunset& sunset) {
    check_range("sun_elevation_deg", sunset.sun_elevation_deg, -3, 15);
    constexpr float kEyeHeightM = 6;
    Scene scene{Image(view.width, view.height, 3), view, 0, 0};
    const Camera camera(view, {0, kEyeHeightM, 0}, kViewPitchDeg);
    const Evening evening(sunset.sun_elevation_deg);
    const double horizon_y = camera.horizon_y();

    const auto store = [&](int x, int y, Vec3 value, float share) {
        const std::array<float, 3> values = {value.x, value.y, value.z};
        for (int c = 0; c < 3; ++c) {
            float& pixel = scene.rgb.at(x, y, c);
            pixel += share * (values[static_cast<std::size_t>(c)] - pixel);
        }
    };
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            store(x, y, evening.sky(normalize(camera.ray(x + 0.5, y + 0.5).direction)), 1);
        }
    });
    const float white = horizon_luminance(sunset.sun_elevation_deg);
    scene.display_white_cd_m2 = 4 * double{white};

    const auto e = static_cast<float>(rad_from_deg(sunset.sun_elevation_deg));
    add_light(cone_outline(camera, {0, std::sin(e), std::cos(e)}, kSunRadiusDeg),
              vec(setting_sun_cd_m2(sunset.sun_elevation_deg)), scene.rgb);
    // The sea hides what is below the horizon.
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        const auto share = static_cast<float>(std::clamp(y + 1 - horizon_y, 0.0, 1.0));
        if (share == 0) return;
        for (int x = 0; x < view.width; ++x) {
            Vec3 look = normalize(camera.ray(x + 0.5, y + 0.5).direction);
            look.y = std::min(look.y, -2e-4F);
            const float distance = kEyeHeightM / -look.y;
            const float footprint = camera.pixel_size() * distance / -look.y;
            store(x, y, evening.sea(look, look.x * distance, look.z * distance, footprint), share);
        }
    });
    scene.adaptation_cd_m2 = 0.6 * double{white};
    return scene;
}

}  // namespace aureole::scene
