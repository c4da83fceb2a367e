// A picture, a light and single ghosts for tests of traced ghosts.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/image/view.h"
#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "lens/traced_ghosts.h"

namespace aureole::lens {

// A picture `width` pixels wide of so many mm across the sensor, 16 to 9.
inline View view_for(const Lens& lens, int width, double sensor_mm = 36) {
    const double fov_deg = 2 * std::atan(0.5 * sensor_mm / lens.efl_mm()) * 180 / kPi;
    return View::from_fov(width, width * 9 / 16, fov_deg, Projection::kPerspective);
}

struct Bench {
    explicit Bench(const Lens& a_lens, int width = 480, FlareOptions an_options = {},
                   IrisShape shape = {}, double sensor_mm = 36)
        : lens(a_lens),
          view(view_for(lens, width, sensor_mm)),
          film(lens, view),
          iris(shape),
          options(an_options),
          list(enumerate_ghosts(lens, GhostSet::kAll)),
          ghosts(lens, iris, film, options, list, nullptr),
          canvas(view.width, view.height) {}
    explicit Bench(const std::string& id, int width = 480, FlareOptions an_options = {},
                   LensSettings settings = {})
        : Bench(Lens(shipped_lens(id), settings), width, an_options) {}

    sources::Light light(double right_deg, double up_deg, double diameter_deg = 0) const {
        return sources::light_in_direction(
            right_deg, up_deg, {1, 1, 1}, diameter_deg,
            view.pixel_solid_angle_sr(view.width / 2, view.height / 2));
    }

    Image draw(const sources::Light& light, const std::vector<GhostDraw>& draws) {
        Image out(view.width, view.height, 3);
        canvas.clear();
        ghosts.draw(light, draws, canvas);
        canvas.add_to(out);
        return out;
    }
    Image draw(const sources::Light& light, int ghost, int level = 0) {
        return draw(light, {GhostDraw{ghost, level, {1, 1, 1}}});
    }
    std::vector<GhostDraw> all(int level = 0) const {
        std::vector<GhostDraw> draws;
        for (std::size_t g = 0; g < list.size(); ++g) {
            draws.push_back({static_cast<int>(g), level, {1, 1, 1}});
        }
        return draws;
    }

    Lens lens;
    View view;
    Film film;
    Iris iris;
    FlareOptions options;
    std::vector<Bounces> list;
    TracedGhosts ghosts;
    Canvas canvas;
};

inline double sum_of(const Image& image) {
    double sum = 0;
    for (int c = 0; c < image.channels(); ++c) {
        for (std::size_t k = 0; k < image.pixels(); ++k) sum += image.plane(c)[k];
    }
    return sum;
}

}  // namespace aureole::lens
