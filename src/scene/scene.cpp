#include "aureole/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "scene/builders.h"

namespace aureole::scene {
namespace {

struct Entry {
    SceneInfo info;
    Scene (*make)(const SceneOptions&, const View&);
};

constexpr Entry kScenes[] = {
    {{"night-street", "a wet street at night: headlights 1e6 cd/m2, lamps 2e4, windows, stars", 60},
     make_night_street},
    {{"sun", "a tree against the sun: disc of 1.6e9 cd/m2 and 0.53 deg, deep shadows", 60},
     make_sun},
    {{"stars", "the winter sky: bright stars where they are, faint ones at random", 60},
     make_stars},
    {{"point", "one bright pixel on black", 60}, make_point},
    {{"bars", "grey steps, colours and a ramp from 1e-2 to 1e5 cd/m2, thin bright bars", 60},
     make_bars},
};

void check_size(const char* what, int value) {
    constexpr int kLargest = 32768;
    if (value < 1 || value > kLargest) {
        throw InvalidArgument(what, std::to_string(value), "must be 1 to 32768 pixels");
    }
}

}  // namespace

std::span<const SceneInfo> list_scenes() {
    static const auto infos = [] {
        std::vector<SceneInfo> list;
        for (const Entry& entry : kScenes) list.push_back(entry.info);
        return list;
    }();
    return infos;
}

Scene make_scene(std::string_view name, const SceneOptions& options) {
    for (const Entry& entry : kScenes) {
        if (entry.info.name != name) continue;
        check_size("width", options.width);
        check_size("height", options.height);
        const double fov_deg = options.fov_deg.value_or(entry.info.default_fov_deg);
        if (!(fov_deg > 0 && fov_deg <= 170)) {
            throw InvalidArgument("fov_deg", std::to_string(fov_deg), "must be in (0, 170]");
        }
        return entry.make(options, View::from_fov(options.width, options.height, fov_deg,
                                                  Projection::kPerspective));
    }
    std::string names;
    for (const Entry& entry : kScenes) {
        names += (names.empty() ? "" : ", ") + std::string(entry.info.name);
    }
    throw InvalidArgument("scene", std::string(name), "must be one of " + names);
}

Vec3 black_body_rgb(double temperature_k) {
    color::Xyz xyz{};
    for (double nm = 385; nm < 780; nm += 10) {
        const color::Xyz observer = color::cie_1931_observer(nm);
        // Planck, up to a constant; hc/k = 1.4388e7 nm K.
        const double power = std::pow(nm / 560, -5) / std::expm1(1.4388e7 / (nm * temperature_k));
        for (std::size_t c = 0; c < 3; ++c) xyz[c] += observer[c] * power;
    }
    const color::Rgb rgb = color::rgb_from_xyz({xyz[0] / xyz[1], 1, xyz[2] / xyz[1]});
    const auto lift = [](double v) { return static_cast<float>(std::max(v, 0.0)); };
    return unit_luminance({lift(rgb[0]), lift(rgb[1]), lift(rgb[2])});
}

double mean_luminance(const Image& rgb, double share) {
    std::vector<float> values(rgb.pixels());
    const auto width = static_cast<std::size_t>(rgb.width());
    parallel_for(static_cast<std::size_t>(rgb.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < rgb.width(); ++x) {
            values[row * width + static_cast<std::size_t>(x)] =
                luminance(Vec3{rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)});
        }
    });
    const auto count = std::clamp<std::size_t>(
        static_cast<std::size_t>(share * static_cast<double>(values.size())), 1, values.size());
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count - 1),
                     values.end());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += double{values[i]};
    return sum / static_cast<double>(count);
}

}  // namespace aureole::scene
