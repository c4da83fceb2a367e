#include "aureole/ibl/roughness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "aureole/base/error.h"

namespace aureole::ibl {
namespace {

constexpr int kSmallestUsefulSize = 16;
constexpr int kLargestSize = 16384;

double roughness_of(RoughnessMapping mapping, int level, int levels, int size) {
    const double l = static_cast<double>(level) / (levels - 1);
    switch (mapping) {
        case RoughnessMapping::kFilament:
            return 1 - std::sqrt(1 - l);
        case RoughnessMapping::kUe4: {
            const int last = std::bit_width(static_cast<unsigned>(size) - 1);  // ceil(log2(size))
            return std::exp2((1.0 - (last - 1 - level)) / 1.2);
        }
        case RoughnessMapping::kUnity:  // the smaller root of .7 r^2 - 1.7 r + l = 0
            return (1.7 - std::sqrt(1.7 * 1.7 - 4 * 0.7 * l)) / (2 * 0.7);
        case RoughnessMapping::kGltf:
        case RoughnessMapping::kLinear:
            break;
    }
    return l;
}

}  // namespace

int most_levels(int size) { return std::bit_width(static_cast<unsigned>(size)); }

int default_levels(RoughnessMapping mapping, int size) {
    if (mapping == RoughnessMapping::kUe4) return most_levels(size);
    return std::max(1, most_levels(size / kSmallestUsefulSize));
}

std::vector<double> level_roughness(RoughnessMapping mapping, int levels, int size) {
    if (size < 1 || size > kLargestSize) {
        throw InvalidArgument("size", std::to_string(size), "must be in [1, 16384]");
    }
    if (levels < 1 || levels > most_levels(size)) {
        throw InvalidArgument("levels", std::to_string(levels),
                              "a chain of size " + std::to_string(size) + " has 1 to " +
                                  std::to_string(most_levels(size)) + " levels");
    }
    std::vector<double> roughness(static_cast<std::size_t>(levels), 0.0);
    for (int level = 1; level < levels; ++level) {
        roughness[static_cast<std::size_t>(level)] =
            std::min(1.0, roughness_of(mapping, level, levels, size));
    }
    return roughness;
}

double level_of_roughness(const std::vector<double>& level_roughness, double roughness) {
    const auto above = std::lower_bound(level_roughness.begin(), level_roughness.end(), roughness);
    if (above == level_roughness.begin()) return 0;
    const auto below = above - 1;
    const auto level = static_cast<double>(below - level_roughness.begin());
    if (above == level_roughness.end()) {
        // The first of those that are equal to the last.
        return static_cast<double>(std::lower_bound(level_roughness.begin(), below, *below) -
                                   level_roughness.begin());
    }
    return level + (roughness - *below) / (*above - *below);
}

}  // namespace aureole::ibl
