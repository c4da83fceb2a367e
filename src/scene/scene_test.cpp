#include "aureole/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/color/rgb.h"
#include "scene/builders.h"
#include "scene/night_render.h"

namespace aureole::scene {
namespace {

SceneOptions sized(int width, int height) {
    SceneOptions options;
    options.width = width;
    options.height = height;
    return options;
}

double luminance_at(const Image& rgb, int x, int y) {
    return color::luminance({rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)});
}

// Light from all pixels above a luminance, lx at the eye for small angles.
double bright_energy(const Image& rgb, const View& view, double threshold) {
    double sum = 0;
    for (int y = 0; y < rgb.height(); ++y) {
        for (int x = 0; x < rgb.width(); ++x) {
            const double luminance = luminance_at(rgb, x, y);
            if (luminance > threshold) sum += luminance * view.pixel_solid_angle_sr(x, y);
        }
    }
    return sum;
}

TEST(Scenes, AreListedWithDescriptions) {
    std::string names;
    for (const SceneInfo& info : list_scenes()) {
        names += std::string(info.name) + " ";
        EXPECT_FALSE(info.description.empty());
        EXPECT_LT(info.description.size(), 90U) << "one line of help";
    }
    EXPECT_EQ(names, "night-street sun stars point bars ");
}

TEST(Scenes, AreFiniteNotNegativeAndOfTheSizeAskedFor) {
    for (const SceneInfo& info : list_scenes()) {
        for (const auto& [width, height] :
             {std::pair{96, 54}, std::pair{31, 77}, std::pair{1, 1}}) {
            const Scene scene = make_scene(info.name, sized(width, height));
            ASSERT_EQ(scene.rgb.width(), width);
            ASSERT_EQ(scene.rgb.height(), height);
            ASSERT_EQ(scene.rgb.channels(), 3);
            EXPECT_EQ(scene.view.width, width);
            EXPECT_EQ(scene.view.projection, Projection::kPerspective);
            EXPECT_GT(scene.adaptation_cd_m2, 0) << info.name;
            EXPECT_GT(scene.display_white_cd_m2, 0);
            for (std::size_t i = 0; i < 3 * scene.rgb.pixels(); ++i) {
                const float v = scene.rgb.plane(0)[i];
                ASSERT_TRUE(std::isfinite(v) && v >= 0) << info.name << " " << i << ": " << v;
            }
        }
    }
}

TEST(Scenes, FieldOfViewIsTheirOwnUnlessGiven) {
    SceneOptions options = sized(200, 100);
    for (const SceneInfo& info : list_scenes()) {
        options.fov_deg.reset();
        const View own = make_scene(info.name, options).view;
        EXPECT_NEAR(2 * own.angle_from_axis_deg(0, 50), info.default_fov_deg, 1e-9);
        options.fov_deg = 25;
        const View given = make_scene(info.name, options).view;
        EXPECT_NEAR(2 * given.angle_from_axis_deg(0, 50), 25, 1e-9);
    }
}

TEST(Scenes, DoNotDependOnTheNumberOfThreads) {
    for (const SceneInfo& info : list_scenes()) {
        const Scene many = make_scene(info.name, sized(160, 90));
        const ThreadLimit limit(1);
        const Scene one = make_scene(info.name, sized(160, 90));
        for (std::size_t i = 0; i < 3 * many.rgb.pixels(); ++i) {
            ASSERT_EQ(many.rgb.plane(0)[i], one.rgb.plane(0)[i]) << info.name << " " << i;
        }
    }
}

TEST(Scenes, SeedsMakeDifferentPictures) {
    for (const char* name : {"night-street", "sun", "stars"}) {
        SceneOptions options = sized(96, 54);
        const Scene first = make_scene(name, options);
        options.seed = 2;
        const Scene second = make_scene(name, options);
        bool differ = false;
        for (std::size_t i = 0; i < first.rgb.pixels(); ++i) {
            differ = differ || first.rgb.plane(1)[i] != second.rgb.plane(1)[i];
        }
        EXPECT_TRUE(differ) << name;
    }
}

// Textures are filtered: a small picture is a large one averaged. Lights are left out by a limit.
TEST(Scenes, LookTheSameAtEverySize) {
    const std::pair<const char*, double> cases[] = {{"night-street", 3}, {"sun", 5e4}};
    for (const auto& [name, limit] : cases) {
        const Image small = make_scene(name, sized(240, 135)).rgb;
        const Image large = make_scene(name, sized(960, 540)).rgb;
        constexpr int kBlock = 15;  // pixels of the small picture
        double difference = 0;
        double sum = 0;
        for (int by = 0; by < 135 / kBlock; ++by) {
            for (int bx = 0; bx < 240 / kBlock; ++bx) {
                const auto mean = [&, most = limit](const Image& rgb, int size) {
                    double total = 0;
                    for (int y = by * size; y < (by + 1) * size; ++y) {
                        for (int x = bx * size; x < (bx + 1) * size; ++x) {
                            total += std::min(luminance_at(rgb, x, y), most);
                        }
                    }
                    return total / (size * size);
                };
                const double a = mean(small, kBlock);
                difference += std::abs(a - mean(large, 4 * kBlock));
                sum += a;
            }
        }
        EXPECT_LT(difference / sum, 0.04) << name;
    }
}

TEST(Scenes, RefuseWhatTheyCannotDo) {
    EXPECT_THROW(make_scene("moon"), InvalidArgument);
    EXPECT_THROW(make_scene("sun", sized(0, 10)), InvalidArgument);
    EXPECT_THROW(make_scene("sun", sized(10, 40000)), InvalidArgument);
    SceneOptions wide = sized(10, 10);
    wide.fov_deg = 171;
    EXPECT_THROW(make_scene("sun", wide), InvalidArgument);
    wide.fov_deg = 0;
    EXPECT_THROW(make_scene("sun", wide), InvalidArgument);
    SceneOptions point = sized(10, 10);
    point.point_x = 10;
    EXPECT_THROW(make_scene("point", point), InvalidArgument);
    point.point_x = 9;
    point.point_cd_m2 = -1;
    EXPECT_THROW(make_scene("point", point), InvalidArgument);
    try {
        make_scene("moon");
    } catch (const InvalidArgument& error) {
        EXPECT_NE(std::string(error.what()).find("night-street"), std::string::npos)
            << error.what();
    }
}

TEST(NightStreet, LightsKeepTheirEnergyAtEverySize) {
    using namespace night;
    Street street = build_street(1);
    const auto objects = list_objects(street);
    const auto all = street.luminaires;
    int seen = 0;
    for (const Luminaire& luminaire : all) {
        street.luminaires = {luminaire};
        double reference = 0;
        for (const int height : {540, 1080, 2160}) {
            const View view = View::from_fov(height * 16 / 9, height, 60, Projection::kPerspective);
            static Image picture;  // one allocation per size
            if (picture.height() != height) picture = Image(view.width, view.height, 3);
            const Camera camera(view, kEye, kEyePitchDeg);
            const auto centre = camera.project(luminaire.centre);
            ASSERT_TRUE(centre);
            // Whole lights in the picture only, and only the pixels about them.
            const double reach = 0.02 * view.width;
            if (centre->x < reach || centre->y < reach || centre->x > view.width - reach) break;
            add_luminaires(street, objects, camera, picture);
            double sum = 0;
            for (int y = static_cast<int>(centre->y - reach); y < centre->y + reach; ++y) {
                for (int x = static_cast<int>(centre->x - reach); x < centre->x + reach; ++x) {
                    sum += luminance_at(picture, x, y) * view.pixel_solid_angle_sr(x, y);
                    for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 0;
                }
            }
            if (sum == 0) break;  // hidden, at every size
            if (reference == 0) {
                reference = sum;
                ++seen;
                // Luminance times projected area over distance squared; all face the camera's -z.
                const Vec3 d = luminaire.centre - kEye;
                const double projected = (luminaire.rectangle ? 4.0 : kPi) *
                                         double{length(luminaire.half_axis_1)} *
                                         double{length(luminaire.half_axis_2)};
                const double distance = length(d);
                const double expected = double{luminance(luminaire.radiance)} * projected *
                                        double{d.z} / (distance * distance * distance);
                EXPECT_NEAR(sum / expected, 1, 0.005);
            }
            EXPECT_NEAR(sum / reference, 1, 0.005) << height;
        }
    }
    EXPECT_GT(seen, 20);
}

TEST(NightStreet, HasTheLuminancesOfANightStreet) {
    const Scene scene = make_scene("night-street", sized(960, 540));
    double brightest = 0;
    for (int y = 0; y < 540; ++y) {
        for (int x = 0; x < 960; ++x)
            brightest = std::max(brightest, luminance_at(scene.rgb, x, y));
    }
    EXPECT_GT(brightest, 3e5) << "headlamps of 1e6 cd/m2, about a pixel large";
    EXPECT_LT(brightest, 1.01e6);
    EXPECT_GT(scene.adaptation_cd_m2, 0.1);
    EXPECT_LT(scene.adaptation_cd_m2, 1);
    EXPECT_LT(luminance_at(scene.rgb, 480, 60), 0.5) << "sky";
}

TEST(Sun, HasTheRealSunsEnergyAtEverySize) {
    const double exact = 1.6e9 * 2 * kPi * (1 - std::cos(rad_from_deg(0.265)));
    for (const int width : {240, 480, 960, 1920}) {
        const Scene scene = make_scene("sun", sized(width, width * 9 / 16));
        EXPECT_NEAR(bright_energy(scene.rgb, scene.view, 1e6) / exact, 1, 0.005) << width;
    }
}

TEST(Sun, HasDarkThingsAgainstTheLight) {
    const Scene scene = make_scene("sun", sized(480, 270));
    int dark = 0;
    for (int y = 0; y < 270; ++y) {
        for (int x = 0; x < 480; ++x) dark += luminance_at(scene.rgb, x, y) < 250 ? 1 : 0;
    }
    EXPECT_GT(dark, 480 * 270 / 50);
    EXPECT_GT(scene.adaptation_cd_m2, 1000);
    EXPECT_LT(scene.adaptation_cd_m2, 20000);
}

TEST(StarsScene, HasADarkSkyBetweenStars) {
    const Scene scene = make_scene("stars", sized(480, 270));
    EXPECT_GT(scene.adaptation_cd_m2, 1e-4);
    EXPECT_LT(scene.adaptation_cd_m2, 1e-3);
    // Sirius alone is 9.7e-6 lx.
    EXPECT_GT(bright_energy(scene.rgb, scene.view, 0.003), 9.7e-6);
}

TEST(Point, IsOnePixel) {
    SceneOptions options = sized(33, 21);
    options.point_cd_m2 = 4;
    const Scene centred = make_scene("point", options);
    EXPECT_EQ(centred.rgb.at(16, 10, 0), 4);
    options.point_x = 0;
    options.point_y = 20;
    const Scene scene = make_scene("point", options);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t i = 0; i < scene.rgb.pixels(); ++i) sum += double{scene.rgb.plane(c)[i]};
        EXPECT_EQ(sum, 4);
        EXPECT_EQ(scene.rgb.at(0, 20, c), 4);
    }
}

