#include "aureole/eye/thesis_glare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"

namespace aureole::eye {
namespace {

constexpr int kCentre = kThesisTextureSide / 2;

// Fewer wavelengths than are good to look at.
ThesisLook quick() {
    ThesisLook look;
    look.wavelengths = 8;
    return look;
}

// Mean over a ring of the texture, in samples.
double ring_mean(const Image& texture, int radius, int c) {
    double sum = 0;
    int count = 0;
    for (int y = -radius - 1; y <= radius + 1; ++y) {
        for (int x = -radius - 1; x <= radius + 1; ++x) {
            if (std::abs(std::hypot(x, y) - radius) > 0.5) continue;
            sum += static_cast<double>(texture.at(kCentre + x, kCentre + y, c));
            ++count;
        }
    }
    return sum / count;
}

// Where a colour of the texture is brightest between two radii, in samples.
int brightest_ring(const Image& texture, int c, int from, int to) {
    int best = from;
    for (int radius = from; radius <= to; ++radius) {
        if (ring_mean(texture, radius, c) > ring_mean(texture, best, c)) best = radius;
    }
    return best;
}

double total(const Image& image, int c) {
    double sum = 0;
    std::for_each_n(image.plane(c), image.pixels(),
                    [&](float value) { sum += static_cast<double>(value); });
    return sum;
}

bool same_bits(const Image& a, const Image& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::equal(a.plane(0), a.plane(0) + 3 * a.pixels(), b.plane(0));
}

// Power, threshold, factor and weight, as fig. 3.9 and eq. 3.4 print them.
TEST(ThesisLook, HoldsTheNumbersOfTheDocument) {
    const ThesisLook look;
    const auto expect = [](const ThesisTone& tone, double power, double threshold, double factor) {
        EXPECT_EQ(tone.power, power);
        EXPECT_EQ(tone.threshold, threshold);
        EXPECT_EQ(tone.factor, factor);
    };
    expect(look.bloom, 0.45, 0.00010, 2000);
    expect(look.halo, 0.45, 0.00010, 1000);
    expect(look.corona, 0.42, 0.00017, 2000);
    expect(look.streaks, 0.36, 0.00025, 500);
    EXPECT_EQ(look.bloom_weight, 1);
    EXPECT_EQ(look.halo_weight, 0.75);
    EXPECT_EQ(look.streaks_weight, 0.5);
    EXPECT_EQ(look.corona_weight, 1);
    EXPECT_EQ(kThesisThreshold, 0.9);
    EXPECT_EQ(kThesisSourceFactor, 10000);
    EXPECT_EQ(kThesisFinalGain, 10);
}

TEST(ThesisLook, TonesArePowerThenThresholdThenFactor) {
    EXPECT_DOUBLE_EQ(apply({0.5, 0.1, 10}, 0.25), 10 * (0.5 - 0.1));
    EXPECT_EQ(apply({0.5, 0.1, 10}, 0.009), 0);
    EXPECT_EQ(apply({0.5, 0.1, 10}, -1), 0);
}

TEST(ThesisLook, RefusesWhatIsOutOfRange) {
    ThesisLook look;
    look.bend = 3;
    EXPECT_THROW(check(look), InvalidArgument);
    look = {};
    look.halo.power = 0;
    EXPECT_THROW(check(look), InvalidArgument);
    look = {};
    look.bloom_weight = look.halo_weight = look.streaks_weight = look.corona_weight = 0;
    const View view = View::from_fov(64, 36, 60, Projection::kPerspective);
    EXPECT_THROW(thesis_glare(look, {}, view), InvalidArgument);
}

TEST(ThesisWavelength, IsTheColourOfSection23) {
    const color::Rgb red = thesis_wavelength_rgb(650);
    EXPECT_GT(red[0], 0.5);
    EXPECT_EQ(red[1], 0);
    const color::Rgb green = thesis_wavelength_rgb(535);
    EXPECT_EQ(green[0], 0);
    EXPECT_EQ(green[1], 1);  // clamped
    const color::Rgb blue = thesis_wavelength_rgb(450);
    EXPECT_EQ(blue[1], 0);
    EXPECT_EQ(blue[2], 1);
}

TEST(ThesisTexture, BendIsNothingAtOpenLidsAndContinuous) {
    for (double x = -1.3; x < 1.3; x += 0.1) {
        for (double y = -1.3; y < 1.3; y += 0.1) {
            const TexturePoint open = thesis_bend({x, y}, 0.6, 0);
            EXPECT_EQ(open.x, x);
            EXPECT_EQ(open.y, y);
            TexturePoint before = open;
            for (int page = 0; page < kThesisFrames; ++page) {
                const TexturePoint at = thesis_bend({x, y}, 0.6, thesis_lid_closure(page));
                EXPECT_EQ(at.x, x);
                EXPECT_LE(std::abs(at.y - before.y), 0.03);  // of half a height, from page to page
                before = at;
                const TexturePoint opposite = thesis_bend({-x, -y}, 0.6, thesis_lid_closure(page));
                EXPECT_DOUBLE_EQ(opposite.y, -at.y);
            }
            EXPECT_NEAR(before.y, y + 0.6 * std::sin(x), 1e-12);  // fig. 3.7
        }
    }
}

// What is seen at a place of the bent texture is what was straight below or above it: a texture of
// closed lids with bend is one without, read at the bent places.
TEST(ThesisTexture, BentStreaksAreTheStraightOnesMoved) {
    ThesisLook look = quick();
    look.streaks = {1, 0, 1e6};  // linear
    ThesisFrames closed;
    closed.lids = kThesisFrames - 1;
    const Image bent = thesis_texture(Component::kStreaks, look, closed);
    look.bend = 0;
    const Image straight = thesis_texture(Component::kStreaks, look, closed);
    EXPECT_FALSE(same_bits(bent, straight));
    for (const int dx : {-120, -60, 0, 60, 120}) {  // within the circle that does not fade
        double bent_sum = 0;
        double straight_sum = 0;
        double bent_moment = 0;
        double straight_moment = 0;
        for (int dy = -220; dy <= 220; ++dy) {
            const double b = static_cast<double>(bent.at(kCentre + dx, kCentre + dy, 1));
            const double s = static_cast<double>(straight.at(kCentre + dx, kCentre + dy, 1));
            bent_sum += b;
            straight_sum += s;
            bent_moment += b * -dy;  // up
            straight_moment += s * -dy;
        }
        const double half = kThesisSamples / 2.0;
        EXPECT_NEAR(bent_sum / straight_sum, 1, 0.02) << dx;
        EXPECT_NEAR(bent_moment / bent_sum,
                    straight_moment / straight_sum - half * 0.6 * std::sin(dx / half), 1.5)
            << dx;
    }
}

TEST(ThesisTexture, AllPartsLookTheSameAfterAHalfTurn) {
    ThesisFrames frames;
    frames.lids = 40;
    for (const Component component :
         {Component::kBloom, Component::kCorona, Component::kHalo, Component::kStreaks}) {
        const Image texture = thesis_texture(component, quick(), frames);
        const double peak = static_cast<double>(texture.at(kCentre, kCentre, 1));
        EXPECT_GT(peak, 0);
        double worst = 0;
        for (int y = 0; y < kThesisTextureSide; ++y) {
            for (int x = 0; x < kThesisTextureSide; ++x) {
                const int x2 = kThesisTextureSide - 1 - x;
                const int y2 = kThesisTextureSide - 1 - y;
                worst = std::max(worst, static_cast<double>(
                                            std::abs(texture.at(x, y, 1) - texture.at(x2, y2, 1))));
            }
        }
        EXPECT_LT(worst, 0.001 * peak);
    }
}

// A grating of 200 lines at radius r diffracts to 200 E / (2 pi r) samples of 575 nm, E the extent
// of the mask (18 mm); longer wavelengths farther out.
TEST(ThesisTexture, HaloIsARingThatIsRedOutside) {
    ThesisLook look;
    look.wavelengths = 64;
    const Image halo = thesis_texture(Component::kHalo, look, {});
    const int red = brightest_ring(halo, 0, 70, 250);
    const int green = brightest_ring(halo, 1, 70, 250);
    const int blue = brightest_ring(halo, 2, 70, 250);
    EXPECT_GT(red, green);
    EXPECT_GT(green, blue);
    const double at_4_2_mm = 200 * 18 / (2 * 3.14159 * 4.2);
    EXPECT_NEAR(green, at_4_2_mm * 535 / 575, 0.1 * at_4_2_mm);
    EXPECT_LT(ring_mean(halo, 60, 1), 0.05 * ring_mean(halo, green, 1)) << "dark inside";
}

TEST(ThesisTexture, EndsInACircle) {
    for (const Component component :
         {Component::kBloom, Component::kCorona, Component::kHalo, Component::kStreaks}) {
        const Image texture = thesis_texture(component, quick(), {});
        for (int i = 0; i < kThesisTextureSide; ++i) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(texture.at(i, 0, c), 0);
                EXPECT_EQ(texture.at(0, i, c), 0);
            }
        }
    }
}

