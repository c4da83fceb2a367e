// The look of the thesis from a picture to its glare.
#include <gtest/gtest.h>

#include <cmath>

#include "aureole/eye/thesis_glare.h"
#include "aureole/glare/glare.h"

namespace aureole {
namespace {

constexpr double kFovDeg = 60;

// Discs of light: where, radius and brightness, in heights of the picture.
struct Lamp {
    double x, y, radius;
    float rgb[3];
};
constexpr Lamp kLamps[] = {
    {0.4, 0.5, 0.02, {20, 20, 20}}, {1.2, 0.3, 0.012, {60, 25, 3}}, {1.5, 0.7, 0.03, {4, 9, 30}}};

Image lamps(int width, int height) {
    constexpr int kSub = 4;
    Image picture(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 0.05F;
            for (const Lamp& lamp : kLamps) {
                int inside = 0;
                for (int j = 0; j < kSub; ++j) {
                    for (int i = 0; i < kSub; ++i) {
                        const double u = (x + (i + 0.5) / kSub) / height - lamp.x;
                        const double v = (y + (j + 0.5) / kSub) / height - lamp.y;
                        inside += std::hypot(u, v) < lamp.radius ? 1 : 0;
                    }
                }
                const float share = static_cast<float>(inside) / (kSub * kSub);
                for (int c = 0; c < 3; ++c) picture.at(x, y, c) += share * lamp.rgb[c];
            }
        }
    }
    return picture;
}

// What the look adds to a picture.
Image added(const Image& picture, double gain = eye::kThesisFinalGain) {
    const View view =
        View::from_fov(picture.width(), picture.height(), kFovDeg, Projection::kPerspective);
    const eye::ThesisGlare look = eye::thesis_glare({}, {}, view);
    glare::GlareOptions options;
    options.threshold = static_cast<float>(eye::kThesisThreshold);
    options.source_curve = color::ToneCurve::kUnity;
    options.gain = static_cast<float>(gain * eye::kThesisSourceFactor * look.energy);
    options.added = true;
    Image out(picture.width(), picture.height(), 3);
    glare::Glare(view, 3, look.psf, options).apply(picture, out);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < out.pixels(); ++i) out.plane(c)[i] -= picture.plane(c)[i];
    }
    return out;
}

TEST(ThesisLookSlow, IsTheSameAtHalfTheSize) {
    const Image fine = added(lamps(1280, 720));
    const Image coarse = added(lamps(640, 360));
    double difference = 0;
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < coarse.height(); ++y) {
            for (int x = 0; x < coarse.width(); ++x) {
                const double mean =
                    0.25 * (fine.at(2 * x, 2 * y, c) + fine.at(2 * x + 1, 2 * y, c) +
                            fine.at(2 * x, 2 * y + 1, c) + fine.at(2 * x + 1, 2 * y + 1, c));
                difference += std::abs(mean - coarse.at(x, y, c));
                sum += mean;
            }
        }
    }
    RecordProperty("difference", std::to_string(difference / sum));
    EXPECT_LT(difference / sum, 0.03);
}

// No cyan tint on white: all three channels add up to the same. In the middle blue is a little
// ahead, because longer waves spread wider.
TEST(ThesisLookSlow, WhiteLightHasWhiteGlare) {
    Image picture(1281, 721, 3);
    for (int y = 352; y < 369; ++y) {
        for (int x = 632; x < 649; ++x) {
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 50;
        }
    }
    const Image glare = added(picture);
    double sums[3] = {};
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < glare.pixels(); ++i) sums[c] += glare.plane(c)[i];
    }
    EXPECT_NEAR(sums[0] / sums[1], 1, 0.01);
    EXPECT_NEAR(sums[2] / sums[1], 1, 0.01);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(glare.at(640, 360, c) / glare.at(640, 360, 1), 1, 0.2);
        EXPECT_GT(glare.at(640, 360, c), 1);
    }
}

// The light of the document: nothing below the threshold, and no more than white above it.
TEST(ThesisLookSlow, BrighterThanWhiteMakesNoMoreGlare) {
    const auto light = [](float value) {
        Image picture(321, 181, 3);
        for (int c = 0; c < 3; ++c) picture.at(160, 90, c) = value;
        const Image glare = added(picture);
        double sum = 0;
        for (std::size_t i = 0; i < glare.pixels(); ++i) sum += glare.plane(1)[i];
        return sum;
    };
    EXPECT_EQ(light(4), 0);  // .88 of the curve
    const double bright = light(100);
    EXPECT_GT(bright, 0);
    EXPECT_NEAR(light(1e6F) / bright, 1, 0.1);
}

}  // namespace
}  // namespace aureole
