#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"
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

// Sums of |light| over channels, times weight.
void energy_row(const ConstImageView& light, const float* weights, int y, float* out) {
    for (int x = 0; x < light.width; ++x) out[x] = std::abs(light.at(x, y, 0));
    for (int c = 1; c < light.channels; ++c) {
        for (int x = 0; x < light.width; ++x) out[x] += std::abs(light.at(x, y, c));
    }
    if (weights == nullptr) return;
    const float* row =
        weights + static_cast<std::size_t>(y) * static_cast<std::size_t>(light.width);
    for (int x = 0; x < light.width; ++x) out[x] *= row[x];
}

}  // namespace

float dim_limit_for(const ConstImageView& light, const float* weights, double share) {
    if (!(share >= 0 && share <= 1)) {
        throw InvalidArgument("share", fmt::format("{}", share), "must be in [0, 1]");
    }
    const int parts = (light.height + kRowsPerPart - 1) / kRowsPerPart;
    std::vector<Histogram> histograms(static_cast<std::size_t>(parts));
    parallel_for(histograms.size(), [&](std::size_t part, int) {
        Histogram& histogram = histograms[part];
        histogram.fill(0);
        std::vector<float> largest(static_cast<std::size_t>(light.width));
        std::vector<float> energy(largest.size());
        const int first = static_cast<int>(part) * kRowsPerPart;
        const int end = std::min(light.height, first + kRowsPerPart);
        for (int y = first; y < end; ++y) {
            largest_channel_row(light, y, largest.data());
            energy_row(light, weights, y, energy.data());
            for (std::size_t x = 0; x < largest.size(); ++x) {
                histogram[bin_of(largest[x])] += static_cast<double>(energy[x]);
            }
        }
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