TEST(ThesisGlare, WeightsAddUp) {
    const View view = View::from_fov(192, 108, 60, Projection::kPerspective);
    const auto only = [&](double bloom, double halo, double streaks, double corona) {
        ThesisLook look = quick();
        look.bloom_weight = bloom;
        look.halo_weight = halo;
        look.streaks_weight = streaks;
        look.corona_weight = corona;
        return thesis_glare(look, {}, view).energy;
    };
    const double sum =
        only(1, 0, 0, 0) + 0.75 * only(0, 1, 0, 0) + 0.5 * only(0, 0, 1, 0) + only(0, 0, 0, 1);
    EXPECT_NEAR(thesis_glare(quick(), {}, view).energy / sum, 1, 1e-5);
}

TEST(ThesisGlare, HasUnitEnergyInEveryColour) {
    for (const int width : {96, 1281}) {
        const View view = View::from_fov(width, width / 2, 60, Projection::kPerspective);
        const wave::Psf psf = thesis_glare(quick(), {}, view).psf;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(total(psf.kernel, c) + psf.off_kernel_energy[static_cast<std::size_t>(c)],
                        1, 1e-5);
            EXPECT_LT(psf.off_kernel_energy[static_cast<std::size_t>(c)], 1e-4)
                << "all of the glare fits into what a picture of 60 deg can see of it";
        }
    }
}

