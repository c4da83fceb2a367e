// Laws of the lights that are found in a picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/sources/light.h"

namespace aureole::sources {
namespace {

View narrow(int width, int height) {
    return View::from_fov(width, height, 20, Projection::kPerspective);
}

// Adds `value` times the share of each pixel that the rectangle [x, x + w) x [y, y + h) covers.
void add_rectangle(Image& picture, double x, double y, double w, double h,
                   std::array<float, 3> value) {
    const auto overlap = [](double low, double high, int pixel) {
        return std::max(0.0,
                        std::min(high, pixel + 1.0) - std::max(low, static_cast<double>(pixel)));
    };
    for (int j = std::max(0, static_cast<int>(y)); j < std::min<double>(picture.height(), y + h);
         ++j) {
        for (int i = std::max(0, static_cast<int>(x)); i < std::min<double>(picture.width(), x + w);
             ++i) {
            const auto share = static_cast<float>(overlap(x, x + w, i) * overlap(y, y + h, j));
            for (int c = 0; c < 3; ++c) {
                picture.at(i, j, c) += share * value[static_cast<std::size_t>(c)];
            }
        }
    }
}

struct Totals {
    double energy = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

// Of several lights, as if they were one.
Totals totals_of(const std::vector<Light>& lights) {
    Totals t;
    for (const Light& light : lights) {
        const double e = luminous_energy(light);
        t.energy += e;
        t.x += e * light.tan_x;
        t.y += e * light.tan_y;
        t.xx += e * (light.moment_xx + light.tan_x * light.tan_x);
        t.xy += e * (light.moment_xy + light.tan_x * light.tan_y);
        t.yy += e * (light.moment_yy + light.tan_y * light.tan_y);
    }
    t.x /= t.energy;
    t.y /= t.energy;
    t.xx = t.xx / t.energy - t.x * t.x;
    t.xy = t.xy / t.energy - t.x * t.y;
    t.yy = t.yy / t.energy - t.y * t.y;
    return t;
}

TEST(FindLights, ASinglePixelIsALightOfItsSize) {
    const View view = narrow(64, 48);
    Image picture(64, 48, 3);
    for (int c = 0; c < 3; ++c) picture.at(40, 12, c) = 100.0F * static_cast<float>(c + 1);
    const FoundLights found = find_lights(picture, view);
    ASSERT_EQ(found.lights.size(), 1u);
    EXPECT_EQ(found.regions, 1u);
    const Light& light = found.lights[0];
    EXPECT_NEAR(light.solid_angle_sr / view.pixel_solid_angle_sr(40, 12), 1, 1e-12);
    EXPECT_EQ(light.radiance, (std::array<float, 3>{100, 200, 300}));
    const PixelPosition position = position_in(view, light);
    EXPECT_NEAR(position.x, 40.5, 1e-9);
    EXPECT_NEAR(position.y, 12.5, 1e-9);
    const double f2 = view.focal_length_px() * view.focal_length_px();
    EXPECT_NEAR(light.moment_xx * f2, 1.0 / 12, 1e-9);
    EXPECT_NEAR(light.moment_yy * f2, 1.0 / 12, 1e-9);
    EXPECT_NEAR(light.moment_xy * f2, 0, 1e-9);
}

// The second moments of a rectangle are w^2 / 12 and h^2 / 12, that of pixels included.
TEST(FindLights, ARectangleHasItsMomentsAndSolidAngle) {
    const View view = narrow(200, 100);
    Image picture(200, 100, 3);
    add_rectangle(picture, 96, 48, 8, 4, {500, 500, 500});
    const FoundLights found = find_lights(picture, view, {.threshold = 1, .max_radius = 1});
    ASSERT_EQ(found.lights.size(), 1u);
    const double f2 = view.focal_length_px() * view.focal_length_px();
    EXPECT_NEAR(found.lights[0].moment_xx * f2, 64.0 / 12, 1e-3);
    EXPECT_NEAR(found.lights[0].moment_yy * f2, 16.0 / 12, 1e-3);
    EXPECT_NEAR(found.lights[0].solid_angle_sr * f2, 32, 0.01);
    EXPECT_NEAR(static_cast<double>(found.lights[0].radiance[1]), 500, 1e-3);
}

// Radiance times solid angle is the sum over pixels, for each channel, whatever the colours.
TEST(FindLights, EnergyIsThatOfThePixels) {
    const View view = View::from_fov(160, 120, 80, Projection::kPerspective);
    Image picture(160, 120, 3);
    add_rectangle(picture, 20.3, 30.7, 5.1, 3.2, {900, 100, 20});
    add_rectangle(picture, 24.0, 33.0, 2.0, 6.0, {10, 300, 4000});
    const float threshold = 0.5F;
    std::array<double, 3> expected = {};
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
            const double l = 0.2126 * static_cast<double>(picture.at(x, y, 0)) +
                             0.7152 * static_cast<double>(picture.at(x, y, 1)) +
                             0.0722 * static_cast<double>(picture.at(x, y, 2));
            const double t = std::clamp(l / static_cast<double>(threshold) - 1, 0.0, 1.0);
            for (int c = 0; c < 3; ++c) {
                expected[static_cast<std::size_t>(c)] += t * t * (3 - 2 * t) *
                                                         static_cast<double>(picture.at(x, y, c)) *
                                                         view.pixel_solid_angle_sr(x, y);
            }
        }
    }
    const FoundLights found = find_lights(picture, view, {.threshold = threshold, .max_radius = 1});
    ASSERT_EQ(found.lights.size(), 1u);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(static_cast<double>(found.lights[0].radiance[c]) *
                        found.lights[0].solid_angle_sr / expected[c],
                    1, 1e-6);
    }
}

