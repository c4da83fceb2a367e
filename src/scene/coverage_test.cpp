#include "scene/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/noise.h"
#include "scene/silhouette.h"
#include "scene/stars.h"

namespace aureole::scene {
namespace {

double total(const std::vector<PixelCoverage>& pixels) {
    double sum = 0;
    for (const PixelCoverage& p : pixels) sum += double{p.share};
    return sum;
}

double energy(const Image& picture, const View& view, int channel) {
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            sum += double{picture.at(x, y, channel)} * view.pixel_solid_angle_sr(x, y);
        }
    }
    return sum;
}

TEST(Coverage, SharesAddUpToTheArea) {
    for (const double size : {0.01, 0.3, 1.0, 7.7}) {
        for (const double x : {5.0, 5.5, 5.99, 6.313}) {
            const Polygon disc =
                ellipse({x + 10, 18.2}, {size, 0.2 * size}, {-0.1 * size, 0.5 * size});
            const double exact = kPi * (size * 0.5 * size + 0.2 * size * 0.1 * size);
            EXPECT_NEAR(area(disc) / exact, 1, 1e-9);
            EXPECT_NEAR(total(coverage(disc, 40, 40)) / exact, 1, 1e-5) << size << " at " << x;
        }
    }
}

TEST(Coverage, OfATriangleIsExactPerPixel) {
    const auto pixels = coverage({{0, 0}, {2, 0}, {0, 2}}, 4, 4);
    ASSERT_EQ(pixels.size(), 3U);  // the pixel on the far side of the edge is not touched
    for (const PixelCoverage& p : pixels) {
        EXPECT_FLOAT_EQ(p.share, p.x == 0 && p.y == 0 ? 1.0F : 0.5F);
    }
}

TEST(Coverage, EndsAtThePicture) {
    const Polygon square = {{-3, -3}, {2.5, -3}, {2.5, 1.25}, {-3, 1.25}};
    EXPECT_NEAR(total(coverage(square, 10, 10)), 2.5 * 1.25, 1e-6);
    EXPECT_TRUE(coverage({{20, 20}, {21, 20}, {20, 21}}, 10, 10).empty());
}

TEST(AddPoint, EnergyIsTheIlluminanceWhereverItFalls) {
    const View view = View::from_fov(64, 36, 60, Projection::kPerspective);
    for (const double x : {10.0, 10.25, 31.9, 58.5}) {
        Image picture(64, 36, 3);
        add_point({x, 17.3}, {2e-6F, 1e-6F, 0}, view, picture);
        EXPECT_NEAR(energy(picture, view, 0) / 2e-6, 1, 1e-5) << x;
        EXPECT_NEAR(energy(picture, view, 1) / 1e-6, 1, 1e-5) << x;
    }
}

TEST(AddLight, LightsThatShareAPixelKeepTheirEnergy) {
    Image picture(3, 3, 3);
    const Polygon left = {{1.0, 1.0}, {1.4, 1.0}, {1.4, 2.0}, {1.0, 2.0}};
    const Polygon right = {{1.5, 1.0}, {1.9, 1.0}, {1.9, 2.0}, {1.5, 2.0}};
    add_light(left, {100, 100, 100}, picture);
    add_light(right, {100, 100, 100}, picture);
    EXPECT_NEAR(picture.at(1, 1, 0), 80, 1e-3);
}

TEST(Camera, ProjectInvertsRay) {
    const View view = View::from_fov(1920, 1080, 70, Projection::kPerspective);
    const Camera camera(view, {1, 2, 3}, 4);
    for (const auto& [x, y] :
         {std::pair{0.5, 0.5}, std::pair{960.0, 540.0}, std::pair{1900.2, 30.7}}) {
        const Ray ray = camera.ray(x, y);
        const Vec3 point = ray.at(17);
        EXPECT_NEAR(camera.depth(point), 17, 1e-4);
        const auto pixel = camera.project(point);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x, x, 2e-3);
        EXPECT_NEAR(pixel->y, y, 2e-3);
    }
    EXPECT_FALSE(camera.project({1, 2, 0}).has_value()) << "behind";
}

TEST(Camera, LevelDirectionsLieOnTheHorizon) {
    const View view = View::from_fov(400, 300, 60, Projection::kPerspective);
    const Camera camera(view, {}, 7);
    for (const float x : {-0.4F, 0.0F, 0.5F}) {
        EXPECT_NEAR(camera.project_direction({x, 0, 1})->y, camera.horizon_y(), 1e-3);
    }
    EXPECT_NEAR(camera.horizon_y(), 150 + view.focal_length_px() * std::tan(rad_from_deg(7)), 1e-3);
}

