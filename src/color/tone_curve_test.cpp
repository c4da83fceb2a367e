#include "aureole/color/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/color/rgb.h"
#include "color/tone_kernels.h"

namespace aureole::color {
namespace {

constexpr ToneCurve kCurves[] = {ToneCurve::kNone, ToneCurve::kNarkowicz, ToneCurve::kHill,
                                 ToneCurve::kXyz, ToneCurve::kUnity};

// What the brightest white becomes.
double white_of(ToneCurve curve) {
    return curve == ToneCurve::kUnity ? std::pow(278.5085 / 293.6045, 0.9811) : 1.0;
}

float luminance(const Rgbf& rgb) {
    return static_cast<float>(color::luminance(Rgb{rgb[0], rgb[1], rgb[2]}));
}

TEST(ToneCurve, GreyStaysNeutralAndRises) {
    for (const ToneCurve curve : kCurves) {
        float previous = -1;
        for (float v = 1e-5F; v < 1e7F; v *= 1.07F) {
            const Rgbf out = tone_map(curve, {v, v, v});
            EXPECT_NEAR(out[1], out[0], 1e-6F) << v;
            EXPECT_NEAR(out[2], out[0], 1e-6F) << v;
            EXPECT_GE(out[0], previous - 1e-6F) << v;
            previous = out[0];
        }
        EXPECT_NEAR(previous, white_of(curve), 1e-5) << static_cast<int>(curve);
    }
}

TEST(ToneCurve, HasItsPublishedValues) {
    EXPECT_FLOAT_EQ(tone_map(ToneCurve::kNone, {0.3F, 0.3F, 0.3F})[0], 0.3F);
    // x = .6: .6 (1.506 + .03) / (.6 (1.458 + .59) + .14)
    EXPECT_NEAR(tone_map(ToneCurve::kNarkowicz, {1, 1, 1})[0], 0.673290F, 1e-5F);
    // (1.0245786 - .000090537) / (.983729 + .432951 + .238081)
    EXPECT_NEAR(tone_map(ToneCurve::kHill, {1, 1, 1})[0], 0.619116F, 1e-5F);
    // ((278.5085 + 10.7772) / (293.6045 + 88.7122 + 80.6889))^.9811
    EXPECT_NEAR(tone_map(ToneCurve::kUnity, {1, 1, 1})[0], 0.630378F, 1e-5F);
    EXPECT_NEAR(tone_map(ToneCurve::kXyz, {0.3F, 0.3F, 0.3F})[0], 0.3F, 1e-6F);
}

TEST(ToneCurve, AnyInputStaysInRange) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const float values[] = {-kInf, -1e38F, -1e4F, -1,   -0.2F, -1e-3F, 0,    1e-30F,
                            0.5F,  1,      7,     1e6F, 1e20F, 3e38F,  kInf, std::nanf("")};
    for (const ToneCurve curve : kCurves) {
        for (const float r : values) {
            for (const float g : values) {
                for (const float b : values) {
                    for (const float v : tone_map(curve, {r, g, b})) {
                        EXPECT_TRUE(v >= 0 && v <= 1) << r << " " << g << " " << b << " -> " << v;
                    }
                }
            }
        }
    }
}

TEST(ToneCurve, BlackAndBelowIsBlack) {
    for (const ToneCurve curve : kCurves) {
        for (const float v : {0.0F, -0.05F, -0.3F, -50.0F}) {
            for (const float c : tone_map(curve, {v, v, v})) EXPECT_EQ(c, 0) << v;
        }
    }
}

// A curve applied to components that are negative or far above 1 must not favour any of them:
// what is white in the scene by a large factor is white on the display, never cyan.
TEST(ToneCurve, WhiteOutIsWhite) {
    for (const ToneCurve curve : kCurves) {
        for (const Rgbf& colour : {Rgbf{1, 1, 1}, Rgbf{1, 0.8F, 0.6F}, Rgbf{0.7F, 0.9F, 1}}) {
            for (const float scale : {300.0F, 1e5F, 1e10F}) {
                const Rgbf out =
                    tone_map(curve, {scale * colour[0], scale * colour[1], scale * colour[2]});
                for (const float v : out) EXPECT_GT(v, 0.99F * white_of(curve));
            }
        }
    }
}

TEST(ToneCurve, PureRedTurnsWhiteOnlyWhereItShould) {
    for (const ToneCurve curve : {ToneCurve::kHill, ToneCurve::kXyz}) {
        for (const float v : tone_map(curve, {1e6F, 0, 0})) EXPECT_GT(v, 0.98F);
    }
    for (const ToneCurve curve : {ToneCurve::kNone, ToneCurve::kNarkowicz}) {
        EXPECT_EQ(tone_map(curve, {1e6F, 0, 0}), (Rgbf{1, 0, 0}));
    }
}

TEST(ToneCurve, NamesAreThoseOfTheCommandLine) {
    EXPECT_EQ(tone_curve_from_name("none"), ToneCurve::kNone);
    EXPECT_EQ(tone_curve_from_name("narkowicz"), ToneCurve::kNarkowicz);
    EXPECT_EQ(tone_curve_from_name("hill"), ToneCurve::kHill);
    EXPECT_EQ(tone_curve_from_name("xyz"), ToneCurve::kXyz);
    EXPECT_EQ(tone_curve_from_name("unity"), ToneCurve::kUnity);
    EXPECT_THROW(tone_curve_from_name("Hill"), InvalidArgument);
}

// Position on the line from white through a colour: (max - mid) / (max - min) is the same for
// all mixtures with white and all scales, so it is the hue.
float hue(const Rgbf& c) {
    const float high = std::max({c[0], c[1], c[2]});
    const float low = std::min({c[0], c[1], c[2]});
    return (high - (c[0] + c[1] + c[2] - high - low)) / (high - low);
}

TEST(HuePreserving, KeepsHueAtAnyExposureUntilWhite) {
    for (const Rgbf& colour : {Rgbf{1, 0.5F, 0.1F}, Rgbf{0.2F, 0.9F, 0.4F}, Rgbf{0.1F, 0, 0.8F}}) {
        for (float scale = 0.01F; luminance(colour) * scale < 0.95F; scale *= 1.1F) {
            const Rgbf in = {scale * colour[0], scale * colour[1], scale * colour[2]};
            const Rgbf out = hue_preserving(in);
            EXPECT_NEAR(hue(out), hue(colour), 1e-4F) << scale;
            EXPECT_NEAR(luminance(out), luminance(in), 1e-5F) << "luminance is kept up to 1";
        }
    }
}

TEST(HuePreserving, IsContinuousWhereComponentsReachTheDisplaysMaximum) {
    const Rgbf colour = {1, 0.3F, 0.05F};
    Rgbf previous = hue_preserving(colour);
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        EXPECT_NEAR(previous[i], colour[i], 1e-6F);
    }
    for (float scale = 1; scale < 4; scale *= 1.001F) {  // through m = 1 and Y = 1
        const Rgbf out = hue_preserving({scale * colour[0], scale * colour[1], scale * colour[2]});
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(out[c], previous[c], 2e-3F) << scale;
        previous = out;
    }
}

