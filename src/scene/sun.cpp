// Puts the `sun` scene together: land and sky by sampling, tree and fence painted over, the sun's
// disc by exact coverage.
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "scene/builders.h"
#include "scene/coverage.h"
#include "scene/sun_landscape.h"

namespace aureole::scene {
namespace daylight {
namespace {

constexpr int kFirstSamples = 2;
constexpr int kMoreSamples = 6;
constexpr float kContrast = 0.5F;  // within a pixel, beyond which more samples are taken

struct Seen {
    int what;
    Vec3 radiance;
};

Seen look(const Camera& camera, double x, double y) {
    const Vec3 direction = normalize(camera.ray(x, y).direction);
    Vec3 land;
    const int what = land_radiance(camera.position(), direction, camera.pixel_size(), land);
    return {what, what > 0 ? land : sky_radiance(direction)};
}

void render_land_and_sky(const Camera& camera, Image& picture) {
    parallel_for(static_cast<std::size_t>(picture.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < picture.width(); ++x) {
            Vec3 sum;
            float low = 1e9F;
            float high = 0;
            int count = 0;
            int first = 0;
            bool edge = false;
            const auto sample = [&](int samples) {
                for (int i = 0; i < samples; ++i, ++count) {
                    const auto offset = pixel_sample(x, y, count);
                    const Seen seen = look(camera, x + offset[0], y + offset[1]);
                    if (count == 0) first = seen.what;
                    edge = edge || seen.what != first;
                    low = std::min(low, luminance(seen.radiance));
                    high = std::max(high, luminance(seen.radiance));
                    sum += seen.radiance;
                }
            };
            sample(kFirstSamples);
            if (edge || high > (1 + kContrast) * low) sample(kMoreSamples);
            const Vec3 mean = sum * (1 / static_cast<float>(count));
            picture.at(x, y, 0) = mean.x;
            picture.at(x, y, 1) = mean.y;
            picture.at(x, y, 2) = mean.z;
        }
    });
}

// The disc as the true projection of a cone of light.
Polygon sun_outline(const Camera& camera) {
    constexpr int kSides = 96;
    const Vec3 sun = sun_direction();
    const Vec3 right = normalize(Vec3{sun.z, 0, -sun.x});
    const Vec3 up = {sun.y * right.z - sun.z * right.y, sun.z * right.x - sun.x * right.z,
                     sun.x * right.y - sun.y * right.x};
    // A regular polygon of equal area.
    const double grow = std::sqrt(kPi / (kSides / 2.0 * std::sin(2 * kPi / kSides)));
    const double radius = std::tan(rad_from_deg(kSunRadiusDeg)) * grow;
    Polygon outline;
    for (int i = 0; i < kSides; ++i) {
        const auto c = static_cast<float>(radius * std::cos(2 * kPi * i / kSides));
        const auto s = static_cast<float>(radius * std::sin(2 * kPi * i / kSides));
        const auto pixel = camera.project_direction(sun + right * c + up * s);
        if (!pixel) return {};
        outline.push_back(*pixel);
    }
    return outline;
}

}  // namespace
}  // namespace daylight

Scene make_sun(const SceneOptions& options, const View& view) {
    using namespace daylight;
    Scene scene{Image(view.width, view.height, 3), view, 0, 9000};
    const Camera camera(view, kEye, kEyePitchDeg);
    render_land_and_sky(camera, scene.rgb);
    std::vector<Stroke> strokes;
    Random growth(options.seed, 21);
    add_tree(camera, growth, strokes);
    Random carpentry(options.seed, 22);
    add_fence(camera, carpentry, strokes);
    Random meadow(options.seed, 23);
    add_grass(camera, meadow, strokes);
    paint(strokes, scene.rgb);
    scene.adaptation_cd_m2 = mean_luminance(scene.rgb);
    add_light(sun_outline(camera), sun_colour() * kSunLuminance, scene.rgb);
    return scene;
}

}  // namespace aureole::scene
