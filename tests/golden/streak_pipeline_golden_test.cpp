// Figures 10 to 16 of Sikachev, Tisevich & Ignatenko 2008, from scenes of the same kind: streaks
// before bloom on a supersampled picture, as `aureole glare --preset sikachev` does it
// (docs/streak_pipeline.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/glare/sprites.h"
#include "aureole/image/resample.h"
#include "aureole/lens/halation.h"
#include "aureole/lens/starburst.h"
#include "aureole/scene/scene.h"
#include "golden.h"

namespace aureole {
namespace {

constexpr float kThreshold = 1;  // 100 cd/m2, white
constexpr double kError = 1e-3;
constexpr float kWhiteCdM2 = 100;
// The picture spans decades, from lamps to walls: all of them count.
constexpr golden::Tolerance kTolerance{.relative = 0.02, .floor = 1e-7, .outliers = 0.002};

struct Picture {
    Image rgb;
    View view;
};

// A street at night, of 4 samples per pixel.
const Picture& street() {
    static const Picture picture = [] {
        constexpr int kSamples = 2;
        scene::SceneOptions options;
        options.width = 256 * kSamples;
        options.height = 144 * kSamples;
        options.fov_deg = 40;
        Image rgb = area_average(scene::make_scene("night-street", options).rgb, kSamples);
        for (int c = 0; c < 3; ++c) {
            std::for_each_n(rgb.plane(c), rgb.pixels(), [](float& v) { v /= kWhiteCdM2; });
        }
        const View view = View::from_fov(rgb.width(), rgb.height(), 40, Projection::kPerspective);
        return Picture{std::move(rgb), view};
    }();
    return picture;
}

// Lamps and a sign of whole pixels, large enough for clusters of them.
const Picture& lamps() {
    static const Picture picture = [] {
        struct Lamp {
            int x, y;
            double radius;
            std::array<float, 3> color;
        };
        constexpr std::array kLamps = {Lamp{40, 30, 4.5, {900, 700, 400}},
                                       Lamp{121, 97, 6.5, {500, 550, 600}},
                                       Lamp{190, 41, 2.5, {1200, 1200, 1200}}};
        Image rgb(256, 144, 3);
        for (int y = 0; y < 144; ++y) {
            for (int x = 0; x < 256; ++x) {
                for (std::size_t c = 0; c < 3; ++c) {
                    float value = 0.02F;
                    for (const Lamp& lamp : kLamps) {
                        if (std::hypot(x - lamp.x, y - lamp.y) < lamp.radius) value = lamp.color[c];
                    }
                    // The sign leans by 1 in 3.
                    const bool sign =
                        std::abs(3 * (y - 110) - (x - 205)) < 15 && std::abs(x - 205) < 30;
                    if (sign) value = c == 0 ? 80.0F : 20.0F;
                    rgb.at(x, y, static_cast<int>(c)) = value;
                }
            }
        }
        const View view = View::from_fov(256, 144, 40, Projection::kPerspective);
        return Picture{std::move(rgb), view};
    }();
    return picture;
}

eye::Eye night_eye() {
    eye::Eye eye;
    eye.pupil_diameter_mm = 6;
    return eye;
}

wave::KernelGrid grid() { return wave::KernelGrid::full_reach(street().view); }

wave::Psf lashes() { return eye::streaks_psf(night_eye(), grid()); }

wave::Psf retina() {
    eye::Eye eye = night_eye();
    eye.streaks = 0;
    return eye::eye_psf(eye, grid());
}

wave::Psf diaphragm() { return lens::starburst_psf(lens::Iris({.blades = 6}), 3, grid()); }

// Exactly: what sprites may differ by is no matter of pictures.
Image streaks_of(const wave::Psf& psf) {
    glare::GlareOptions options;
    options.threshold = kThreshold;
    Image out(street().rgb.width(), street().rgb.height(), 3);
    glare::Glare(street().view, 3, psf, options).apply(street().rgb, out);
    return out;
}

Image bloom_of(const Image& picture, const wave::Psf& psf) {
    Image out(picture.width(), picture.height(), 3);
    glare::Glare(street().view, 3, psf).apply(picture, out);
    return out;
}

// The paper's own clusters: cells of bright pixels of similar colour, on a fixed grid.
Image clustered_streaks(int side) {
    const wave::Psf psf = diaphragm();
    const Image& in = lamps().rgb;
    Image light(in.width(), in.height(), 3);
    Image out(in.width(), in.height(), 3);
    for (std::size_t i = 0; i < 3 * in.pixels(); ++i) {
        light.plane(0)[i] = std::max(0.0F, in.plane(0)[i] - kThreshold);
    }
    glare::SpriteOptions options;
    options.error = kError;
    options.clusters.color_spread = 0.5;
    options.clusters.criterion = sources::ClusterOptions::Criterion::kSimilarColor;
    options.clusters.max_side = side;
    options.clusters.tree = false;
    const Image weights = relative_solid_angles(lamps().view);
    glare::Sprites sprites(in.width(), in.height(), 3, psf.kernel, options);
    const glare::SpriteReport report = sprites.apply(light, out, weights.plane(0));
    EXPECT_EQ(report.bright_pixels, 798U);
    EXPECT_EQ(report.sprites, side == 1 ? 798U : 288U);
    for (std::size_t i = 0; i < 3 * in.pixels(); ++i) {
        out.plane(0)[i] += in.plane(0)[i] - light.plane(0)[i];
    }
    return out;
}

TEST(StreakPipelineGolden, Figure10Bloom) {
    EXPECT_TRUE(golden::matches("sikachev-10-bloom", bloom_of(street().rgb, retina()), kTolerance));
}

TEST(StreakPipelineGolden, Figure11Streaks) {
    EXPECT_TRUE(golden::matches("sikachev-11-streaks", streaks_of(diaphragm()), kTolerance));
}

TEST(StreakPipelineGolden, Figure12StreaksAndBloom) {
    const wave::Psf film = lens::halation_psf({}, 50, grid());
    EXPECT_TRUE(golden::matches("sikachev-12-streaks-and-bloom",
                                bloom_of(streaks_of(diaphragm()), film), kTolerance));
}

TEST(StreakPipelineGolden, Figure13ClustersOfOnePixel) {
    EXPECT_TRUE(golden::matches("sikachev-13-cluster-1", clustered_streaks(1), kTolerance));
}

TEST(StreakPipelineGolden, Figure14ClustersOfTwoPixels) {
    EXPECT_TRUE(golden::matches("sikachev-14-cluster-2", clustered_streaks(2), kTolerance));
}

TEST(StreakPipelineGolden, Figure15Eyelashes) {
    EXPECT_TRUE(golden::matches("sikachev-15-eyelashes", streaks_of(lashes()), kTolerance));
}

TEST(StreakPipelineGolden, Figure16Diaphragm) {
    EXPECT_TRUE(golden::matches(
        "sikachev-16-diaphragm",
        streaks_of(lens::starburst_psf(lens::Iris({.blades = 5, .rotation_deg = 10}), 2, grid())),
        kTolerance));
}

}  // namespace
}  // namespace aureole
