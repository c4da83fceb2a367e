// Bars of the main job, on the eye's own PSF and on pictures of full size.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/glare/glare.h"
#include "aureole/image/view.h"

namespace aureole {
namespace {

eye::Eye night_eye() {
    eye::Eye eye;
    eye.pupil_diameter_mm = 6;
    return eye;
}

View view_of(int width, int height, double fov_deg, bool perspective) {
    return View::from_fov(width, height, fov_deg,
                          perspective ? Projection::kPerspective : Projection::kConstantPitch);
}

Image apply(const View& view, const wave::Psf& psf, const Image& in) {
    Image out(view.width, view.height, 3);
    glare::Glare(view, 3, psf).apply(in, out);
    return out;
}

void set(Image& image, int x, int y, float value) {
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = value;
}

struct PointCase {
    int width;
    int height;
    int x;
    int y;
    bool perspective;
};

class PointEnergy : public testing::TestWithParam<PointCase> {};

// sum(out) + off_picture == sum(in), off_picture being summed from the kernel alone; also with a
// kernel that ends inside the picture, and with a threshold and a gain.
TEST_P(PointEnergy, IsConserved) {
    const PointCase& p = GetParam();
    const View view = view_of(p.width, p.height, 60, p.perspective);
    Image in(p.width, p.height, 3);
    set(in, p.x, p.y, 1e4F);
    glare::GlareOptions selective;
    selective.threshold = 100;
    selective.gain = 1.7F;
    for (const bool full : {true, false}) {
        const wave::Psf psf = eye::eye_psf(night_eye(), full ? wave::KernelGrid::full_reach(view)
                                                             : wave::KernelGrid::square(view, 101));
        for (const glare::GlareOptions& options : {glare::GlareOptions{}, selective}) {
            glare::Glare glare(view, 3, psf, options);
            Image out(p.width, p.height, 3);
            glare.apply(in, out);
            const glare::Energy energy = glare.energy(in, out);
            EXPECT_NEAR((energy.out + energy.off_picture) / energy.in, 1, 1e-4);
            EXPECT_GT(energy.off_picture, 0);
            if (options.gain == 1) {
                EXPECT_LT(energy.out, energy.in);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Positions, PointEnergy,
    testing::Values(PointCase{320, 180, 160, 90, true}, PointCase{320, 180, 0, 0, true},
                    PointCase{320, 180, 319, 90, false}, PointCase{321, 181, 13, 180, true},
                    PointCase{65, 300, 64, 7, false}, PointCase{1920, 1080, 1919, 0, true},
                    PointCase{1, 1, 0, 0, true}),
    [](const auto& instance) {
        const PointCase& p = instance.param;
        return std::to_string(p.width) + "x" + std::to_string(p.height) + "_at_" +
               std::to_string(p.x) + "_" + std::to_string(p.y) +
               (p.perspective ? "_perspective" : "_constant_pitch");
    });

// Share of a central light's energy that lands farther than a tenth of the width away from it.
double share_beyond_a_tenth(int width, int height) {
    const View view = view_of(width, height, 60, true);
    wave::KernelGrid grid = wave::KernelGrid::full_reach(view);
    grid.width = width / 2 * 2 + 1;  // as far as a central source is seen
    grid.height = height / 2 * 2 + 1;
    const wave::Psf psf = eye::eye_psf(night_eye(), grid);
    double beyond = 0;
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) {
            const double r = std::hypot(x - grid.width / 2, y - grid.height / 2);
            if (r <= 0.1 * width) continue;
            beyond += color::luminance(
                {psf.kernel.at(x, y, 0), psf.kernel.at(x, y, 1), psf.kernel.at(x, y, 2)});
        }
    }
    return beyond;
}

TEST(GlareLaws, GlareDoesNotDependOnResolution) {
    const double at_540 = share_beyond_a_tenth(960, 540);
    const double at_1080 = share_beyond_a_tenth(1920, 1080);
    const double at_2160 = share_beyond_a_tenth(3840, 2160);
    EXPECT_GT(at_1080, 0.01);
    EXPECT_NEAR(at_540 / at_1080, 1, 0.01);
    EXPECT_NEAR(at_2160 / at_1080, 1, 0.01);
}

// Mean of luminance * r^2.5 over rings, r from a centre in continuous coordinates. Narrower rings
// would measure how many pixels happen to lie in them, which counts for a streak.
constexpr double kRingWidth = 4;  // pixels

std::vector<double> ring_means(const Image& image, double centre_x, double centre_y, int rings) {
    std::vector<double> sums(static_cast<std::size_t>(rings));
    std::vector<double> counts(sums.size());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const double r = std::hypot(x + 0.5 - centre_x, y + 0.5 - centre_y);
            const auto ring = static_cast<std::size_t>(r / kRingWidth);
            if (ring >= sums.size()) continue;
            sums[ring] += std::pow(r, 2.5) * color::luminance({image.at(x, y, 0), image.at(x, y, 1),
                                                               image.at(x, y, 2)});
            ++counts[ring];
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
    return sums;
}

TEST(GlareLaws, OnePixelOfFourIsFourPixelsOfOne) {
    constexpr int kSize = 601;
    // The pitch of 1080p at 60 deg.
    const View view = View::from_fov(kSize, kSize, 0.0345 * kSize, Projection::kConstantPitch);
    const wave::Psf psf = eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(view));
    Image one(kSize, kSize, 3);
    set(one, 300, 300, 4000);
    Image four(kSize, kSize, 3);
    for (const int dx : {0, 1}) {
        for (const int dy : {0, 1}) set(four, 300 + dx, 300 + dy, 1000);
    }
    glare::Glare glare(view, 3, psf);
    Image glare_one(kSize, kSize, 3);
    Image glare_four(kSize, kSize, 3);
    glare.apply(one, glare_one);
    glare.apply(four, glare_four);
    const glare::Energy energy_one = glare.energy(one, glare_one);
    const glare::Energy energy_four = glare.energy(four, glare_four);
    EXPECT_NEAR(
        (energy_four.out + energy_four.off_picture) / (energy_one.out + energy_one.off_picture), 1,
        1e-4);
    constexpr int kRings = 72;
    const std::vector<double> rings_one = ring_means(glare_one, 300.5, 300.5, kRings);
    const std::vector<double> rings_four = ring_means(glare_four, 301, 301, kRings);
    for (std::size_t r = 4; r < kRings; ++r) {
        EXPECT_NEAR(rings_four[r] / rings_one[r], 1, 0.005) << "ring " << r;
    }
}

// The middle third of a picture three times as wide: its own borders, where light leaves and none
// comes back, are far away.
TEST(GlareLaws, FlatFieldStaysFlatInPerspective) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 180;
    const View view = view_of(kWidth, kHeight, 60, true);
    View wide = view;
    wide.width *= 3;
    wide.height *= 3;
    wide.axis_x *= 3;
    wide.axis_y *= 3;
    Image in(wide.width, wide.height, 3);
    for (int c = 0; c < 3; ++c) std::fill_n(in.plane(c), in.pixels(), 1.0F);
    const wave::Psf psf = eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(wide));
    const Image out = apply(wide, psf, in);
    float lowest = out.at(kWidth, kHeight);
    float highest = lowest;
    for (int y = kHeight; y < 2 * kHeight; ++y) {
        for (int x = kWidth; x < 2 * kWidth; ++x) {
            for (int c = 0; c < 3; ++c) {
                lowest = std::min(lowest, out.at(x, y, c));
                highest = std::max(highest, out.at(x, y, c));
            }
        }
    }
    RecordProperty("lowest", std::to_string(lowest));
    RecordProperty("highest", std::to_string(highest));
    EXPECT_LE(highest - lowest, 0.01F * highest);
    EXPECT_GT(lowest, 0.97F);  // the rest is scattered beyond 120 x 94 deg
    EXPECT_LE(highest, 1.0F);
}

