#include "ibl/lobe_taps.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {

double FisLevel::log2_offset() const noexcept {
    const double texel_sr = 4 * kPi / (6.0 * size * size);
    return std::log2(overlap / texel_sr) + 2 * bias;
}

double FisLevel::of(double density_per_sr, double samples) const noexcept {
    const double level = 0.5 * (log2_offset() - std::log2(samples * density_per_sr));
    return std::clamp(level, 0.0, static_cast<double>(levels - 1));
}

LobeTap make_tap(const Lobe::Sample& sample, double weight, double level) noexcept {
    const double finer = std::floor(level);
    LobeTap tap;
    tap.x = static_cast<float>(sample.light.x);
    tap.y = static_cast<float>(sample.light.y);
    tap.z = static_cast<float>(sample.light.z);
    tap.weights[0] = static_cast<float>(weight * (1 - (level - finer)));
    tap.weights[1] = static_cast<float>(weight * (level - finer));
    tap.level = static_cast<int>(finer);
    return tap;
}

std::vector<LobeTap> hammersley_taps(const Lobe& lobe, int count, const FisLevel& level) {
    // Whether a point is above the horizon depends on its y, which does not depend on the number
    // of points; so the search goes point by point.
    std::uint32_t points = 0;
    double sum = 0;
    for (int found = 0; found < count; ++points) {
        const double weight = lobe.sample({0, radical_inverse(points)}).weight;
        sum += weight;
        if (weight > 0) ++found;
    }
    std::vector<LobeTap> taps;
    for (std::uint32_t i = 0; i < points; ++i) {
        const Lobe::Sample sample = lobe.sample(hammersley(i, points));
        if (sample.weight > 0) {
            taps.push_back(
                make_tap(sample, sample.weight / sum, level.of(sample.density_per_sr, points)));
        }
    }
    return taps;
}

}  // namespace aureole::ibl
