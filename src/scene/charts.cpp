// The test charts `point` and `bars`.
#include <algorithm>
#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "scene/builders.h"
#include "scene/noise.h"

namespace aureole::scene {
namespace {

constexpr float kBackground = 0.01F;  // cd/m2, of `bars`
constexpr float kBrightest = 1e5F;

// An axis-aligned rectangle in continuous pixel coordinates.
struct Bar {
    double left;
    double top;
    double right;
    double bottom;
    Vec3 radiance;
};

double overlap(double low, double high, int pixel) {
    return std::clamp(std::min(high, pixel + 1.0) - std::max(low, 1.0 * pixel), 0.0, 1.0);
}

// Bars do not overlap, so that shares of a pixel add up.
void draw(const Bar& bar, Image& picture) {
    const int first_row = std::max(0, static_cast<int>(std::floor(bar.top)));
    const int last_row = std::min(picture.height(), static_cast<int>(std::ceil(bar.bottom)));
    const int first = std::max(0, static_cast<int>(std::floor(bar.left)));
    const int last = std::min(picture.width(), static_cast<int>(std::ceil(bar.right)));
    const float over[] = {bar.radiance.x - kBackground, bar.radiance.y - kBackground,
                          bar.radiance.z - kBackground};
    for (int y = first_row; y < last_row; ++y) {
        const double rows = overlap(bar.top, bar.bottom, y);
        for (int x = first; x < last; ++x) {
            const auto share = static_cast<float>(rows * overlap(bar.left, bar.right, x));
            for (int c = 0; c < 3; ++c) picture.at(x, y, c) += share * over[c];
        }
    }
}

}  // namespace

Scene make_point(const SceneOptions& options, const View& view) {
    const auto position = [](const char* what, std::optional<int> value, int size) {
        const int pixel = value.value_or(size / 2);
        if (pixel < 0 || pixel >= size) {
            throw InvalidArgument(what, std::to_string(pixel),
                                  "must be in [0, " + std::to_string(size) + ")");
        }
        return pixel;
    };
    const int x = position("point_x", options.point_x, view.width);
    const int y = position("point_y", options.point_y, view.height);
    if (!(options.point_cd_m2 >= 0 && std::isfinite(options.point_cd_m2))) {
        throw InvalidArgument("point_cd_m2", std::to_string(options.point_cd_m2),
                              "must be finite and not negative");
    }
    Scene scene{Image(view.width, view.height, 3), view, 0.01, 1};
    for (int c = 0; c < 3; ++c) scene.rgb.at(x, y, c) = static_cast<float>(options.point_cd_m2);
    return scene;
}

Scene make_bars(const SceneOptions&, const View& view) {
    Scene scene{Image(view.width, view.height, 3), view, 0, 1000};
    const double w = view.width;
    const double h = view.height;
    for (int c = 0; c < 3; ++c) std::fill_n(scene.rgb.plane(c), scene.rgb.pixels(), kBackground);

    // Grey steps, half a decade each.
    constexpr int kSteps = 15;
    for (int i = 0; i < kSteps; ++i) {
        const auto level = static_cast<float>(std::pow(10.0, -2 + 0.5 * i));
        draw({w * (0.04 + 0.92 * i / kSteps), h * 0.05, w * (0.04 + 0.92 * (i + 1) / kSteps),
              h * 0.27, Vec3{level, level, level}},
             scene.rgb);
    }

    // The same ramp without steps: each column holds the luminance at its centre.
    const double ramp_top = h * 0.31;
    const double ramp_bottom = h * 0.39;
    for (int x = 0; x < view.width; ++x) {
        const double t = ((x + 0.5) / w - 0.04) / 0.92;
        if (t < 0 || t > 1) continue;
        const auto level = static_cast<float>(std::pow(10.0, -2 + 7 * t));
        draw({1.0 * x, ramp_top, x + 1.0, ramp_bottom, Vec3{level, level, level}}, scene.rgb);
    }

    // Colours of equal luminance, one row per decade or two.
    const Vec3 colours[] = {{1, 1, 1}, {1, 1, 0}, {0, 1, 1}, {0, 1, 0},
                            {1, 0, 1}, {1, 0, 0}, {0, 0, 1}, {1, 0.35F, 0.05F}};
    const float levels[] = {0.1F, 10, 1000, kBrightest};
    for (int row = 0; row < 4; ++row) {
        for (int i = 0; i < 8; ++i) {
            draw({w * (0.04 + 0.92 * i / 8), h * (0.43 + 0.075 * row),
                  w * (0.04 + 0.92 * (i + 0.94) / 8), h * (0.43 + 0.075 * row + 0.065),
                  unit_luminance(colours[i]) * levels[row]},
                 scene.rgb);
        }
    }

    // Thin bars of given angular width, upright and level.
    const double f = view.focal_length_px();
    const double widths_deg[] = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
    for (int i = 0; i < 7; ++i) {
        const double centre = w * (0.1 + 0.085 * i);
        const double u = (centre - view.axis_x) / f;
        const double half_width = 0.5 * f * rad_from_deg(widths_deg[i]) * (1 + u * u);
        draw({centre - half_width, h * 0.77, centre + half_width, h * 0.95,
              Vec3{kBrightest, kBrightest, kBrightest}},
             scene.rgb);
        const double level_y = h * (0.785 + 0.025 * i);
        const double v = (level_y - view.axis_y) / f;
        const double half_height = 0.5 * f * rad_from_deg(widths_deg[i] / 4) * (1 + v * v);
        draw({w * 0.72, level_y - half_height, w * 0.94, level_y + half_height,
              Vec3{kBrightest, kBrightest, kBrightest}},
             scene.rgb);
    }
    scene.adaptation_cd_m2 = 30;  // the middle of the decades
    return scene;
}

}  // namespace aureole::scene