TEST(Bars, StepsAreHalfDecades) {
    const Scene scene = make_scene("bars", sized(960, 540));
    for (int i = 0; i < 15; ++i) {
        const int x = static_cast<int>(960 * (0.04 + 0.92 * (i + 0.5) / 15));
        EXPECT_NEAR(luminance_at(scene.rgb, x, 80) / std::pow(10, -2 + 0.5 * i), 1, 1e-4);
    }
}

TEST(Bars, ThinBarsHaveTheirAngularWidthAtEverySize) {
    const double widths_deg[] = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
    for (const int width : {960, 1920, 3840}) {
        const Scene scene = make_scene("bars", sized(width, 540));
        const double f = scene.view.focal_length_px();
        for (int i = 0; i < 7; ++i) {
            const double centre = width * (0.1 + 0.085 * i);
            const double u = (centre - scene.view.axis_x) / f;
            double light = 0;  // luminance times angle along a row
            for (int x = static_cast<int>(centre - 0.03 * width); x < centre + 0.03 * width; ++x) {
                light += (luminance_at(scene.rgb, x, 470) - 0.01) / (f * (1 + u * u));
            }
            EXPECT_NEAR(light / (1e5 * rad_from_deg(widths_deg[i])), 1, 0.002) << width << " " << i;
        }
    }
}

TEST(BlackBody, IsOrangeThenWhiteThenBlue) {
    const Vec3 sodium = black_body_rgb(2000);
    const Vec3 daylight = black_body_rgb(6600);
    const Vec3 sky = black_body_rgb(20000);
    EXPECT_GT(sodium.x, 2 * sodium.y);
    EXPECT_NEAR(daylight.x, daylight.z, 0.12);
    EXPECT_GT(sky.z, 1.3F * sky.x);
    for (const Vec3 c : {sodium, daylight, sky}) EXPECT_NEAR(luminance(c), 1, 1e-5);
}

}  // namespace
}  // namespace aureole::scene
