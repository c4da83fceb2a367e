// Laws of the cases in the gallery (docs/gallery.md), on small pictures of the same scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/pupil.h"
#include "aureole/glare/glare.h"
#include "aureole/scene/studies.h"

namespace aureole {
namespace {

eye::Eye adapted_eye(double cd_m2) {
    eye::Eye eye;
    eye.pupil_diameter_mm =
        eye::pupil_diameter_mm(eye::PupilModel::kWatsonYellott, cd_m2, {.age_years = 30});
    return eye;
}

View view_of(int width, int height, double fov_deg) {
    return View::from_fov(width, height, fov_deg, Projection::kPerspective);
}

glare::Glare glare_of(const View& view, const eye::Eye& eye) {
    return {view, 3, eye::eye_psf(eye, wave::KernelGrid::full_reach(view))};
}

Image apply(glare::Glare& glare, const Image& in) {
    Image out(in.width(), in.height(), 3);
    glare.apply(in, out);
    return out;
}

// Sum over pixels and colours of value(x, y, c) times solid angle.
template <class Value>
double light(const View& view, const Value& value) {
    double sum = 0;
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const double sr = view.pixel_solid_angle_sr(x, y);
            for (int c = 0; c < 3; ++c) sum += sr * value(x, y, c);
        }
    }
    return sum;
}

double light_of(const View& view, const Image& picture) {
    return light(view, [&](int x, int y, int c) { return double{picture.at(x, y, c)}; });
}

// The light that leaves the pixels it comes from, over the light there is. A pixel keeps the share
// of its own light that a single lit pixel keeps.
struct Spreading {
    explicit Spreading(const View& v, const eye::Eye& eye = adapted_eye(0.5))
        : view(v), glare(glare_of(v, eye)) {
        Image in(view.width, view.height, 3);
        const int x = view.width / 2;
        const int y = view.height / 2;
        for (int c = 0; c < 3; ++c) in.at(x, y, c) = 1;
        const Image out = apply(glare, in);
        for (int c = 0; c < 3; ++c) kept[static_cast<std::size_t>(c)] = double{out.at(x, y, c)};
    }
    double spread(const Image& in) {
        const Image out = apply(glare, in);
        const double own = light(view, [&](int x, int y, int c) {
            return kept[static_cast<std::size_t>(c)] * double{in.at(x, y, c)};
        });
        return light_of(view, out) + glare.energy(in, out).off_picture - own;
    }

    View view;
    glare::Glare glare;
    std::array<double, 3> kept{};
};

// As the sun sets, in the steps of the gallery's sequence and until it has been gone for a while,
// total glare, the light that leaves its pixels, never changes by more than 1.5 times what the
// light of the picture changes by; the pupil widens meanwhile. Nothing pops, and no step takes more
// than a quarter of the light, so that the last sliver of the sun is not gone at once.
TEST(GallerySlow, SunsetFadesWithoutSteps) {
    const View view = view_of(96, 54, 20);
    constexpr int kFrames = 48;
    double source_before = 0;
    double glare_before = 0;
    double largest = 0;
    double largest_own = 0;
    for (int i = 0; i < kFrames; ++i) {
        const double to_go = 1 - i / (kFrames - 1.0);
        const double elevation_deg = -0.3 + 4.3 * to_go * to_go * to_go;
        const scene::Scene scene = scene::make_sunset(view, {elevation_deg});
        Spreading spreading(view, adapted_eye(scene.adaptation_cd_m2));
        const double source = light_of(view, scene.rgb);
        const double glare = spreading.spread(scene.rgb);
        if (i > 0) {
            const double step = std::abs(glare / glare_before - 1);
            const double own = std::abs(source / source_before - 1);
            EXPECT_LE(step, 1.5 * own) << elevation_deg << " deg";
            largest = std::max(largest, step / own);
            largest_own = std::max(largest_own, own);
        }
        source_before = source;
        glare_before = glare;
    }
    EXPECT_LT(largest_own, 0.25);
    RecordProperty("largest_step_over_source", std::to_string(largest));
    RecordProperty("largest_step_of_source", std::to_string(largest_own));
}

// A star that drifts across a pixel in 64 steps: the light that glare takes from its pixels, the
// light beyond half a degree of it, and the energy of the whole picture stay. (Nearer to it a
// picture of pixels cannot keep still: two half-lit ones are a wider star than one.)
TEST(GalleryStars, DriftWithoutFlicker) {
    const View view = view_of(160, 90, 6);
    Spreading spreading(view, adapted_eye(3e-4));
    constexpr int kSteps = 64;
    std::vector<double> total;
    std::vector<double> far;
    std::vector<double> all;
    for (int i = 0; i <= kSteps; ++i) {
        const double x_deg = i * view.pitch_deg / kSteps;
        const Image in = scene::lights_on_ground(
            view, {}, {}, {{x_deg, 0.4 * view.pitch_deg, {1e-3, 1e-3, 1e-3}}});
        const Image out = apply(spreading.glare, in);
        const double px = view.axis_x + view.focal_length_px() * std::tan(rad_from_deg(x_deg));
        const double py = view.axis_y - 0.4;
        const double reach = 0.5 / view.pitch_deg;
        far.push_back(light(view, [&](int x, int y, int c) {
            // The edge of the region moves with the star, smoothly over a pixel.
            const double distance = std::hypot(x + 0.5 - px, y + 0.5 - py);
            return std::clamp(distance - reach + 0.5, 0.0, 1.0) * double{out.at(x, y, c)};
        }));
        all.push_back(light_of(view, out));
        total.push_back(spreading.spread(in));
    }
    for (const auto& sums : {total, far, all}) {
        const auto [low, high] = std::minmax_element(sums.begin(), sums.end());
        EXPECT_LE(*high / *low - 1, 0.005);
        RecordProperty("variation", std::to_string(*high / *low - 1));
    }
}