TEST(HuePreserving, ColoursOutsideTheGamutKeepTheirLuminance) {
    const Rgbf in = {-0.1F, 0.6F, 0.3F};  // a spectral green: X, Y and Z are positive
    const Rgbf out = hue_preserving(in);
    EXPECT_NEAR(out[0], 0, 1e-6F);
    EXPECT_NEAR(luminance(out), luminance(in), 1e-6F);
}

// Where a colour lies in the CIE 1931 diagram as seen from white: the direction is its dominant
// (or complementary) wavelength, the distance its saturation.
struct FromWhite {
    double angle = 0;
    double distance = 0;
};

FromWhite from_white(const Rgbf& rgb) {
    const Xyz xyz = xyz_from_rgb({rgb[0], rgb[1], rgb[2]});
    const Xyz white = xyz_from_rgb({1, 1, 1});
    const double sum = xyz[0] + xyz[1] + xyz[2];
    const double white_sum = white[0] + white[1] + white[2];
    const double dx = xyz[0] / sum - white[0] / white_sum;
    const double dy = xyz[1] / sum - white[1] / white_sum;
    return {std::atan2(dy, dx), std::hypot(dx, dy)};
}

// Ramps of ten stops of colours at the edge of the gamut and beyond (laser lines of 532 and 470 nm,
// a neon red), the paper's figure 5: the colour keeps its dominant wavelength, never gets more
// saturated, ends white, and no component stops or falls while the others rise.
TEST(HuePreserving, SaturatedRampsKeepTheirDominantWavelengthUntilWhite) {
    for (const Rgbf& colour :
         {Rgbf{1, 0, 0}, Rgbf{0, 1, 0}, Rgbf{0, 0, 1}, Rgbf{1, 0.02F, 0.4F}, Rgbf{0, 0.7F, 1},
          Rgbf{1, 0.6F, 0}, Rgbf{-0.3F, 1, -0.08F}, Rgbf{-0.1F, 0.02F, 1}, Rgbf{1, -0.05F, -0.005F},
          Rgbf{-0.35F, 0.8F, 0.9F}}) {
        const double dominant = from_white(colour).angle;
        Rgbf previous = {};
        double previous_distance = from_white(colour).distance;
        const float first = 0.02F / luminance(colour);
        for (float stops = 0; stops <= 10; stops += 0.05F) {
            const float scale = first * std::exp2(stops);
            const Rgbf in = {scale * colour[0], scale * colour[1], scale * colour[2]};
            const Rgbf out = hue_preserving(in);
            const FromWhite seen = from_white(out);
            if (seen.distance > 1e-3) {
                EXPECT_NEAR(std::remainder(seen.angle - dominant, 6.283185307), 0, 2e-3) << stops;
            }
            EXPECT_LE(seen.distance, previous_distance + 1e-5) << stops;
            EXPECT_NEAR(luminance(out), std::min(luminance(in), 1.0F), 2e-5F) << stops;
            for (std::size_t c = 0; c < 3; ++c) EXPECT_GE(out[c], previous[c] - 1e-6F) << stops;
            previous = out;
            previous_distance = seen.distance;
        }
        for (const float v : previous) EXPECT_NEAR(v, 1, 1e-5F);
    }
}

