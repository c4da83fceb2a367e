// A candle: the flame is a pile of level slices, each of one radiance, drawn by exact coverage.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/scene/studies.h"
#include "scene/builders.h"
#include "scene/camera.h"
#include "scene/coverage.h"
#include "scene/noise.h"
#include "scene/study_checks.h"

namespace aureole::scene {
namespace {

constexpr float kFlameHeightMm = 28;
constexpr float kFlameWidthMm = 7;
constexpr float kWickMm = 5;  // between wax and flame
constexpr float kWaxWidthMm = 22;
constexpr float kWallDistanceM = 2;  // behind the flame
constexpr float kAmbient = 0.02F;    // cd/m2
constexpr float kWallAlbedo = 0.4F;
constexpr int kSlices = 24;

// Half the width of the flame at a height u, 0 at its foot to 1 at its tip.
float half_width_mm(float u) {
    // Largest, 1, at u = 0.385.
    return kFlameWidthMm / 2 * std::sqrt(u) * std::pow(1 - u, 0.8F) / 0.4206F;
}

// Relative radiance: a dim blue foot, the bright body, a tip that fades.
Vec3 flame_radiance(float u) {
    static const Vec3 body = black_body_rgb(1930);
    static const Vec3 foot = unit_luminance({0.25F, 0.45F, 1.0F}) * 0.02F;
    const float rise = smoothstep(0.06F, 0.32F, u);
    return mix(foot, body, rise) * (1 - 0.5F * smoothstep(0.75F, 1, u));
}

// The level slices of the flame, mm from the middle of the resting flame, which is on the axis.
struct Slice {
    std::array<std::array<float, 2>, 4> corners;
    Vec3 radiance;
};

std::vector<Slice> flame_slices(const Candle& candle) {
    const auto seed = static_cast<int>(candle.seed % 100000);
    const auto tremble = [&](double hertz, int stream) {
        return value_noise(static_cast<float>(candle.time_s * hertz), 0.5F, seed + stream);
    };
    const float height = kFlameHeightMm * (1 + 0.08F * tremble(3, 1) + 0.04F * tremble(9, 2));
    const float lean = 2.2F * tremble(1.3, 3) + 0.6F * tremble(6, 4);
    const auto corner = [&](float u, float side) {
        return std::array{side * half_width_mm(u) + lean * u * u, height * u - kFlameHeightMm / 2};
    };
    std::vector<Slice> slices;
    Vec3 sum;  // of area times radiance, mm2
    for (int i = 0; i < kSlices; ++i) {
        const float low = static_cast<float>(i) / kSlices;
        const float high = static_cast<float>(i + 1) / kSlices;
        slices.push_back({{corner(low, -1), corner(low, 1), corner(high, 1), corner(high, -1)},
                          flame_radiance((low + high) / 2)});
        const float area = (half_width_mm(low) + half_width_mm(high)) * height / kSlices;
        sum += slices.back().radiance * area;
    }
    const float scale = static_cast<float>(candle.intensity_cd) / (1e-6F * luminance(sum));
    for (Slice& slice : slices) slice.radiance *= scale;
    return slices;
}

// What the flame lights, `intensity` cd from the axis.
Vec3 wall_radiance(Vec3 direction, float distance_m, float intensity_cd) {
    static const Vec3 light = black_body_rgb(1930);
    static const Vec3 ambient = unit_luminance({0.9F, 0.95F, 1.1F}) * kAmbient;
    const Vec3 point = direction * ((distance_m + kWallDistanceM) / direction.z);
    const float squared = square(point.x) + square(point.y) + square(kWallDistanceM);
    const float illuminance = intensity_cd * kWallDistanceM / (squared * std::sqrt(squared));
    return ambient + light * (kWallAlbedo / 3.14159265F * illuminance);
}

// Wax glows from within below the flame; the wick is dark.
void draw_wax(const Camera& camera, float distance_m, float intensity_cd, Image& picture) {
    static const Vec3 glow = unit_luminance({1.0F, 0.62F, 0.3F});
    const float top_mm = -kFlameHeightMm / 2 - kWickMm;
    const auto corner = [&](float x_mm, float y_mm) {
        return *camera.project({1e-3F * x_mm, 1e-3F * y_mm, distance_m});
    };
    const auto paint = [&](float half_width_mm, float high_mm, float low_mm, const auto& radiance) {
        const Polygon outline = {corner(-half_width_mm, high_mm), corner(half_width_mm, high_mm),
                                 corner(half_width_mm, low_mm), corner(-half_width_mm, low_mm)};
        for (const PixelCoverage& p : coverage(outline, picture.width(), picture.height())) {
            const Vec3 value = radiance(p.y);
            const std::array<float, 3> values = {value.x, value.y, value.z};
            for (int c = 0; c < 3; ++c) {
                float& pixel = picture.at(p.x, p.y, c);
                pixel += p.share * (values[static_cast<std::size_t>(c)] - pixel);
            }
        }
    };
    const float mm_per_pixel = 1e3F * camera.pixel_size() * distance_m;
    const double top_y = corner(0, top_mm).y;
    const float beyond_mm = -1e4F * distance_m;
    paint(kWaxWidthMm / 2, top_mm, beyond_mm, [&](int y) {
        const float depth = std::max(static_cast<float>(y + 0.5 - top_y), 0.0F) * mm_per_pixel;
        const float level = intensity_cd * (60 * std::exp(-depth / 7) + 2 * std::exp(-depth / 60));
        return glow * (level + kAmbient);
    });
    paint(0.6F, top_mm + kWickMm + 4, top_mm, [](int) { return Vec3{1, 1, 1} * kAmbient; });
}

void check(const Candle& candle) {
    check_range("distance_m", candle.distance_m, 0.3, 100);
    check_range("time_s", candle.time_s, -1e5, 1e5);
    if (!(candle.intensity_cd > 0 && std::isfinite(candle.intensity_cd))) {
        throw InvalidArgument("intensity_cd", std::to_string(candle.intensity_cd),
                              "must be above 0 and finite");
    }
}

}  // namespace

Scene make_candle(const View& view, const Candle& candle) {
    check(candle);
    const auto distance = static_cast<float>(candle.distance_m);
    const auto intensity = static_cast<float>(candle.intensity_cd);
    Scene scene{Image(view.width, view.height, 3), view, 0, 0};
    const Camera camera(view, {}, 0);
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            const Vec3 wall =
                wall_radiance(camera.ray(x + 0.5, y + 0.5).direction, distance, intensity);
            scene.rgb.at(x, y, 0) = wall.x;
            scene.rgb.at(x, y, 1) = wall.y;
            scene.rgb.at(x, y, 2) = wall.z;
        }
    });
    draw_wax(camera, distance, intensity, scene.rgb);
    scene.adaptation_cd_m2 = mean_luminance(scene.rgb);
    // A veil that is white some 0.3 deg from the flame.
    scene.display_white_cd_m2 = 48 * candle.intensity_cd / (candle.distance_m * candle.distance_m);

    for (const Slice& slice : flame_slices(candle)) {
        Polygon outline;
        for (const auto& [x_mm, y_mm] : slice.corners) {
            outline.push_back(*camera.project({1e-3F * x_mm, 1e-3F * y_mm, distance}));
        }
        add_light(outline, slice.radiance, scene.rgb);
    }
    return scene;
}

color::Rgb flame_illuminance_lx(const Candle& candle) {
    check(candle);
    color::Rgb sum{};
    for (const Slice& slice : flame_slices(candle)) {
        const auto& c = slice.corners;
        const float area_mm2 = (c[1][0] - c[0][0] + c[2][0] - c[3][0]) / 2 * (c[2][1] - c[1][1]);
        const double sr = 1e-6 * double{area_mm2} / (candle.distance_m * candle.distance_m);
        sum[0] += sr * double{slice.radiance.x};
        sum[1] += sr * double{slice.radiance.y};
        sum[2] += sr * double{slice.radiance.z};
    }
    return sum;
}

}  // namespace aureole::scene
