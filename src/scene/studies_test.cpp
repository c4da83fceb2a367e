#include "aureole/scene/studies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole::scene {
namespace {

View view_of(int width, int height, double fov_deg) {
    return View::from_fov(width, height, fov_deg, Projection::kPerspective);
}

// Illuminance at the eye in each colour: sum of value times solid angle.
color::Rgb light_of(const Image& picture, const View& view) {
    color::Rgb sum{};
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const double sr = view.pixel_solid_angle_sr(x, y);
            for (int c = 0; c < 3; ++c) {
                sum[static_cast<std::size_t>(c)] += sr * double{picture.at(x, y, c)};
            }
        }
    }
    return sum;
}

double cone_sr(double diameter_deg) {
    return 2 * kPi * (1 - std::cos(rad_from_deg(diameter_deg / 2)));
}

TEST(Lights, DiscsHaveTheirEnergyAtEverySizeAndPlace) {
    for (const int width : {60, 97, 480}) {
        const View view = view_of(width, width * 9 / 16, 24);
        for (const double diameter_deg : {0.01, 0.3, 4.0}) {
            for (const double x_deg : {0.0, -6.1, 7.37}) {
                const DiscLight disc = {x_deg, 2.2, diameter_deg, {1e4, 2e4, 3e4}};
                const color::Rgb light = light_of(lights_on_ground(view, {}, {disc}), view);
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(light[c] / (disc.rgb_cd_m2[c] * cone_sr(diameter_deg)), 1, 3e-3)
                        << width << " pixels, " << diameter_deg << " deg at " << x_deg;
                }
            }
        }
    }
}

TEST(Lights, PointsHaveTheirIlluminanceWhereverTheyAre) {
    const View view = view_of(64, 36, 10);
    for (int i = 0; i < 16; ++i) {
        const PointLight point = {-2 + i * view.pitch_deg / 16, 1.3, {0.1, 0.2, 0.3}};
        const color::Rgb light = light_of(lights_on_ground(view, {}, {}, {point}), view);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(light[c] / point.illuminance_lx[c], 1, 1e-4);
        }
    }
}

TEST(Lights, DiscsHideTheGround) {
    const View view = view_of(33, 33, 10);
    const Image picture = lights_on_ground(view, {5, 6, 7}, {{0, 0, 3, {1, 2, 3}}});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(picture.at(16, 16, c), 1 + c, 1e-5);
        EXPECT_NEAR(picture.at(0, 0, c), 5 + c, 1e-5);
    }
}

// Half of a lamp behind an opaque edge leaves half of its light, wherever in a pixel the edge is;
// half of half behind one that lets half through, a quarter behind holes of half the pitch.
TEST(Plates, LetThroughTheirShare) {
    const View view = view_of(200, 120, 10);
    const auto share = [&](const Plate& plate) {
        const Image open = lights_on_ground(view, {1, 1, 1}, {});
        Image behind = open;
        put_before(plate, view, behind);
        return light_of(behind, view)[0] / light_of(open, view)[0];
    };
    Plate plate;
    EXPECT_NEAR(share(plate), 0.5, 1e-5);
    plate.transmission = 0.5;
    EXPECT_NEAR(share(plate), 0.75, 1e-5);
    plate = {-90, 90};
    plate.hole_pitch_deg = 0.5;
    plate.hole_width_deg = 0.25;
    EXPECT_NEAR(share(plate), 0.25, 0.01);
    // An edge that moves by a tenth of a pixel takes away a tenth of a column.
    Plate moved;
    moved.left_deg = view.pitch_deg / 10;
    EXPECT_NEAR((share(moved) - 0.5) * view.width, 0.1, 1e-3);
}

TEST(Plates, AddTheirOwnLight) {
    const View view = view_of(20, 20, 10);
    Image picture = lights_on_ground(view, {10, 10, 10}, {});
    Plate plate;
    plate.transmission = 0.25;
    plate.rgb_cd_m2 = {1, 2, 3};
    put_before(plate, view, picture);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(picture.at(2, 5, c), 10, 1e-5);
        EXPECT_NEAR(picture.at(15, 5, c), 2.5 + 1 + c, 1e-5);
    }
}

// The flame is a candela at every moment; its light falls with the square of the distance.
TEST(CandleScene, FlameHasItsIntensity) {
    for (const double distance_m : {2.0, 8.0}) {
        for (const double time_s : {0.0, 0.37, 12.9}) {
            const Candle candle = {time_s, distance_m, 1.5};
            const color::Rgb flame = flame_illuminance_lx(candle);
            EXPECT_NEAR(color::luminance(flame), 1.5 / (distance_m * distance_m), 1e-6);
            // What is above the middle of the picture: the upper half of the flame and the wall.
            const View view = view_of(240, 136, 12 / distance_m);
            const Image picture = make_candle(view, candle).rgb;
            const Image wall = make_candle(view, {time_s, distance_m, 1e-6}).rgb;
            const double light =
                color::luminance(light_of(picture, view)) - color::luminance(light_of(wall, view));
            EXPECT_GT(light, 1.5 / (distance_m * distance_m));
            EXPECT_LT(light, 1.2 * 1.5 / (distance_m * distance_m));
        }
    }
}

// The illuminance that water mirrors depends on what a pixel can show only by its noise.
TEST(WaterSceneSlow, GlintsKeepTheirLightAtEverySize) {
    Water water;
    water.sun_elevation_deg = 40;
    const auto mean = [&](int width) {
        const View view = view_of(width, width * 9 / 16, 30);
        double sum = 0;
        constexpr int kTimes = 6;
        for (int i = 0; i < kTimes; ++i) {
            water.time_s = 3.1 * i;
            sum += color::luminance(light_of(make_water(view, water).rgb, view)) / kTimes;
        }
        return sum;
    };
    EXPECT_NEAR(mean(120) / mean(480), 1, 0.1);
}

