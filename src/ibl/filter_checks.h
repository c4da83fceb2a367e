// How tests compare a filter with the truth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "ibl/filter_oracle.h"
#include "ibl/level_filter.h"

namespace aureole::ibl {

struct Output {
    int face = 0;
    int x = 0;
    int y = 0;
};

inline double luminance_of(const std::array<double, 3>& rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

inline std::array<double, 3> color_at(const CubeMap& map, const Output& at) {
    return {map.at(at.face, at.x, at.y, 0), map.at(at.face, at.x, at.y, 1),
            map.at(at.face, at.x, at.y, 2)};
}

inline double luminance_at(const CubeMap& map, const Output& at) {
    return luminance_of(color_at(map, at));
}

inline std::vector<CubeMap> filtered_levels(const CubeMap& environment,
                                            const std::vector<FilteredLevel>& levels,
                                            FilterQuality quality) {
    const auto filter = make_gather_filter(environment.size(), levels, quality);
    filter->prepare(environment);
    std::vector<CubeMap> maps;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        CubeMap& map = maps.emplace_back(levels[k].size);
        parallel_for(static_cast<std::size_t>(tile_count(map.size())),
                     [&](std::size_t i, int worker) {
                         filter->filter(static_cast<int>(k),
                                        tile_at(static_cast<int>(i), map.size()), worker, map);
                     });
    }
    return maps;
}

// Colors that `outputs` of a level of `size` texels per side should have.
inline std::vector<std::array<double, 3>> true_colors(const FilterOracle& oracle, double alpha,
                                                      int size,
                                                      const std::vector<Output>& outputs) {
    std::vector<std::array<double, 3>> values(outputs.size());
    parallel_for(outputs.size(), [&](std::size_t i, int) {
        const Output& at = outputs[i];
        values[i] = oracle.filtered(texel_direction(at.face, at.x, at.y, size), alpha);
    });
    return values;
}

inline std::vector<double> true_luminances(const FilterOracle& oracle, double alpha, int size,
                                           const std::vector<Output>& outputs) {
    std::vector<double> values;
    for (const auto& rgb : true_colors(oracle, alpha, size, outputs)) {
        values.push_back(luminance_of(rgb));
    }
    return values;
}

inline std::vector<Output> all_outputs(int size) {
    std::vector<Output> outputs;
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) outputs.push_back({face, x, y});
        }
    }
    return outputs;
}

inline std::vector<Output> random_outputs(int size, int count) {
    Random random(11, static_cast<std::uint64_t>(size));
    std::vector<Output> outputs;
    for (int i = 0; i < count; ++i) {
        outputs.push_back({static_cast<int>(random.uniform() * kFaces),
                           static_cast<int>(random.uniform() * size),
                           static_cast<int>(random.uniform() * size)});
    }
    return outputs;
}

// The truth of one level at some outputs: at all of them around the lightest texel of the
// environment, and at a random sample of the others. (A lobe around a sun covers too few outputs
// for a sample.)
class LevelTruth {
  public:
    LevelTruth(const CubeMap& environment, const FilterOracle& oracle, double alpha, int size,
               int count)
        : outputs_(all_outputs(size).size()) {
        const int reach = 2 + size / 32;
        Output lightest;
        for (const Output& at : all_outputs(environment.size())) {
            if (luminance_at(environment, at) > luminance_at(environment, lightest)) lightest = at;
        }
        lightest.x = lightest.x * size / environment.size();
        lightest.y = lightest.y * size / environment.size();
        const auto is_around = [&](const Output& at) {
            return at.face == lightest.face && std::abs(at.x - lightest.x) <= reach &&
                   std::abs(at.y - lightest.y) <= reach;
        };
        for (const Output& at : all_outputs(size)) {
            if (is_around(at)) around_.outputs.push_back(at);
        }
        for (const Output& at : random_outputs(size, count)) {
            if (!is_around(at)) others_.outputs.push_back(at);
        }
        for (Sample* sample : {&around_, &others_}) {
            sample->truth = true_colors(oracle, alpha, size, sample->outputs);
        }
    }

    // Root mean square error of luminance over the whole level, in means of the level.
    double rms_error(const CubeMap& level) const { return rms_error(level, luminance_of); }

    // That of the worst channel, each in its own means.
    double worst_channel_error(const CubeMap& level) const {
        double worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto channel = [c](const std::array<double, 3>& rgb) { return rgb[c]; };
            worst = std::max(worst, rms_error(level, channel));
        }
        return worst;
    }

  private:
    struct Sample {
        std::vector<Output> outputs;
        std::vector<std::array<double, 3>> truth;

        template <class Value>
        double mean_square(const CubeMap& level, const Value& value) const {
            double sum = 0;
            for (std::size_t i = 0; i < outputs.size(); ++i) {
                sum += std::pow(value(color_at(level, outputs[i])) - value(truth[i]), 2);
            }
            return outputs.empty() ? 0 : sum / static_cast<double>(outputs.size());
        }
    };

    template <class Value>
    double rms_error(const CubeMap& level, const Value& value) const {
        double mean = 0;
        for (const Output& at : all_outputs(level.size())) {
            mean += value(color_at(level, at)) / static_cast<double>(outputs_);
        }
        const double share =
            static_cast<double>(around_.outputs.size()) / static_cast<double>(outputs_);
        return std::sqrt(share * around_.mean_square(level, value) +
                         (1 - share) * others_.mean_square(level, value)) /
               mean;
    }

    std::size_t outputs_;
    Sample around_;
    Sample others_;
};

}  // namespace aureole::ibl
