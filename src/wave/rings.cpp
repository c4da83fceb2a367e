#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/wave/diffraction.h"
#include "wave/transform_samples.h"

namespace aureole::wave {

int ring_count(int samples) { return static_cast<int>(std::lround(samples * std::sqrt(0.5))) + 1; }

std::vector<double> ring_means(const Field& transform) {
    const int n = transform.grid.samples;
    const int half = n / 2;
    const std::vector<float> gain = box_filter_gain(transform);
    const auto rings = static_cast<std::size_t>(ring_count(n));
    // Distances |l| from 0 to N/2 in fixed chunks, summed in order: independent of the threads.
    constexpr int kChunks = 32;
    const int rows_per_chunk = half / kChunks + 1;
    std::vector<std::vector<double>> sums(kChunks);
    std::vector<std::vector<double>> counts(kChunks);
    parallel_for(kChunks, [&](std::size_t chunk, int) {
        auto& sum = sums[chunk];
        auto& count = counts[chunk];
        sum.assign(rings, 0);
        count.assign(rings, 0);
        std::vector<std::int32_t> ring(static_cast<std::size_t>(half) + 1);
        const int first = static_cast<int>(chunk) * rows_per_chunk;
        const int end = std::min(first + rows_per_chunk, half + 1);
        for (int l = first; l < end; ++l) {
            ring_row(n, l, ring.data());
            // Rows l and -l; 0 and N/2 are their own mirrors, as are columns 0 and N/2.
            const float row_gain = gain[static_cast<std::size_t>(l)];
            const bool mirrored = l != 0 && l != half;
            for (int side = 0; side < (mirrored ? 2 : 1); ++side) {
                const auto row = static_cast<std::size_t>(side == 0 ? l : n - l);
                const float* re = transform.re.data() + row * static_cast<std::size_t>(n);
                const float* im = transform.im.data() + row * static_cast<std::size_t>(n);
                const auto power = [&](int k) { return re[k] * re[k] + im[k] * im[k]; };
                const auto add = [&](int k, float value, double samples) {
                    const auto column = static_cast<std::size_t>(k);
                    const auto r = static_cast<std::size_t>(ring[column]);
                    sum[r] += static_cast<double>(value * (gain[column] * row_gain));
                    count[r] += samples;
                };
                add(0, power(0), 1);
                for (int k = 1; k < half; ++k) add(k, power(k) + power(n - k), 2);
                add(half, power(half), 1);
            }
        }
    });
    std::vector<double> means(rings, 0);
    std::vector<double> totals(rings, 0);
    for (std::size_t chunk = 0; chunk < kChunks; ++chunk) {
        for (std::size_t r = 0; r < rings; ++r) {
            means[r] += sums[chunk][r];
            totals[r] += counts[chunk][r];
        }
    }
    for (std::size_t r = 0; r < rings; ++r) {
        if (totals[r] > 0) means[r] /= totals[r];
    }
    return means;
}

}  // namespace aureole::wave