TEST(WaterScene, GlintsOutshineTheWater) {
    const View view = view_of(320, 180, 30);
    const Image picture = make_water(view, {}).rgb;
    float brightest = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        ASSERT_TRUE(std::isfinite(picture.plane(1)[i]));
        ASSERT_GT(picture.plane(1)[i], 0);
        brightest = std::max(brightest, picture.plane(1)[i]);
    }
    EXPECT_GT(brightest, 1e5F);
}

TEST(SunsetScene, SunFadesAndReddensSmoothly) {
    color::Rgb before = setting_sun_cd_m2(10.1);
    EXPECT_GT(color::luminance(before), 1e8);
    for (double elevation_deg = 10; elevation_deg > -1; elevation_deg -= 0.05) {
        const color::Rgb sun = setting_sun_cd_m2(elevation_deg);
        EXPECT_LT(color::luminance(sun), color::luminance(before));
        EXPECT_GT(color::luminance(sun), 0.9 * color::luminance(before)) << elevation_deg;
        EXPECT_LT(sun[2] / sun[0], before[2] / before[0]);
        before = sun;
    }
    EXPECT_LT(before[2] / before[0], 0.001);
}

// Half a sun above the sea is half its light, less what refraction would do.
TEST(SunsetScene, TheSeaHidesTheSun) {
    const View view = view_of(480, 270, 8);
    const double sun = color::luminance(setting_sun_cd_m2(0)) * cone_sr(0.53);
    const double light = color::luminance(light_of(make_sunset(view, {0}).rgb, view));
    const double gone = color::luminance(light_of(make_sunset(view, {-0.3}).rgb, view));
    EXPECT_NEAR((light - gone) / sun, 0.5, 0.01);
}

// The sun's path lies below it and outshines the rest of the sea; waves are seen from the horizon
// on, least there, so that there is no line where they begin.
TEST(SunsetScene, TheSeaMirrorsTheSunAndShowsWavesEverywhere) {
    const View view = view_of(480, 270, 20);
    const Image picture = make_sunset(view, {1}).rgb;
    const auto row_mean = [&](int y, int from, int to) {
        double sum = 0;
        for (int x = from; x < to; ++x) sum += double{picture.at(x, y, 0)};
        return sum / (to - from);
    };
    for (int top = 178; top < 268; top += 10) {
        double path = 0;
        double aside = 0;
        for (int y = top; y < top + 10; ++y) {
            path += row_mean(y, 230, 250);
            aside += row_mean(y, 20, 120);
        }
        EXPECT_GT(path, 10 * aside) << top;
    }
    // Contrast along columns away from the path, in bands of 12 rows from the horizon on.
    std::vector<double> contrasts;
    for (int top = 178; top + 12 <= 270; top += 12) {
        double contrast = 0;
        for (int x = 20; x < 120; ++x) {
            double sum = 0;
            double squares = 0;
            for (int y = top; y < top + 12; ++y) {
                // Relative to its row: the sky that is mirrored changes, too.
                const double value = double{picture.at(x, y, 0)} / row_mean(y, 20, 120);
                sum += value / 12;
                squares += value * value / 12;
            }
            contrast += std::sqrt(std::max(0.0, squares - sum * sum)) / 100;
        }
        contrasts.push_back(contrast);
    }
    const auto [least, most] = std::minmax_element(contrasts.begin(), contrasts.end());
    EXPECT_EQ(least, contrasts.begin());
    EXPECT_GT(*least, 0.05);
    EXPECT_LT(*least, 0.6 * *most);
}

TEST(Studies, DoNotDependOnTheNumberOfThreads) {
    const View view = view_of(96, 54, 20);
    const auto all = [&] {
        std::vector<Image> pictures;
        pictures.push_back(make_water(view, {}).rgb);
        pictures.push_back(make_candle(view, {}).rgb);
        pictures.push_back(make_sunset(view, {}).rgb);
        return pictures;
    };
    const std::vector<Image> many = all();
    const ThreadLimit one(1);
    const std::vector<Image> single = all();
    for (std::size_t i = 0; i < many.size(); ++i) {
        EXPECT_TRUE(std::equal(many[i].plane(0), many[i].plane(0) + 3 * many[i].pixels(),
                               single[i].plane(0)));
    }
}

TEST(Studies, RefuseWhatTheyCannotDo) {
    const View view = view_of(16, 9, 20);
    EXPECT_THROW(lights_on_ground(view, {-1, 0, 0}, {}), InvalidArgument);
    EXPECT_THROW(lights_on_ground(view, {}, {{0, 0, 90, {1, 1, 1}}}), InvalidArgument);
    EXPECT_THROW(lights_on_ground(view, {}, {}, {{85, 0, {1, 1, 1}}}), InvalidArgument);
    Image picture(16, 9, 3);
    Plate plate;
    plate.transmission = 2;
    EXPECT_THROW(put_before(plate, view, picture), InvalidArgument);
    plate = {3, 2};
    EXPECT_THROW(put_before(plate, view, picture), InvalidArgument);
    Image other(9, 9, 3);
    EXPECT_THROW(put_before({}, view, other), InvalidArgument);
    EXPECT_THROW(make_water(view, {.pitch_deg = 10}), InvalidArgument);
    EXPECT_THROW(make_candle(view, {.intensity_cd = 0}), InvalidArgument);
    EXPECT_THROW(make_sunset(view, {90}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::scene
