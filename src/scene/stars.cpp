#include "scene/stars.h"

#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/coverage.h"
#include "scene/noise.h"

namespace aureole::scene {
namespace {

struct CatalogueStar {
    double right_ascension_h;
    double declination_deg;
    double magnitude;
    double colour_index;
};

constexpr CatalogueStar kWinterSky[] = {
#include "scene/winter_sky.inc"
};
constexpr double kBeltRightAscensionH = 5.6;
constexpr double kBeltDeclinationDeg = -1.2;

// Ballesteros 2012, "New insights into black bodies", eq. 14.
float temperature_from_colour_index(double b_minus_v) {
    return static_cast<float>(4600 *
                              (1 / (0.92 * b_minus_v + 1.7) + 1 / (0.92 * b_minus_v + 0.62)));
}

// North up, east to the left, the belt ahead of the camera, raised.
Vec3 sky_direction(double right_ascension_h, double declination_deg, double elevation_deg = 0) {
    const double hour = rad_from_deg(15 * (right_ascension_h - kBeltRightAscensionH));
    const double declination = rad_from_deg(declination_deg);
    const double tilt = rad_from_deg(kBeltDeclinationDeg - elevation_deg);
    const double east = std::cos(declination) * std::sin(hour);
    const double outward = std::cos(declination) * std::cos(hour);
    const double north = std::sin(declination);
    return {static_cast<float>(-east),
            static_cast<float>(north * std::cos(tilt) - outward * std::sin(tilt)),
            static_cast<float>(outward * std::cos(tilt) + north * std::sin(tilt))};
}

// Luminance of the moonless sky, cd/m2: airglow, and the band of the Milky Way that passes east of
// Orion (Leinert et al. 1998, "The 1997 reference of diffuse night sky brightness").
Vec3 background(Vec3 direction) {
    constexpr double kPoleRightAscensionH = 12.857;
    constexpr double kPoleDeclinationDeg = 27.13;
    static const Vec3 pole = sky_direction(kPoleRightAscensionH, kPoleDeclinationDeg);
    static const Vec3 airglow = unit_luminance({0.9F, 1.0F, 1.05F}) * 1.7e-4F;
    static const Vec3 starlight = black_body_rgb(5200);
    const float sine = dot(direction, pole);
    const float clouds = 1 + 0.9F * fractal_noise(direction.x * 9, direction.y * 9, 1.6F, 5, 0, 77);
    return airglow +
           starlight * (2.6e-4F * std::exp(-square(sine / 0.14F)) * std::max(clouds, 0.1F));
}

}  // namespace

double star_illuminance_lx(double magnitude) { return 2.54e-6 * std::pow(10.0, -0.4 * magnitude); }

std::vector<Star> random_stars(Vec3 axis, float min_cosine, float brightest, float faintest,
                               Random& random) {
    constexpr double kSlope = 0.51;
    const auto number_in_sky = [](double magnitude) {
        return 4800 * std::pow(10.0, kSlope * (magnitude - 6));
    };
    const double share = (1 - min_cosine) / 2.0;
    const double bright = number_in_sky(brightest);
    const double all = number_in_sky(faintest);
    const auto count = static_cast<int>(std::lround((all - bright) * share));
    const Vec3 side = normalize(std::abs(axis.y) < 0.9F ? Vec3{axis.z, 0, -axis.x} : Vec3{1, 0, 0});
    const Vec3 up = {axis.y * side.z - axis.z * side.y, axis.z * side.x - axis.x * side.z,
                     axis.x * side.y - axis.y * side.x};
    std::vector<Star> stars;
    stars.reserve(static_cast<std::size_t>(std::max(count, 0)));
    for (int i = 0; i < count; ++i) {
        const double cosine = random.uniform(min_cosine, 1);
        const double sine = std::sqrt(1 - cosine * cosine);
        const double azimuth = random.uniform(0, 2 * kPi);
        const double rank = random.uniform(bright, all);
        const double colour_index = std::clamp(0.55 + 0.5 * random.normal(), -0.25, 1.7);
        stars.push_back({axis * static_cast<float>(cosine) +
                             side * static_cast<float>(sine * std::cos(azimuth)) +
                             up * static_cast<float>(sine * std::sin(azimuth)),
                         static_cast<float>(6 + std::log10(rank / 4800) / kSlope),
                         temperature_from_colour_index(colour_index)});
    }
    return stars;
}

std::vector<Star> winter_stars(double elevation_deg) {
    std::vector<Star> stars;
    for (const CatalogueStar& star : kWinterSky) {
        stars.push_back({sky_direction(star.right_ascension_h, star.declination_deg, elevation_deg),
                         static_cast<float>(star.magnitude),
                         temperature_from_colour_index(star.colour_index)});
    }
    return stars;
}

void add_stars(std::span<const Star> stars, const Camera& camera, float dimming, Image& picture) {
    for (const Star& star : stars) {
        const auto position = camera.project_direction(star.direction);
        if (!position) continue;
        if (position->x < -1 || position->y < -1 || position->x > picture.width() + 1 ||
            position->y > picture.height() + 1) {
            continue;
        }
        const auto illuminance = static_cast<float>(star_illuminance_lx(star.magnitude)) * dimming;
        add_point(*position, black_body_rgb(star.temperature_k) * illuminance, camera.view(),
                  picture);
    }
}

Scene make_stars(const SceneOptions& options, const View& view) {
    Scene scene{Image(view.width, view.height, 3), view, 0, 0.02};
    const Camera camera(view, {}, 0);
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            const Vec3 sky = background(normalize(camera.ray(x + 0.5, y + 0.5).direction));
            scene.rgb.at(x, y, 0) = sky.x;
            scene.rgb.at(x, y, 1) = sky.y;
            scene.rgb.at(x, y, 2) = sky.z;
        }
    });
    scene.adaptation_cd_m2 = mean_luminance(scene.rgb);

    const std::vector<Star> stars = winter_stars(0);
    add_stars(stars, camera, 1, scene.rgb);
    // The catalogue above is complete to about magnitude 4.
    Random random(options.seed, 1);
    add_stars(random_stars({0, 0, 1}, -1, 4.0F, 6.5F, random), camera, 1, scene.rgb);
    return scene;
}

}  // namespace aureole::scene
