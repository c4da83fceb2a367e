// Sun glints on water.
//
// The surface is a sum of sines with slopes s(x, z, t). What a pixel cannot show of them becomes
// slope variance v, isotropic and normally distributed, and the sun of irradiance E (lx) is seen as
// (Cox & Munk 1954)
//     L = E F p(h - s) / (4 cos(theta_v) h_y^4),   p(d) = exp(-d^2 / 2v) / (2 pi v),
// h being the slope that mirrors the sun into the eye, F the reflectance of the facet and theta_v
// the angle between view and vertical.
#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/noise.h"
#include "scene/study_checks.h"

namespace aureole::scene {
namespace {

constexpr int kWaves = 26;
constexpr double kLongestM = 5;
constexpr double kShortestM = 0.1;
constexpr float kRippleVariance = 4e-4F;  // per axis, of what is shorter
constexpr int kSamplesPerSide = 3;
constexpr float kSunIlluminance = 1e5F;  // lx, facing the sun
constexpr float kPi32 = 3.14159265F;

struct Wave {
    float kx = 0;  // rad per m
    float kz = 0;
    float length_m = 0;
    float slope = 0;  // amplitude
    float phase = 0;  // at the moment
};

// Slope variance by wind speed, both axes (Cox & Munk 1954), shared equally by the waves: slopes of
// wind waves are about as strong in every octave.
std::vector<Wave> make_waves(const Water& water) {
    const double variance = 0.003 + 0.00512 * water.wind_m_s - 2 * double{kRippleVariance};
    Random random(water.seed, 31);
    std::vector<Wave> waves;
    for (int i = 0; i < kWaves; ++i) {
        const double rank = (i + random.uniform()) / kWaves;
        const double length = kLongestM * std::pow(kShortestM / kLongestM, rank);
        // The wind blows across the view; waves run within some 50 deg of it.
        const double heading = rad_from_deg(20 + 50 * random.normal());
        const double k = 2 * kPi / length;
        constexpr double kGravity = 9.81;
        constexpr double kTension = 7.3e-5;  // surface tension over density, m3/s2
        const double rate = std::sqrt(kGravity * k + kTension * k * k * k);
        // A full turn taken off in double precision, for times of any size.
        const double phase = random.uniform() + rate * water.time_s / (2 * kPi);
        waves.push_back({static_cast<float>(k * std::cos(heading)),
                         static_cast<float>(k * std::sin(heading)), static_cast<float>(length),
                         static_cast<float>(std::sqrt(2 * variance / kWaves)),
                         static_cast<float>(2 * kPi * (phase - std::floor(phase)))});
    }
    return waves;
}

// Unpolarised reflectance of water (index 1.333) by Fresnel's law.
float fresnel(float cosine) {
    constexpr float kIndex = 1.333F;
    const float g = std::sqrt(kIndex * kIndex - 1 + cosine * cosine);
    const float a = square((g - cosine) / (g + cosine));
    const float b = square((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1));
    return 0.5F * a * (1 + b);
}

Vec3 sky(Vec3 direction) {
    static const Vec3 low = unit_luminance({0.92F, 1.0F, 1.12F}) * 3000;
    static const Vec3 high = unit_luminance({0.45F, 0.85F, 1.7F}) * 1500;
    return mix(low, high, smoothstep(0, 0.5F, std::max(direction.y, 0.0F)));
}

class Surface {
  public:
    Surface(const Water& water, float sample_size)
        : waves_(make_waves(water)), sample_size_(sample_size) {
        const auto elevation = static_cast<float>(rad_from_deg(water.sun_elevation_deg));
        sun_ = {0, std::sin(elevation), std::cos(elevation)};
        sun_rgb_ = black_body_rgb(5300) * kSunIlluminance;
        body_ = unit_luminance({0.12F, 0.45F, 0.5F}) * 160;
    }

    // Towards the eye, from a point of the water seen in `view` (unit vector, downwards).
    Vec3 radiance(Vec3 point, float distance, Vec3 view) const {
        const float across = sample_size_ * distance;  // of the sample on the water, m
        const float along = across / -view.y;
        float slope_x = 0;
        float slope_z = 0;
        float variance = kRippleVariance;
        for (const Wave& wave : waves_) {
            const float k = 2 * kPi32 / wave.length_m;
            const float width = std::hypot(across * wave.kx, along * wave.kz) / k;
            const float shown = survives(wave.length_m, width);
            variance += 0.25F * square(wave.slope) * (1 - square(shown));
            if (shown <= 0) continue;
            const float slope =
                shown * wave.slope * std::cos(wave.kx * point.x + wave.kz * point.z - wave.phase);
            slope_x += slope * wave.kx / k;
            slope_z += slope * wave.kz / k;
        }
        const Vec3 normal = normalize({-slope_x, 1, -slope_z});
        const Vec3 to_eye = view * -1.0F;
        const float facing = std::max(dot(normal, to_eye), 0.02F);
        const float mirror = fresnel(facing);
        Vec3 light = body_ * (1 - mirror) + sky(normal * (2 * dot(normal, to_eye)) + view) * mirror;

        const Vec3 half = normalize(sun_ + to_eye);
        const float off = square(-half.x / half.y - slope_x) + square(-half.z / half.y - slope_z);
        const float density = std::exp(-off / (2 * variance)) / (2 * kPi32 * variance);
        light += sun_rgb_ * (fresnel(dot(half, to_eye)) * density /
                             (4 * std::max(to_eye.y, 0.02F) * square(square(half.y))));
        return light;
    }

  private:
    std::vector<Wave> waves_;
    float sample_size_;
    Vec3 sun_;
    Vec3 sun_rgb_;
    Vec3 body_;
};

}  // namespace

Scene make_water(const View& view, const Water& water) {
    check_range("eye_height_m", water.eye_height_m, 0.1, 1000);
    check_range("pitch_deg", water.pitch_deg, -80, 0);
    check_range("sun_elevation_deg", water.sun_elevation_deg, 5, 85);
    check_range("wind_m_s", water.wind_m_s, 0.5, 15);
    check_range("time_s", water.time_s, -1e6, 1e6);
    Scene scene{Image(view.width, view.height, 3), view, 1500, 6000};
    const Camera camera(view, {0, static_cast<float>(water.eye_height_m), 0}, water.pitch_deg);
    const Surface surface(water, camera.pixel_size() / kSamplesPerSide);
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            Vec3 sum;
            for (int i = 0; i < kSamplesPerSide * kSamplesPerSide; ++i) {
                const auto offset = sample_offset(i);
                const Vec3 look = normalize(camera.ray(x + offset[0], y + offset[1]).direction);
                if (look.y > -1e-4F) {
                    sum += sky(look);
                    continue;
                }
                const float distance = camera.position().y / -look.y;
                sum += surface.radiance(camera.position() + look * distance, distance, look);
            }
            const Vec3 mean = sum * (1.0F / (kSamplesPerSide * kSamplesPerSide));
            scene.rgb.at(x, y, 0) = mean.x;
            scene.rgb.at(x, y, 1) = mean.y;
            scene.rgb.at(x, y, 2) = mean.z;
        }
    });
    return scene;
}

}  // namespace aureole::scene