// Issue 3: a light of 5 x 5 pixels, a hundred times the threshold and box-filtered into the grid.
TEST(FindLights, FollowsATenthOfAPixel) {
    const View view = narrow(200, 100);
    double last_energy = 0;
    PixelPosition last;
    for (int step = 0; step <= 20; ++step) {
        Image picture(200, 100, 3);
        add_rectangle(picture, 60 + 0.1 * step, 40.35, 5, 5, {100, 100, 100});
        const FoundLights found = find_lights(picture, view, {.threshold = 1});
        ASSERT_EQ(found.lights.size(), 1u);
        const double energy = luminous_energy(found.lights[0]);
        const PixelPosition position = position_in(view, found.lights[0]);
        if (step > 0) {
            EXPECT_NEAR(energy / last_energy, 1, 0.01) << step;
            EXPECT_NEAR(position.x - last.x, 0.1, 0.01) << step;
            EXPECT_NEAR(position.y, last.y, 0.001) << step;
        }
        last_energy = energy;
        last = position;
    }
}

TEST(FindLights, FadesWithItsAreaAsItLeaves) {
    const View view = narrow(200, 100);
    double inside = 0;
    double last = 0;
    for (int step = 0; step <= 65; ++step) {
        Image picture(200, 100, 3);
        const double x = 194.5 + 0.1 * step;
        add_rectangle(picture, x, 40, 5, 5, {1000, 1000, 1000});
        const FoundLights found = find_lights(picture, view, {.threshold = 1});
        const double energy = found.energy_kept;
        if (step == 0) {
            inside = energy;
        } else {
            // 2 % of the area per step, to which .2 % of the ramp may add.
            EXPECT_LE(std::abs(energy - last) / inside, 0.022) << step;
        }
        const double visible = std::clamp((200 - x) / 5, 0.0, 1.0);
        EXPECT_NEAR(energy / inside, visible, 0.01) << step;
        last = energy;
    }
    EXPECT_EQ(last, 0);
}

// Nothing pops while a light brightens through the threshold.
TEST(FindLights, FadesInAboveTheThreshold) {
    const View view = narrow(32, 32);
    double last = 0;
    for (int step = 0; step <= 300; ++step) {
        Image picture(32, 32, 3);
        const float value = 0.9F + 0.005F * static_cast<float>(step);
        add_rectangle(picture, 10, 10, 3, 3, {value, value, value});
        const double solid_angle = 9 * view.pixel_solid_angle_sr(11, 11);
        const double energy =
            find_lights(picture, view, {.threshold = 1}).energy_kept / solid_angle;
        if (value <= 1) {
            EXPECT_EQ(energy, 0);
        }
        if (value >= 2) {
            EXPECT_NEAR(energy, static_cast<double>(value), 1e-3);
        }
        // The steepest slope of x smoothstep(x - 1) is 2.972, at x = 1.64.
        EXPECT_LE(energy - last, 0.005 * 2.98);
        EXPECT_GE(energy, last);
        last = energy;
    }
}

