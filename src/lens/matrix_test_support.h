// What the tests of matrix ghosts share.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/image/view.h"
#include "aureole/lens/library.h"
#include "lens/matrix_ghosts.h"

namespace aureole::lens {

// A light of one pixel of solid angle, or a disc.
inline sources::Light test_light(const View& view, double tan_x, double tan_y,
                                 double radius_tan = 0) {
    sources::Light light;
    light.tan_x = tan_x;
    light.tan_y = tan_y;
    light.radiance = {1000, 1200, 900};
    const double f = view.focal_length_px();
    light.solid_angle_sr = radius_tan > 0 ? kPi * radius_tan * radius_tan : 1 / (f * f);
    light.moment_xx = light.moment_yy = radius_tan * radius_tan / 4;
    return light;
}

// Across a sensor of this width behind the lens.
inline View test_view(const Lens& lens, int width, int height, double sensor_mm = 36) {
    return View::from_fov(width, height,
                          2 * deg_from_rad(std::atan(0.5 * sensor_mm / lens.efl_mm())),
                          Projection::kPerspective);
}

struct MatrixScene {
    Lens lens;
    View view;
    Film film;
    Iris iris;
    std::vector<Bounces> list;
    MatrixGhosts ghosts;
    std::optional<Canvas> canvas;  // from the first draw() on

    MatrixScene(Lens scene_lens, const View& scene_view, Iris scene_iris = Iris(),
                const FlareOptions& options = {}, const Occluder* occluder = nullptr)
        : lens(std::move(scene_lens)),
          view(scene_view),
          film(lens, view),
          iris(std::move(scene_iris)),
          list(enumerate_ghosts(lens, options.set)),
          ghosts(lens, iris, film, options, list, occluder) {}

    Image draw(const std::vector<GhostDraw>& draws) {
        Image out(view.width, view.height, 3);
        if (!canvas) canvas.emplace(view.width, view.height);
        ghosts.draw(draws, *canvas);
        canvas->add_to(out);
        return out;
    }
    Image draw_all(int level = 0) {
        std::vector<GhostDraw> draws;
        for (std::size_t i = 0; i < list.size(); ++i) draws.push_back({static_cast<int>(i), level});
        return draw(draws);
    }
};

inline double sum_of(const Image& image) {
    double sum = 0;
    for (int c = 0; c < image.channels(); ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            sum += static_cast<double>(image.plane(c)[i]);
        }
    }
    return sum;
}

}  // namespace aureole::lens