TEST(Stars, FollowPogsonsLaw) {
    EXPECT_NEAR(star_illuminance_lx(0), 2.54e-6, 1e-9);
    EXPECT_NEAR(star_illuminance_lx(1) / star_illuminance_lx(6), 100, 1e-9);
}

TEST(Stars, AreAsManyAsTheRealSkyHas) {
    Random random(5);
    const auto stars = random_stars({0, 0, 1}, -1, 2, 6, random);
    int below_5 = 0;
    Vec3 mean;
    for (const Star& star : stars) {
        EXPECT_GE(star.magnitude, 2);
        EXPECT_LE(star.magnitude, 6);
        EXPECT_NEAR(length(star.direction), 1, 1e-4);
        below_5 += star.magnitude < 5 ? 1 : 0;
        mean += star.direction * (1 / static_cast<float>(stars.size()));
    }
    EXPECT_NEAR(static_cast<double>(stars.size()), 4800, 100);
    EXPECT_NEAR(below_5, 4800 * std::pow(10, -0.51) - 44, 100);
    EXPECT_LT(length(mean), 0.05) << "even over the sky";
}

TEST(Stars, KeepTheirEnergyAtEveryPictureSize) {
    const auto stars = winter_stars(0);
    double reference = 0;
    for (const int width : {960, 1920, 3840}) {
        const View view = View::from_fov(width, width * 9 / 16, 60, Projection::kPerspective);
        Image picture(view.width, view.height, 3);
        add_stars(stars, Camera(view, {}, 0), 1, picture);
        const double sum = energy(picture, view, 1);
        if (reference == 0) reference = sum;
        EXPECT_NEAR(sum / reference, 1, 0.005) << width;
    }
    EXPECT_GT(reference, star_illuminance_lx(-1.46)) << "Sirius is in view";
}

TEST(Noise, StripesAreBoxFiltered) {
    for (const float width : {0.01F, 0.4F, 1.7F}) {
        for (const float x : {-2.3F, 0.05F, 0.9F, 7.2F}) {
            double mean = 0;
            constexpr int kSteps = 20000;
            for (int i = 0; i < kSteps; ++i) {
                const double at = double{x} + double{width} * ((i + 0.5) / kSteps - 0.5);
                mean += at - std::floor(at) < 0.3 ? 1.0 / kSteps : 0;
            }
            EXPECT_NEAR(stripe_coverage(x, 1, 0.3F, width), mean, 2e-3) << x << " " << width;
        }
    }
}

TEST(Noise, IsContinuousAndBounded) {
    float previous = value_noise(-3, 0.7F, 9);
    for (float x = -3; x < 3; x += 0.01F) {
        const float v = value_noise(x, 0.7F, 9);
        EXPECT_NEAR(v, previous, 0.06F);
        EXPECT_LE(std::abs(v), 1);
        previous = v;
    }
    EXPECT_EQ(fractal_noise(0.3F, 0.4F, 1, 4, 2, 1), 0) << "finer than the filter";
}

TEST(Paint, StrokeCoversItsArea) {
    Image picture(60, 40, 3);
    Stroke stroke{{10, 10}, {45, 22}, 3, 1.5F, 5, {1, 1, 1}, 0, true};
    std::vector<Stroke> strokes = {stroke};
    paint(strokes, picture);
    double sum = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i) sum += double{picture.plane(0)[i]};
    EXPECT_NEAR(sum / (std::hypot(35, 12) * 4.5), 1, 0.02);
}

TEST(Paint, NearHidesFar) {
    Image picture(20, 20, 3);
    std::vector<Stroke> strokes = {{{2, 10}, {18, 10}, 4, 4, 1, {1, 0, 0}, 0, false},
                                   {{10, 2}, {10, 18}, 4, 4, 9, {0, 1, 0}, 0, false}};
    paint(strokes, picture);
    EXPECT_FLOAT_EQ(picture.at(10, 10, 0), 1);
    EXPECT_FLOAT_EQ(picture.at(10, 10, 1), 0);
    EXPECT_FLOAT_EQ(picture.at(10, 3, 1), 1);
}

}  // namespace
}  // namespace aureole::scene
