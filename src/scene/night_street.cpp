// Puts the night street together: solid things by tracing, the ground per pixel, lights by exact
// coverage.
#include "scene/night_street.h"

#include <cmath>

#include "scene/builders.h"
#include "scene/coverage.h"
#include "scene/night_render.h"
#include "scene/stars.h"

namespace aureole::scene {
namespace night {
namespace {

void add_sky_stars(const SceneOptions& options, const Camera& camera, const Image& sky_share,
                   Image& picture) {
    Random random(options.seed, 13);
    Image stars(picture.width(), picture.height(), 3);
    constexpr float kHaze = 0.7F;  // share of their light that comes through
    add_stars(winter_stars(12), camera, kHaze, stars);
    add_stars(random_stars({0, 0.26F, 0.966F}, 0.3F, 4.0F, 6.0F, random), camera, kHaze, stars);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                picture.at(x, y, c) += stars.at(x, y, c) * sky_share.at(x, y);
            }
        }
    }
}

}  // namespace

void add_luminaires(const Street& street, const std::vector<Object>& objects, const Camera& camera,
                    Image& picture) {
    std::vector<int> all(objects.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    for (const Luminaire& light : street.luminaires) {
        // Nearly at the light: it sits in the surface of its own lamp.
        const Vec3 to_light = light.centre - camera.position();
        const float distance = length(to_light);
        const Hit hit = trace(street, objects, all, {camera.position(), to_light}, 2);
        if (hit.t < 1 - 0.3F / distance) continue;
        const auto centre = camera.project(light.centre);
        const auto end_1 = camera.project(light.centre + light.half_axis_1);
        const auto end_2 = camera.project(light.centre + light.half_axis_2);
        if (!centre || !end_1 || !end_2) continue;
        const Pixel a{end_1->x - centre->x, end_1->y - centre->y};
        const Pixel b{end_2->x - centre->x, end_2->y - centre->y};
        const Polygon shape = light.rectangle
                                  ? Polygon{{centre->x - a.x - b.x, centre->y - a.y - b.y},
                                            {centre->x + a.x - b.x, centre->y + a.y - b.y},
                                            {centre->x + a.x + b.x, centre->y + a.y + b.y},
                                            {centre->x - a.x + b.x, centre->y - a.y + b.y}}
                                  : ellipse(*centre, a, b);
        add_light(shape, light.radiance, picture);
    }
}

}  // namespace night

Scene make_night_street(const SceneOptions& options, const View& view) {
    using namespace night;
    const Street street = build_street(options.seed);
    const std::vector<Object> objects = list_objects(street);
    const Camera camera(view, kEye, kEyePitchDeg);

    // White with glare in mind: the veil of the headlamps lifts the whole street.
    constexpr double kDisplayWhite = 8;  // cd/m2
    Scene scene{Image(view.width, view.height, 3), view, 0, kDisplayWhite};
    Image sky_share(view.width, view.height, 1);
    render_street(street, objects, camera, scene.rgb, sky_share);
    scene.adaptation_cd_m2 = mean_luminance(scene.rgb, 0.99);
    add_sky_stars(options, camera, sky_share, scene.rgb);
    add_luminaires(street, objects, camera, scene.rgb);
    return scene;
}

}  // namespace aureole::scene