TEST(FindLights, JoiningTwoRegionsKeepsTheirSum) {
    const View view = narrow(200, 100);
    Image apart(200, 100, 3);
    add_rectangle(apart, 60, 40, 4, 6, {50, 60, 70});
    add_rectangle(apart, 65, 41, 3, 3, {900, 800, 10});
    Image touching = copy(apart);
    // A bridge of next to no energy: just above twice the threshold.
    touching.at(64, 42, 1) = 3e-5F;
    const FindLightsOptions options{.threshold = 1e-5F, .max_radius = 1};
    const FoundLights two = find_lights(apart, view, options);
    const FoundLights one = find_lights(touching, view, options);
    ASSERT_EQ(two.lights.size(), 2u);
    ASSERT_EQ(one.lights.size(), 1u);
    const Totals a = totals_of(two.lights);
    const Totals b = totals_of(one.lights);
    EXPECT_NEAR(b.energy / a.energy, 1, 1e-6);
    EXPECT_NEAR(b.x, a.x, 1e-9);
    EXPECT_NEAR(b.y, a.y, 1e-9);
    EXPECT_NEAR(b.xx / a.xx, 1, 1e-5);
    EXPECT_NEAR(b.yy / a.yy, 1, 1e-5);
    EXPECT_NEAR(b.xy / a.xx, a.xy / a.xx, 1e-5);
}

TEST(FindLights, CornersTouch) {
    const View view = narrow(64, 64);
    Image picture(64, 64, 3);
    for (int i = 0; i < 20; ++i) {
        for (int c = 0; c < 3; ++c) {
            picture.at(10 + i, 10 + i, c) = 100;             // one diagonal
            picture.at(50 - i, 40 + (i % 2), c) = 100;       // a zigzag
            if (i % 2 == 0) picture.at(2 * i, 62, c) = 100;  // ten single pixels
        }
    }
    EXPECT_EQ(find_lights(picture, view, {.threshold = 1}).regions, 12u);
}

// A spiral, whose arms are only joined at its last pixel, and a comb, whose teeth are.
TEST(FindLights, FindsWindingRegionsWhole) {
    const View view = narrow(64, 64);
    Image comb(64, 64, 3);
    for (int x = 2; x < 60; x += 2) {
        for (int y = 5; y < 40; ++y) comb.at(x, y, 1) = 100;
    }
    EXPECT_EQ(find_lights(comb, view, {.threshold = 1}).regions, 29u);
    for (int x = 2; x < 60; ++x) comb.at(x, 40, 1) = 100;
    EXPECT_EQ(find_lights(comb, view, {.threshold = 1}).regions, 1u);
}

TEST(FindLights, CutsWideRegionsAndKeepsTheirMoments) {
    const View view = narrow(400, 200);
    Image picture(400, 200, 3);
    add_rectangle(picture, 50.5, 60.25, 250, 40, {30, 20, 10});
    add_rectangle(picture, 120, 70, 20, 100, {300, 300, 300});
    const FoundLights whole = find_lights(picture, view, {.threshold = 1, .max_radius = 1});
    const FoundLights parts =
        find_lights(picture, view, {.threshold = 1, .max_lights = 10000, .max_radius = 0.03});
    ASSERT_EQ(whole.lights.size(), 1u);
    EXPECT_EQ(parts.regions, 1u);
    EXPECT_GT(parts.lights.size(), 20u);
    const double f = view.focal_length_px();
    for (const Light& light : parts.lights) {
        EXPECT_LE(std::sqrt(light.moment_xx + light.moment_yy) * f, 0.03 * 400);
    }
    const Totals a = totals_of(whole.lights);
    const Totals b = totals_of(parts.lights);
    EXPECT_NEAR(b.energy / a.energy, 1, 1e-6);
    EXPECT_NEAR(b.x, a.x, 1e-8);
    EXPECT_NEAR(b.xx / a.xx, 1, 1e-5);
    EXPECT_NEAR(b.yy / a.yy, 1, 1e-5);
    EXPECT_NEAR(b.xy / a.xx, a.xy / a.xx, 1e-5);
}

