#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/light.h"
#include "sources/find_lights_regions.h"
#include "sources/find_lights_split.h"

namespace aureole::sources {
namespace {

constexpr double kThresholdOverMean = 16;
constexpr double kLargest = std::numeric_limits<float>::max();

void check(const ConstImageView& picture, const View& view, const FindLightsOptions& options) {
    if (picture.data == nullptr || picture.width < 1 || picture.height < 1) {
        throw InvalidArgument("picture", fmt::format("{}x{}", picture.width, picture.height),
                              "must have pixels");
    }
    if (picture.channels != 1 && picture.channels != 3) {
        throw InvalidArgument("channels of the picture", fmt::format("{}", picture.channels),
                              "must be 3, or 1 for grey");
    }
    if (picture.width != view.width || picture.height != view.height) {
        throw InvalidArgument(
            "picture", fmt::format("{}x{}", picture.width, picture.height),
            fmt::format("must have the size of the view, {}x{}", view.width, view.height));
    }
    if (!(options.threshold >= 0) || !std::isfinite(options.threshold)) {
        throw InvalidArgument("threshold of lights", fmt::format("{}", options.threshold),
                              "must be finite and not negative");
    }
    if (options.max_lights < 1 || options.max_lights > 100000) {
        throw InvalidArgument("most lights", fmt::format("{}", options.max_lights),
                              "must be 1 to 100000");
    }
    if (!(options.max_radius > 0 && options.max_radius <= 1)) {
        throw InvalidArgument("largest radius of a light", fmt::format("{}", options.max_radius),
                              "must be in (0, 1], as a share of the picture's width");
    }
}

double mean_luminance(const ConstImageView& picture) {
    std::vector<double> rows(static_cast<std::size_t>(picture.height));
    std::vector<std::vector<float>> scratch(static_cast<std::size_t>(max_workers()));
    parallel_for(rows.size(), [&](std::size_t y, int worker) {
        auto& values = scratch[static_cast<std::size_t>(worker)];
        values.resize(static_cast<std::size_t>(picture.width));
        luminance_row(picture, static_cast<int>(y), values.data());
        // Four independent sums: the order is fixed, and additions overlap.
        double sums[4] = {};
        std::size_t x = 0;
        for (; x + 4 <= values.size(); x += 4) {
            for (std::size_t s = 0; s < 4; ++s) sums[s] += static_cast<double>(values[x + s]);
        }
        for (; x < values.size(); ++x) sums[0] += static_cast<double>(values[x]);
        rows[y] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(picture.pixels());
}

Light light_from(const LightSums& sums) {
    Light light;
    light.tan_x = sums.x / sums.luminous;
    light.tan_y = sums.y / sums.luminous;
    light.solid_angle_sr = sums.luminous * (sums.luminous / sums.luminous_squared);
    for (std::size_t c = 0; c < 3; ++c) {
        light.radiance[c] =
            static_cast<float>(std::min(sums.energy[c] / light.solid_angle_sr, kLargest));
    }
    const Moments moments = sums.central();
    light.moment_xx = moments.xx;
    light.moment_xy = moments.xy;
    light.moment_yy = moments.yy;
    return light;
}

}  // namespace

FoundLights find_lights(const ConstImageView& picture, const View& view,
                        const FindLightsOptions& options) {
    check(picture, view, options);
    const PixelGeometry geometry(view);
    FoundLights found;
    found.threshold = options.threshold;
    if (options.threshold == 0) {
        found.threshold =
            static_cast<float>(std::min(kThresholdOverMean * mean_luminance(picture), kLargest));
        if (!(found.threshold > 0)) return found;  // a black picture
    }
    const BrightPixels pixels(picture, geometry, found.threshold);
    const Regions regions = find_regions(pixels);
    found.regions = regions.sums.size();
    const double widest = options.max_radius * view.width * geometry.pixel_tangent();
    std::vector<LightSums> parts = split_regions(pixels, regions, widest);
    std::stable_sort(parts.begin(), parts.end(), [](const LightSums& a, const LightSums& b) {
        return a.luminous > b.luminous;
    });
    const std::size_t kept = std::min(parts.size(), static_cast<std::size_t>(options.max_lights));
    found.lights.reserve(kept);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i < kept) {
            found.lights.push_back(light_from(parts[i]));
            found.energy_kept += luminous_energy(found.lights.back());
        } else {
            found.energy_dropped += parts[i].luminous;
        }
    }
    return found;
}

}  // namespace aureole::sources
