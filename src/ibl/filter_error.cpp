#include "aureole/ibl/filter_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/color/rgb.h"

namespace aureole::ibl {
namespace {

constexpr std::size_t kTexelsAtOnce = 64;  // between two looks at the progress

struct Place {
    int face = 0;
    int x = 0;
    int y = 0;
};

Place place_of(std::size_t index, int size) {
    const auto side = static_cast<std::size_t>(size);
    return {static_cast<int>(index / (side * side)), static_cast<int>(index % side),
            static_cast<int>(index / side % side)};
}

double luminance_at(const CubeMap& map, const Place& p) {
    return color::luminance({static_cast<double>(map.at(p.face, p.x, p.y, 0)),
                             static_cast<double>(map.at(p.face, p.x, p.y, 1)),
                             static_cast<double>(map.at(p.face, p.x, p.y, 2))});
}

// One texel of the sample; `weight` sums to the number of texels of the level, in the mean.
struct Draw {
    std::size_t texel = 0;
    double weight = 1;
};

// Systematic sampling: one random offset, then even steps through the running sum of chances.
std::vector<Draw> draw_texels(const std::vector<double>& luminance, int count, std::uint64_t seed) {
    const std::size_t all = luminance.size();
    std::vector<Draw> draws;
    if (static_cast<std::size_t>(count) >= all) {
        for (std::size_t i = 0; i < all; ++i) draws.push_back({i, 1});
        return draws;
    }
    double squares = 0;
    for (const double value : luminance) squares += value * value;
    const auto chance = [&](std::size_t i) {
        const double even = 1 / static_cast<double>(all);
        return squares > 0 ? 0.5 * even + 0.5 * luminance[i] * luminance[i] / squares : even;
    };
    const double step = 1.0 / count;
    double next = step * Random(seed).uniform();
    double sum = 0;
    for (std::size_t i = 0; i < all; ++i) {
        sum += chance(i);
        for (; next < sum; next += step) draws.push_back({i, 1 / (chance(i) * count)});
    }
    return draws;
}

}  // namespace

FilterError measure_filter_error(const ExactFilter& exact, const CubeMap& level, double alpha,
                                 const FilterErrorOptions& options, Progress* progress) {
    if (level.empty()) throw InvalidArgument("level", "empty", "must have texels");
    if (!(alpha > 0 && alpha <= 1)) {
        throw InvalidArgument("alpha", fmt::format("{}", alpha), "must be in (0, 1]");
    }
    if (options.texels < 1) {
        throw InvalidArgument("texels", std::to_string(options.texels), "must be at least 1");
    }
    const int size = level.size();
    std::vector<double> luminance(static_cast<std::size_t>(kFaces) *
                                  static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < luminance.size(); ++i) {
        luminance[i] = luminance_at(level, place_of(i, size));
    }
    const double mean = std::accumulate(luminance.begin(), luminance.end(), 0.0) /
                        static_cast<double>(luminance.size());
    const std::vector<Draw> draws = draw_texels(luminance, options.texels, options.seed);
    std::vector<double> difference(draws.size());
    for (std::size_t first = 0; first < draws.size(); first += kTexelsAtOnce) {
        const std::size_t count = std::min(kTexelsAtOnce, draws.size() - first);
        parallel_for(count, [&](std::size_t k, int) {
            const std::size_t i = draws[first + k].texel;
            const Place p = place_of(i, size);
            const auto truth = exact.at(texel_direction(p.face, p.x, p.y, size), alpha);
            difference[first + k] = luminance[i] - color::luminance(truth);
        });
        if (progress == nullptr) continue;
        progress->report("measure",
                         static_cast<double>(first + count) / static_cast<double>(draws.size()));
        if (progress->cancelled()) throw Cancelled();
    }
    FilterError error;
    error.texels = static_cast<int>(draws.size());
    if (!(mean > 0)) return error;
    double squares = 0;
    double sum = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        squares += draws[i].weight * difference[i] * difference[i];
        sum += draws[i].weight * difference[i];
        error.most = std::max(error.most, std::abs(difference[i]) / mean);
    }
    error.rms = std::sqrt(squares / static_cast<double>(luminance.size())) / mean;
    error.bias = sum / static_cast<double>(luminance.size()) / mean;
    return error;
}

}  // namespace aureole::ibl