// The parts of a wide light move with it, none of them by leaps.
TEST(FindLights, PartsFollowAWideLight) {
    const View view = narrow(400, 200);
    std::vector<Light> last;
    for (int step = 0; step <= 10; ++step) {
        Image picture(400, 200, 3);
        add_rectangle(picture, 100 + 0.1 * step, 80, 90, 31, {500, 500, 500});
        FoundLights found = find_lights(picture, view, {.threshold = 1, .max_radius = 0.05});
        std::sort(found.lights.begin(), found.lights.end(), [](const Light& a, const Light& b) {
            return a.tan_x + 0.01 * a.tan_y < b.tan_x + 0.01 * b.tan_y;
        });
        if (step > 0) {
            ASSERT_EQ(found.lights.size(), last.size());
            for (std::size_t i = 0; i < last.size(); ++i) {
                const double moved_px =
                    (found.lights[i].tan_x - last[i].tan_x) * view.focal_length_px();
                EXPECT_NEAR(moved_px, 0.1, 0.05);
                EXPECT_NEAR(luminous_energy(found.lights[i]) / luminous_energy(last[i]), 1, 0.01);
            }
        }
        last = found.lights;
    }
    EXPECT_GE(last.size(), 2u);
}

TEST(FindLights, KeepsTheStrongestAndReportsTheRest) {
    const View view = narrow(100, 20);
    Image picture(100, 20, 3);
    for (int i = 0; i < 10; ++i) {
        for (int c = 0; c < 3; ++c) {
            picture.at(5 + 9 * i, 10, c) = 10.0F * static_cast<float>((i * 7) % 10 + 1);
        }
    }
    const FoundLights all = find_lights(picture, view, {.threshold = 1});
    const FoundLights three = find_lights(picture, view, {.threshold = 1, .max_lights = 3});
    ASSERT_EQ(all.lights.size(), 10u);
    ASSERT_EQ(three.lights.size(), 3u);
    EXPECT_EQ(all.energy_dropped, 0);
    EXPECT_NEAR((three.energy_kept + three.energy_dropped) / all.energy_kept, 1, 1e-6);
    EXPECT_NEAR(static_cast<double>(three.lights[0].radiance[0]), 100, 1e-4);
    EXPECT_NEAR(static_cast<double>(three.lights[1].radiance[0]), 90, 1e-4);
    EXPECT_NEAR(static_cast<double>(three.lights[2].radiance[0]), 80, 1e-4);
}

TEST(FindLights, TheThresholdIsSixteenMeansUnlessGiven) {
    const View view = narrow(50, 40);
    Image picture(50, 40, 3);
    for (int c = 0; c < 3; ++c) {
        std::fill_n(picture.plane(c), picture.pixels(), 0.25F);
        picture.at(20, 20, c) = 100.25F;
    }
    // 100 / 2000 pixels + .25 = .3.
    EXPECT_NEAR(static_cast<double>(find_lights(picture, view).threshold), 16 * 0.3, 1e-4);
    EXPECT_EQ(find_lights(picture, view, {.threshold = 7}).threshold, 7);
}

TEST(FindLights, WhatIsNoNumberIsDark) {
    const View view = narrow(64, 48);
    Image picture(64, 48, 3);
    add_rectangle(picture, 10, 10, 2, 2, {50, 50, 50});
    const FoundLights clean = find_lights(picture, view);
    picture.at(30, 30, 0) = std::numeric_limits<float>::quiet_NaN();
    picture.at(31, 30, 1) = std::numeric_limits<float>::infinity();
    picture.at(32, 30, 2) = -std::numeric_limits<float>::infinity();
    picture.at(33, 30, 2) = -1e9F;
    const FoundLights found = find_lights(picture, view);
    EXPECT_EQ(found.threshold, clean.threshold);
    ASSERT_EQ(found.lights.size(), 1u);
    EXPECT_EQ(luminous_energy(found.lights[0]), luminous_energy(clean.lights[0]));
}

TEST(FindLights, LargestFloatsStayFinite) {
    const View view = narrow(16, 16);
    Image picture(16, 16, 3);
    picture.at(4, 4, 2) = std::numeric_limits<float>::max();
    picture.at(5, 4, 1) = std::numeric_limits<float>::max();
    for (const Light& light : find_lights(picture, view, {.threshold = 1}).lights) {
        EXPECT_TRUE(std::isfinite(luminous_energy(light)));
        for (const float value : light.radiance) EXPECT_TRUE(std::isfinite(value));
        EXPECT_TRUE(std::isfinite(light.moment_xx));
    }
}

