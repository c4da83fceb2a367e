// The sun going down behind the sea (water_surface.h). Its path on the water is its reflection in
// all facets that lean the right way.
#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/coverage.h"
#include "scene/study_checks.h"
#include "scene/water_surface.h"

namespace aureole::scene {
namespace {

constexpr double kSunRadiusDeg = 0.265;
constexpr double kSunLuminance = 1.6e9;  // cd/m2, outside the air
constexpr double kSunSolidAngleSr = 6.72e-5;
constexpr double kViewPitchDeg = 1.5;
constexpr int kSamplesPerSide = 3;  // of a pixel of the sea
constexpr int kSamples = kSamplesPerSide * kSamplesPerSide;
constexpr double kGlowDeg = 5;       // e-folding angle of the glow around the sun
constexpr double kScattered = 0.05;  // share of the sun's light that haze scatters into it

// Kasten & Young 1989, "Revised optical air mass tables and approximation formula". Made for
// elevations from 0 on; below, the last slope of its logarithm goes on.
double air_mass(double elevation_deg) {
    const double e = std::max(elevation_deg, 0.0);
    const double mass = 1 / (std::sin(rad_from_deg(e)) + 0.50572 * std::pow(e + 6.07995, -1.6364));
    return mass * std::exp(-0.26 * std::min(elevation_deg, 0.0));
}

// The part of the sun that is above the horizon: its share of the disc, and the elevation of its
// middle.
struct VisibleSun {
    double share = 0;
    double elevation_deg = 0;
};

VisibleSun visible_sun(double elevation_deg) {
    const double cut = std::clamp(-elevation_deg / kSunRadiusDeg, -1.0, 1.0);  // in radii
    const double chord = std::sqrt(1 - cut * cut);
    const double area = std::acos(cut) - cut * chord;
    if (!(area > 0)) return {};
    // The centroid of a segment lies 2/3 c^3 / area above the centre.
    return {area / kPi, elevation_deg + kSunRadiusDeg * 2.0 / 3 * chord * chord * chord / area};
}

// Luminance at the horizon away from the sun.
float horizon_luminance(double sun_elevation_deg) {
    return static_cast<float>(400 * std::pow(10.0, sun_elevation_deg / 5.6));
}

class Evening {
  public:
    // `sample_size`: of a sample of the picture at distance 1.
    Evening(double sun_elevation_deg, float sample_size)
        : surface_({.wind_m_s = 3, .longest_m = 60, .waves = 40, .heading_deg = 90}),
          sample_size_(sample_size),
          level_(horizon_luminance(sun_elevation_deg)),
          glow_(vec(setting_sun_cd_m2(sun_elevation_deg)) *
                static_cast<float>(kSunSolidAngleSr * kScattered /
                                   (2 * kPi * std::pow(rad_from_deg(kGlowDeg), 2)))) {
        const auto e = static_cast<float>(rad_from_deg(sun_elevation_deg));
        sun_ = {0, std::sin(e), std::cos(e)};
        const VisibleSun visible = visible_sun(sun_elevation_deg);
        const auto middle = static_cast<float>(rad_from_deg(visible.elevation_deg));
        lit_from_ = {0, std::sin(middle), std::cos(middle)};
        illuminance_ = vec(setting_sun_cd_m2(sun_elevation_deg)) *
                       static_cast<float>(kSunSolidAngleSr * visible.share);
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

    // The sea from `height_m` above it, in a direction below the horizon. The facets that are seen
    // lean towards the eye, so that they mirror higher sky; what they let through comes back as
    // two per cent of the light of the sky.
    Vec3 sea(Vec3 direction, float height_m) const {
        static const Vec3 body = unit_luminance({0.12F, 0.45F, 0.5F});
        const float distance_m = height_m / -direction.y;
        const float across_m = sample_size_ * distance_m;
        const WaterSurface::Slopes slopes =
            surface_.at(direction * distance_m, across_m, across_m / -direction.y);
        const Vec3 to_eye = direction * -1.0F;
        const Vec3 shown = normalize({-slopes.x, 1, -slopes.z});
        const VisibleFacets facets = visible_facets(dot(shown, to_eye), std::sqrt(slopes.variance));
        const Vec3 level_to_eye = normalize({to_eye.x, 0, to_eye.z});
        const Vec3 normal = normalize(shown + level_to_eye * facets.lean);
        const float facing = std::max(dot(normal, to_eye), 0.0F);
        const float mirror = fresnel_of_water(facing);
        return body * (0.02F * level_ * (1 - mirror)) +
               sky(normalize(normal * (2 * facing) + direction)) * mirror +
               illuminance_ * glitter(slopes, lit_from_, to_eye);
    }

  private:
    static float deg(float rad) { return rad * 57.2957795F; }

    WaterSurface surface_;
    float sample_size_;
    float level_;
    Vec3 glow_;
    Vec3 sun_;
    Vec3 lit_from_;
    Vec3 illuminance_;  // of the visible sun, facing it
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
    const Evening evening(sunset.sun_elevation_deg, camera.pixel_size() / kSamplesPerSide);
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
            Vec3 sum;
            for (int i = 0; i < kSamples; ++i) {
                const auto offset = sample_offset(i);
                Vec3 look = normalize(camera.ray(x + offset[0], y + offset[1]).direction);
                look.y = std::min(look.y, -2e-4F);
                sum += evening.sea(look, kEyeHeightM);
            }
            store(x, y, sum * (1.0F / kSamples), share);
        }
    });
    scene.adaptation_cd_m2 = 0.6 * double{white};
    return scene;
}

}  // namespace aureole::scene
