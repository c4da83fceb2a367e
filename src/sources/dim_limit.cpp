#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/clusters.h"

namespace aureole::sources {
namespace {

// Bins of equal width in the bits of positive floats: 32 per octave, 3 % wide at most.
constexpr unsigned kDroppedBits = 18;
constexpr std::size_t kBins = std::size_t{1} << (31U - kDroppedBits);
constexpr int kRowsPerPart = 64;

std::size_t bin_of(float value) { return std::bit_cast<std::uint32_t>(value) >> kDroppedBits; }
float lower_edge(std::size_t bin) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << kDroppedBits);
}

using Histogram = std::array<double, kBins>;

void add_row(const ConstImageView& light, const float* weights, int y, Histogram& histogram) {
    for (int x = 0; x < light.width; ++x) {
        float largest = 0;
        double sum = 0;
        for (int c = 0; c < light.channels; ++c) {
            const float value = std::abs(light.at(x, y, c));
            largest = std::max(largest, value);
            sum += static_cast<double>(value);
        }
        if (weights != nullptr) {
            sum *= static_cast<double>(
                weights[static_cast<std::size_t>(y) * static_cast<std::size_t>(light.width) +
                        static_cast<std::size_t>(x)]);
        }
        histogram[bin_of(largest)] += sum;
    }
}

}  // namespace

float dim_limit_for(const ConstImageView& light, const float* weights, double share) {
    if (!(share >= 0 && share <= 1)) {
        throw InvalidArgument("share", fmt::format("{}", share), "must be in [0, 1]");
    }
    const int parts = (light.height + kRowsPerPart - 1) / kRowsPerPart;
    std::vector<Histogram> histograms(static_cast<std::size_t>(parts));
    parallel_for(histograms.size(), [&](std::size_t part, int) {
        histograms[part].fill(0);
        const int first = static_cast<int>(part) * kRowsPerPart;
        const int end = std::min(light.height, first + kRowsPerPart);
        for (int y = first; y < end; ++y) add_row(light, weights, y, histograms[part]);
    });
    std::vector<double> bins(kBins, 0.0);
    double total = 0;
    for (const Histogram& histogram : histograms) {
        for (std::size_t i = 0; i < kBins; ++i) {
            bins[i] += histogram[i];
            total += histogram[i];
        }
    }
    double below = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
        if (below + bins[i] > share * total) return std::nextafter(lower_edge(i), 0.0F);
        below += bins[i];
    }
    return lower_edge(kBins - 1);
}

}  // namespace aureole::sources