TEST(FindLights, ABlackPictureHasNone) {
    const Image picture(32, 16, 3);
    const FoundLights found = find_lights(picture, narrow(32, 16));
    EXPECT_TRUE(found.lights.empty());
    EXPECT_EQ(found.energy_kept, 0);
}

// Behind the camera of a panorama there is no light for a lens.
TEST(FindLights, LooksAheadOnly) {
    const View view = View::from_fov(400, 200, 360, Projection::kConstantPitch);
    Image picture(400, 200, 3);
    for (int c = 0; c < 3; ++c) {
        picture.at(20, 100, c) = 100;  // 162 deg to the left
        picture.at(230, 90, c) = 100;  // 27 deg to the right
    }
    const FoundLights found = find_lights(picture, view, {.threshold = 1});
    ASSERT_EQ(found.lights.size(), 1u);
    EXPECT_NEAR(position_in(view, found.lights[0]).x, 230.5, 1e-9);
    EXPECT_NEAR(position_in(view, found.lights[0]).y, 90.5, 1e-9);
}

Image noise(int width, int height) {
    Image picture(width, height, 3);
    Random random(7);
    for (std::size_t i = 0; i < 3 * picture.pixels(); ++i) {
        picture.plane(0)[i] = std::pow(static_cast<float>(random.uniform()), 20.0F) * 50;
    }
    return picture;
}

bool same(const FoundLights& a, const FoundLights& b) {
    if (a.lights.size() != b.lights.size() || a.regions != b.regions) return false;
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        const Light& x = a.lights[i];
        const Light& y = b.lights[i];
        if (x.tan_x != y.tan_x || x.tan_y != y.tan_y || x.radiance != y.radiance ||
            x.solid_angle_sr != y.solid_angle_sr || x.moment_xx != y.moment_xx ||
            x.moment_xy != y.moment_xy || x.moment_yy != y.moment_yy) {
            return false;
        }
    }
    return a.energy_dropped == b.energy_dropped;
}

TEST(FindLights, DoesNotDependOnThreadsOrMemoryLayout) {
    const View view = narrow(300, 200);
    const Image picture = noise(300, 200);
    const FindLightsOptions options{.threshold = 2, .max_lights = 500};
    const FoundLights found = find_lights(picture, view, options);
    EXPECT_GT(found.lights.size(), 100u);
    {
        const ThreadLimit one(1);
        EXPECT_TRUE(same(find_lights(picture, view, options), found));
    }
    std::vector<float> interleaved(3 * picture.pixels());
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            interleaved[3 * i + c] = picture.plane(static_cast<int>(c))[i];
        }
    }
    EXPECT_TRUE(
        same(find_lights(interleaved_view(interleaved.data(), 300, 200, 3), view, options), found));
}

TEST(FindLights, GreyIsTheSameAsThreeEqualChannels) {
    const View view = narrow(64, 48);
    Image grey(64, 48, 1);
    Image colour(64, 48, 3);
    for (int y = 10; y < 14; ++y) {
        grey.at(9, y) = 40;
        for (int c = 0; c < 3; ++c) colour.at(9, y, c) = 40;
    }
    EXPECT_TRUE(same(find_lights(grey, view), find_lights(colour, view)));
}

TEST(FindLights, SaysWhatIsWrong) {
    const View view = narrow(8, 8);
    const Image picture(8, 8, 3);
    EXPECT_THROW(find_lights(Image(8, 7, 3), view), InvalidArgument);
    EXPECT_THROW(find_lights(Image(8, 8, 2), view), InvalidArgument);
    EXPECT_THROW(find_lights(ConstImageView{}, view), InvalidArgument);
    EXPECT_THROW(find_lights(picture, view, {.threshold = -1}), InvalidArgument);
    EXPECT_THROW(find_lights(picture, view, {.max_lights = 0}), InvalidArgument);
    EXPECT_THROW(find_lights(picture, view, {.max_radius = 0}), InvalidArgument);
    EXPECT_THROW(find_lights(picture, view, {.max_radius = 1.5}), InvalidArgument);
    View flat = view;
    flat.pitch_deg = 0;
    EXPECT_THROW(find_lights(picture, flat), InvalidArgument);
}

}  // namespace
}  // namespace aureole::sources
