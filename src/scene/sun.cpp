// Puts the `sun` scene together: land and sky by sampling, tree and fence painted over, the sun's
// disc by exact coverage.
#include "scene/adaptive.h"
#include "scene/builders.h"
#include "scene/coverage.h"
#include "scene/sun_landscape.h"

namespace aureole::scene {
namespace daylight {
namespace {

void render_land_and_sky(const Camera& camera, Image& picture) {
    struct Nothing {};
    Image no_shares(picture.width(), picture.height(), 1);
    render_adaptive<Nothing>(
        [&](double x, double y, Nothing&) {
            const Vec3 direction = normalize(camera.ray(x, y).direction);
            Vec3 radiance;
            const int what =
                land_radiance(camera.position(), direction, camera.pixel_size(), radiance);
            if (what == 0) radiance = sky_radiance(direction);
            // Textures are filtered; the edges are those between one thing and the next.
            return Sample{radiance, static_cast<float>(what), -1};
        },
        picture, no_shares);
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
    add_light(cone_outline(camera, sun_direction(), kSunRadiusDeg), sun_colour() * kSunLuminance,
              scene.rgb);
    return scene;
}

}  // namespace aureole::scene