double cone_sr(double diameter_deg) {
    return 2 * kPi * (1 - std::cos(rad_from_deg(diameter_deg / 2)));
}

TEST(GallerySizes, GlareIsProportionalToTheArea) {
    Spreading spreading(view_of(320, 180, 20));
    double reference = 0;
    for (int i = 0; i < 24; ++i) {
        const double diameter_deg = 0.05 * std::pow(3 / 0.05, i / 23.0);
        const Image in =
            scene::lights_on_ground(spreading.view, {}, {{0, 0, diameter_deg, {1e4, 1e4, 1e4}}});
        const double share = spreading.spread(in) / light_of(spreading.view, in);
        if (i == 0) reference = share;
        EXPECT_NEAR(share / reference, 1, 1e-3) << diameter_deg << " deg";
        // And the source has the energy of its area.
        EXPECT_NEAR(light_of(spreading.view, in) / (3e4 * cone_sr(diameter_deg)), 1, 1e-3);
    }
}

TEST(GalleryBrightness, GlareIsProportionalToTheLuminance) {
    Spreading spreading(view_of(160, 90, 20));
    double reference = 0;
    for (int i = 0; i < 24; ++i) {
        const double level = 1e-3 * std::pow(1e12, i / 23.0);
        const Image in =
            scene::lights_on_ground(spreading.view, {}, {{0, 0, 0.5, {level, level, level}}});
        const double share = spreading.spread(in) / light_of(spreading.view, in);
        if (i == 0) reference = share;
        EXPECT_NEAR(share / reference, 1, 1e-3) << level << " cd/m2";
    }
}

// Relative variance of glare along rings, within 25 deg of the horizontal or of the vertical and
// between 0.8 and 2.5 deg: the contrast of the needles that point there.
double needle_variance(const View& view, const Image& picture, bool upright) {
    constexpr double kFromDeg = 0.8;
    constexpr double kToDeg = 2.5;
    const double ring_deg = 1.5 * view.pitch_deg;
    const auto rings = static_cast<std::size_t>((kToDeg - kFromDeg) / ring_deg);
    std::vector<double> sum(rings);
    std::vector<double> squares(rings);
    std::vector<double> count(rings);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const double radius = view.angle_from_axis_deg(x + 0.5, y + 0.5);
            const auto ring =
                static_cast<std::size_t>(std::max(0.0, (radius - kFromDeg) / ring_deg));
            if (radius < kFromDeg || ring >= rings) continue;
            const double dx = std::abs(x + 0.5 - view.axis_x);
            const double dy = std::abs(y + 0.5 - view.axis_y);
            const double off = upright ? std::atan2(dx, dy) : std::atan2(dy, dx);
            if (off > rad_from_deg(25)) continue;
            // The veil falls by the square of the angle: without it rings would not be level.
            const double value = double{picture.at(x, y, 1)} * radius * radius;
            sum[ring] += value;
            squares[ring] += value * value;
            count[ring] += 1;
        }
    }
    double variance = 0;
    for (std::size_t i = 0; i < rings; ++i) {
        const double mean = sum[i] / count[i];
        variance += (squares[i] / count[i] / (mean * mean) - 1) / static_cast<double>(rings);
    }
    return variance;
}

// Section 2.5 of the thesis, after Ritschel et al. 2009: the flame is upright and smooths the
// needles that point sideways; those that point up and down stay. A point has no such preference.
TEST(GalleryCandle, FlameSmoothsHorizontalNeedlesOnly) {
    const View view = view_of(481, 481, 6);
    eye::Eye eye = adapted_eye(0.04);
    eye.eyelashes = 0;  // their streaks are horizontal
    eye.halo = 0;
    glare::Glare glare = glare_of(view, eye);
    const auto ratio = [&](const Image& in) {
        const Image out = apply(glare, in);
        return needle_variance(view, out, false) / needle_variance(view, out, true);
    };
    const Image point = scene::lights_on_ground(view, {}, {}, {{0, 0, {1, 1, 1}}});
    // The flame alone: everything but what outshines the wall a hundredfold.
    Image flame = scene::make_candle(view, {}).rgb;
    for (std::size_t i = 0; i < 3 * flame.pixels(); ++i) {
        if (flame.plane(0)[i] < 100) flame.plane(0)[i] = 0;
    }
    const double of_point = ratio(point);
    const double of_flame = ratio(flame);
    EXPECT_NEAR(of_point, 1, 0.35);
    EXPECT_LT(of_flame, 0.5 * of_point);
    RecordProperty("horizontal_over_vertical_point", std::to_string(of_point));
    RecordProperty("horizontal_over_vertical_flame", std::to_string(of_flame));
}

}  // namespace
}  // namespace aureole