TEST(FastSrgbEncode, IsAFractionOfAnEightBitStepFromTheExactCurve) {
    float previous = -1;
    for (int i = 0; i <= 400000; ++i) {
        const float x = static_cast<float>(i) / 400000.0F;
        const float encoded = kernels::fast_srgb_encode(x);
        ASSERT_NEAR(encoded, srgb_encode(x), 3e-6F) << x;
        ASSERT_GE(encoded, previous - 1e-6F) << x;
        previous = encoded;
    }
    EXPECT_LE(kernels::fast_srgb_encode(1), 1.0F);
}

TEST(ToneMapToSrgb, AgreesWithThePixelFormForAnyLayout) {
    constexpr int kWidth = 517;  // not a multiple of the block
    constexpr int kHeight = 5;
    constexpr float kScale = 1.7F;
    Image planar(kWidth, kHeight, 3);
    std::vector<float> packed(kWidth * kHeight * 3);
    const ImageView interleaved = interleaved_view(packed.data(), kWidth, kHeight, 3);
    Random random(3);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int c = 0; c < 3; ++c) {
                const auto v = static_cast<float>(random.log_uniform(1e-4, 1e4) *
                                                  (random.uniform() < 0.1 ? -1 : 1));
                planar.at(x, y, c) = v;
                interleaved.at(x, y, c) = v;
            }
        }
    }
    for (const ToneCurve curve : kCurves) {
        Image from_packed(kWidth, kHeight, 3);
        tone_map_to_srgb(curve, kScale, interleaved, from_packed);
        Image in_place = planar;
        tone_map_to_srgb(curve, kScale, in_place, in_place);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const Rgbf expected =
                    tone_map(curve, {kScale * planar.at(x, y, 0), kScale * planar.at(x, y, 1),
                                     kScale * planar.at(x, y, 2)});
                for (int c = 0; c < 3; ++c) {
                    const float encoded = srgb_encode(expected[static_cast<std::size_t>(c)]);
                    ASSERT_NEAR(in_place.at(x, y, c), encoded, 4e-6F);
                    ASSERT_NEAR(from_packed.at(x, y, c), encoded, 4e-6F);
                }
            }
        }
    }
}

TEST(ToneMapToSrgb, NotANumberIsBlack) {
    Image image(2, 1, 3);
    for (int c = 0; c < 3; ++c) image.at(0, 0, c) = std::nanf("");
    for (const ToneCurve curve : kCurves) {
        Image out(2, 1, 3);
        tone_map_to_srgb(curve, 1, image, out);
        for (int c = 0; c < 3; ++c) EXPECT_EQ(out.at(0, 0, c), 0);
    }
}

TEST(ToneMapToSrgb, RefusesOtherShapes) {
    const Image rgb(4, 3, 3);
    Image narrow(3, 3, 3);
    Image grey(4, 3, 1);
    EXPECT_THROW(tone_map_to_srgb(ToneCurve::kHill, 1, rgb, narrow), InvalidArgument);
    EXPECT_THROW(tone_map_to_srgb(ToneCurve::kHill, 1, rgb, grey), InvalidArgument);
}

}  // namespace
}  // namespace aureole::color
