#include <algorithm>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/spectral_psf.h"
#include "wave/transform_samples.h"

namespace aureole::wave {
namespace {

constexpr std::size_t kBlockRows = 32;
static_assert(sizeof(double) == 2 * sizeof(float));

}  // namespace

PatternIntegral::PatternIntegral(int samples)
    : samples_(samples),
      memory_(2 * static_cast<std::size_t>(samples + 1) * static_cast<std::size_t>(samples + 1)) {}

// Builds the table in two parallel passes over blocks of rows, of which only the second writes:
// the column sums of each block, from them what lies below each block, then the table itself.
// source(j, row, ring) fills row j of the pattern in centred order; it is asked for each row
// twice, which is cheaper than a second pass over the table. `ring` is scratch for its use.
template <class RowSource>
void PatternIntegral::integrate(const RowSource& source) {
    const auto n = static_cast<std::size_t>(samples_);
    const std::size_t stride = n + 1;
    const std::size_t blocks = (n + kBlockRows - 1) / kBlockRows;
    struct Scratch {
        std::vector<float> row;
        std::vector<std::int32_t> ring;
    };
    std::vector<Scratch> scratch(static_cast<std::size_t>(max_workers()));
    const auto scratch_of = [&](int worker) -> Scratch& {
        Scratch& mine = scratch[static_cast<std::size_t>(worker)];
        mine.row.resize(n);
        mine.ring.resize(n / 2 + 1);
        return mine;
    };

    std::vector<double> below(blocks * n);
    parallel_for(blocks, [&](std::size_t block, int worker) {
        Scratch& mine = scratch_of(worker);
        double* sums = below.data() + block * n;
        std::fill_n(sums, n, 0.0);
        const std::size_t end = std::min((block + 1) * kBlockRows, n);
        for (std::size_t j = block * kBlockRows; j < end; ++j) {
            source(j, mine.row.data(), mine.ring.data());
            const float* row = mine.row.data();
            for (std::size_t i = 0; i < n; ++i) sums[i] += static_cast<double>(row[i]);
        }
    });
    // Exclusive running sum over the blocks, column by column.
    std::vector<double> running(n, 0.0);
    for (std::size_t block = 0; block < blocks; ++block) {
        double* sums = below.data() + block * n;
        for (std::size_t i = 0; i < n; ++i) {
            const double own = sums[i];
            sums[i] = running[i];
            running[i] += own;
        }
    }

    double* first = table();
    std::fill_n(first, stride, 0.0);
    parallel_for(blocks, [&](std::size_t block, int worker) {
        Scratch& mine = scratch_of(worker);
        // The table row at the lower edge of the block belongs to the block below: a copy.
        std::vector<double> start(stride, 0.0);
        const double* sums = below.data() + block * n;
        for (std::size_t i = 0; i < n; ++i) start[i + 1] = start[i] + sums[i];
        const double* previous = start.data();
        const std::size_t end = std::min((block + 1) * kBlockRows, n);
        for (std::size_t j = block * kBlockRows; j < end; ++j) {
            source(j, mine.row.data(), mine.ring.data());
            const float* row = mine.row.data();
            double* out = first + (j + 1) * stride;
            out[0] = 0;
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) {
                sum += static_cast<double>(row[i]);
                out[i + 1] = previous[i + 1] + sum;
            }
            previous = out;
        }
    });
}

PatternIntegral::PatternIntegral(const float* pattern, int samples) : PatternIntegral(samples) {
    const auto n = static_cast<std::size_t>(samples);
    integrate(
        [&](std::size_t j, float* row, std::int32_t*) { std::copy_n(pattern + j * n, n, row); });
}

PatternIntegral PatternIntegral::from_transform(const Field& transform,
                                                const RingWeights& weights) {
    const int samples = transform.grid.samples;
    const auto n = static_cast<std::size_t>(samples);
    const std::size_t half = n / 2;
    if (!weights.offset.empty() && weights.offset.size() != weights.scale.size()) {
        throw InvalidArgument(
            "ring offsets", std::to_string(weights.offset.size()),
            "must be as many as the scales, " + std::to_string(weights.scale.size()) + ", or none");
    }
    std::vector<float> scale = weights.scale;
    std::vector<float> offset = weights.offset;
    scale.resize(static_cast<std::size_t>(ring_count(samples)), 0.0F);
    offset.resize(scale.size(), 0.0F);

    const std::vector<float> gain = box_filter_gain(transform);
    PatternIntegral integral(samples);
    integral.integrate([&](std::size_t j, float* row, std::int32_t* ring) {
        const float row_gain = gain[j < half ? half - j : j - half];
        ring_row(samples, static_cast<int>(j) - samples / 2, ring);
        const std::size_t start = (j + half) % n * n;
        const float* re = transform.re.data() + start;
        const float* im = transform.im.data() + start;
        const auto value = [&](std::size_t i, std::size_t k) {
            const auto r = static_cast<std::size_t>(ring[k]);
            const float power = (re[i] * re[i] + im[i] * im[i]) * (gain[k] * row_gain);
            return power * scale[r] + offset[r];
        };
        for (std::size_t k = 0; k < half; ++k) row[half + k] = value(k, k);
        for (std::size_t k = 1; k <= half; ++k) row[half - k] = value(n - k, k);
    });
    return integral;
}

PatternIntegral PatternIntegral::from_transform(const Field& transform, double scale) {
    const int samples = transform.grid.samples;
    const auto n = static_cast<std::size_t>(samples);
    const std::size_t half = n / 2;
    const std::vector<float> gain = box_filter_gain(transform);
    std::vector<float> column_gain(n);  // in centred order
    for (std::size_t i = 0; i < n; ++i) column_gain[i] = gain[i < half ? half - i : i - half];
    PatternIntegral integral(samples);
    integral.integrate([&](std::size_t j, float* row, std::int32_t*) {
        const auto factor = static_cast<float>(scale * static_cast<double>(column_gain[j]));
        const std::size_t start = (j + half) % n * n;
        const float* re = transform.re.data() + start;
        const float* im = transform.im.data() + start;
        for (std::size_t i = 0; i < half; ++i) {
            const std::size_t h = i + half;
            row[h] = (re[i] * re[i] + im[i] * im[i]) * (column_gain[h] * factor);
            row[i] = (re[h] * re[h] + im[h] * im[h]) * (column_gain[i] * factor);
        }
    });
    return integral;
}

double PatternIntegral::sum(double u0, double u1, double v0, double v1) const {
    const double n = samples_;
    const double centre = samples_ / 2 + 0.5;
    const std::size_t stride = static_cast<std::size_t>(samples_) + 1;
    // The table between its entries is bilinear: a sample is constant over its square.
    const auto at = [&](double u, double v) {
        u = std::clamp(u + centre, 0.0, n);
        v = std::clamp(v + centre, 0.0, n);
        const int i = std::min(static_cast<int>(u), samples_ - 1);
        const int j = std::min(static_cast<int>(v), samples_ - 1);
        const double* t =
            table() + static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
        const double low = t[0] + (u - i) * (t[1] - t[0]);
        const double high = t[stride] + (u - i) * (t[stride + 1] - t[stride]);
        return low + (v - j) * (high - low);
    };
    return (at(u1, v1) - at(u0, v1)) - (at(u1, v0) - at(u0, v0));
}

double PatternIntegral::total() const {
    const std::size_t stride = static_cast<std::size_t>(samples_) + 1;
    return table()[stride * stride - 1];
}

}  // namespace aureole::wave