// The same field of view at any size: a pixel of a coarse kernel holds what the pixels of a fine
// one hold in its place. 3 to 1 keeps their centres together.
TEST(ThesisGlare, IsTheSameAtAnyResolution) {
    const View coarse = View::from_fov(213, 121, 60, Projection::kPerspective);
    const View fine = View::from_fov(639, 363, 60, Projection::kPerspective);
    const ThesisGlare a = thesis_glare(quick(), {}, coarse);
    const ThesisGlare b = thesis_glare(quick(), {}, fine);
    EXPECT_EQ(a.energy, b.energy);
    const int ax = a.psf.kernel.width() / 2;
    const int ay = a.psf.kernel.height() / 2;
    const int bx = b.psf.kernel.width() / 2;
    const int by = b.psf.kernel.height() / 2;
    const int reach = std::min({ax, ay, (bx - 1) / 3, (by - 1) / 3});
    double difference = 0;
    double sum = 0;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            double block = 0;
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    block +=
                        static_cast<double>(b.psf.kernel.at(bx + 3 * x + i, by + 3 * y + j, 1));
                }
            }
            difference += std::abs(block - static_cast<double>(a.psf.kernel.at(ax + x, ay + y, 1)));
            sum += block;
        }
    }
    EXPECT_GT(sum, 0.9);
    EXPECT_LT(difference / sum, 1e-4);
}

TEST(ThesisGlare, IsTheSameInOverscan) {
    const View view = View::from_fov(320, 180, 60, Projection::kPerspective);
    View wider = view;
    wider.width += 64;
    wider.axis_x += 32;
    const ThesisGlare a = thesis_glare(quick(), {}, view);
    const ThesisGlare b = thesis_glare(quick(), {}, wider);
    EXPECT_EQ(a.energy, b.energy);
    EXPECT_EQ(a.psf.kernel.at(a.psf.kernel.width() / 2 + 9, a.psf.kernel.height() / 2, 0),
              b.psf.kernel.at(b.psf.kernel.width() / 2 + 9, b.psf.kernel.height() / 2, 0));
}

TEST(ThesisGlareSlow, FramesInAnyOrderAndOnAnyThreadsAreTheSameBits) {
    const View view = View::from_fov(320, 181, 60, Projection::kPerspective);
    const std::array<std::int64_t, 5> moments = {0, 17, 61, 90, 400};
    std::array<ThesisGlare, 5> forward;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        forward[i] = thesis_glare(quick(), thesis_frames(moments[i]), view);
    }
    const ThreadLimit one(1);
    for (std::size_t i = moments.size(); i-- > 0;) {
        const ThesisGlare again = thesis_glare(quick(), thesis_frames(moments[i]), view);
        EXPECT_TRUE(same_bits(again.psf.kernel, forward[i].psf.kernel)) << moments[i];
        EXPECT_EQ(again.energy, forward[i].energy);
        if (i > 0) {
            EXPECT_FALSE(same_bits(again.psf.kernel, forward[i - 1].psf.kernel));
        }
    }
}

// From page to page the corona changes, but is not another one.
TEST(ThesisGlareSlow, NeedlesMoveWithoutFlicker) {
    const auto correlation = [](const Image& a, const Image& b) {
        std::vector<double> mean_a;
        std::vector<double> mean_b;
        for (int radius = 0; radius <= 91; ++radius) {
            mean_a.push_back(ring_mean(a, radius, 1));
            mean_b.push_back(ring_mean(b, radius, 1));
        }
        double ab = 0;
        double aa = 0;
        double bb = 0;
        for (int y = kCentre - 90; y <= kCentre + 90; ++y) {
            for (int x = kCentre - 90; x <= kCentre + 90; ++x) {
                const double r = std::hypot(x - kCentre, y - kCentre);
                if (r < 50 || r > 90) continue;
                const auto ring = static_cast<std::size_t>(std::lround(r));
                const double u = static_cast<double>(a.at(x, y, 1)) - mean_a[ring];
                const double v = static_cast<double>(b.at(x, y, 1)) - mean_b[ring];
                ab += u * v;
                aa += u * u;
                bb += v * v;
            }
        }
        return ab / std::sqrt(aa * bb);
    };
    std::array<Image, 3> pages;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        ThesisFrames frames;
        frames.particles = std::array{59, 0, 30}[i];
        pages[i] = thesis_texture(Component::kCorona, quick(), frames);
    }
    EXPECT_GT(correlation(pages[0], pages[1]), 0.9) << "the loop closes";
    EXPECT_LT(correlation(pages[1], pages[2]), 0.7);
}

}  // namespace
}  // namespace aureole::eye