TEST(GlareLaws, WhiteLightMakesWhiteGlare) {
    const View view = view_of(640, 360, 60, true);
    const wave::Psf psf = eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(view));
    Image in(640, 360, 3);
    set(in, 320, 180, 1e5F);
    const Image out = apply(view, psf, in);
    color::Rgb sum = {};
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            if (x == 320 && y == 180) continue;
            for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += out.at(x, y, c);
        }
    }
    const auto xy = color::chromaticity(sum);
    EXPECT_NEAR(xy[0], 0.3127, 0.002);
    EXPECT_NEAR(xy[1], 0.3290, 0.002);
}

// Nothing is compared with a threshold, so that an orange light that is dimmed, by half behind
// a veil or to a hundredth, keeps the hue of its glare in every pixel.
TEST(GlareLaws, ADimmedLightKeepsTheHueOfItsGlare) {
    const View view = view_of(160, 90, 60, true);
    for (const auto illuminant : {color::Illuminant::kD65, color::Illuminant::kSodium}) {
        eye::EyePsfOptions options;
        options.spectral.illuminant = illuminant;
        const wave::Psf psf =
            eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(view), options);
        const auto glare_of = [&](float luminance) {
            Image in(view.width, view.height, 3);
            const float orange[3] = {1.0F, 0.37F, 0.02F};
            for (int c = 0; c < 3; ++c) in.at(53, 41, c) = luminance * orange[c];
            return apply(view, psf, in);
        };
        const auto xy = [](const Image& image, int x, int y) {
            return color::chromaticity({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
        };
        const Image bright = glare_of(1e4F);
        for (const float left : {0.5F, 0.01F}) {
            const Image dimmed = glare_of(1e4F * left);
            for (int y = 0; y < view.height; ++y) {
                for (int x = 0; x < view.width; ++x) {
                    const auto before = xy(bright, x, y);
                    const auto after = xy(dimmed, x, y);
                    ASSERT_NEAR(after[0], before[0], 1e-3) << x << ", " << y;
                    ASSERT_NEAR(after[1], before[1], 1e-3) << x << ", " << y;
                }
            }
        }
    }
}

TEST(GlareLaws, GreyPicturesSeeTheLuminanceOfThePsf) {
    const View view = view_of(96, 64, 20, false);
    const wave::Psf psf = eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(view));
    Image rgb(96, 64, 3);
    set(rgb, 40, 30, 100);
    Image grey(96, 64, 1);
    grey.at(40, 30) = 100;
    const Image out = apply(view, psf, rgb);
    Image out_grey(96, 64, 1);
    glare::Glare(view, 1, psf).apply(grey, out_grey);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const double luminance =
                color::luminance({out.at(x, y, 0), out.at(x, y, 1), out.at(x, y, 2)});
            EXPECT_NEAR(out_grey.at(x, y), luminance, 1e-5 + 1e-4 * luminance);
        }
    }
}

TEST(GlareLaws, DirectMethodAgrees) {
    const View view = view_of(57, 43, 60, true);
    const wave::Psf psf = eye::eye_psf(night_eye(), wave::KernelGrid::full_reach(view));
    Image in(57, 43, 3);
    set(in, 11, 30, 1000);
    set(in, 50, 3, 1);
    glare::GlareOptions direct;
    direct.method = glare::Method::kDirect;
    Image expected(57, 43, 3);
    glare::Glare(view, 3, psf, direct).apply(in, expected);
    const Image out = apply(view, psf, in);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < out.pixels(); ++i) {
            // The faintest glare is 8e-7 of the brighter light.
            EXPECT_NEAR(out.plane(c)[i], expected.plane(c)[i], 1e-8 * 1000);
        }
    }
}

}  // namespace
}  // namespace aureole
