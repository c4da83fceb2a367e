// Sun glints on water (water_surface.h).
#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/study_checks.h"
#include "scene/water_surface.h"

namespace aureole::scene {
namespace {

constexpr int kSamplesPerSide = 3;
constexpr float kSunIlluminance = 1e5F;  // lx, facing the sun

Vec3 sky(Vec3 direction) {
    static const Vec3 low = unit_luminance({0.92F, 1.0F, 1.12F}) * 3000;
    static const Vec3 high = unit_luminance({0.45F, 0.85F, 1.7F}) * 1500;
    return mix(low, high, smoothstep(0, 0.5F, std::max(direction.y, 0.0F)));
}

class Reflections {
  public:
    Reflections(const Water& water, float sample_size)
        : surface_({.wind_m_s = water.wind_m_s, .time_s = water.time_s, .seed = water.seed}),
          sample_size_(sample_size) {
        const auto elevation = static_cast<float>(rad_from_deg(water.sun_elevation_deg));
        sun_ = {0, std::sin(elevation), std::cos(elevation)};
        sun_rgb_ = black_body_rgb(5300) * kSunIlluminance;
        body_ = unit_luminance({0.12F, 0.45F, 0.5F}) * 160;
    }

    // Towards the eye, from a point of the water seen in `view` (unit vector, downwards).
    Vec3 radiance(Vec3 point, float distance, Vec3 view) const {
        const float across_m = sample_size_ * distance;
        const WaterSurface::Slopes slopes = surface_.at(point, across_m, across_m / -view.y);
        const Vec3 normal = normalize({-slopes.x, 1, -slopes.z});
        const Vec3 to_eye = view * -1.0F;
        const float facing = std::max(dot(normal, to_eye), 0.02F);
        const float mirror = fresnel_of_water(facing);
        return body_ * (1 - mirror) + sky(normal * (2 * dot(normal, to_eye)) + view) * mirror +
               sun_rgb_ * glitter(slopes, sun_, to_eye);
    }

  private:
    WaterSurface surface_;
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
    const Reflections surface(water, camera.pixel_size() / kSamplesPerSide);
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
