#include "aureole/sources/brightness_histogram.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

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
constexpr int kLanes = 2;  // histograms in turns: neighbours are often of one brightness

std::size_t bin_of(float value) { return std::bit_cast<std::uint32_t>(value) >> kDroppedBits; }
float lower_edge(std::size_t bin) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << kDroppedBits);
}

// Sums of |light| over channels, times weight.
void energy_row(const ConstImageView& light, const float* weights, int y, float* out) {
    for (int c = 0; c < light.channels; ++c) {
        const float* row = light.data + light.offset(0, y, c);
        const auto add = [&](auto value_at) {
            if (c == 0) {
                for (int x = 0; x < light.width; ++x) out[x] = std::abs(value_at(x));
            } else {
                for (int x = 0; x < light.width; ++x) out[x] += std::abs(value_at(x));
            }
        };
        // A stride of 1 that the compiler knows of becomes vectors.
        if (light.pixel_stride == 1) {
            add([row](int x) { return row[x]; });
        } else {
            add([row, stride = light.pixel_stride](int x) { return row[x * stride]; });
        }
    }
    if (weights == nullptr) return;
    const float* row =
        weights + static_cast<std::size_t>(y) * static_cast<std::size_t>(light.width);
    for (int x = 0; x < light.width; ++x) out[x] *= row[x];
}

}  // namespace

BrightnessHistogram::BrightnessHistogram() : bins_(kBins) {}

void BrightnessHistogram::measure(const ConstImageView& light, const float* weights, int row_step) {
    if (row_step < 1) {
        throw InvalidArgument("row step", fmt::format("{}", row_step), "must be at least 1");
    }
    const int rows = (light.height + row_step - 1) / row_step;
    const auto parts = static_cast<std::size_t>((rows + kRowsPerPart - 1) / kRowsPerPart);
    const std::size_t part_size = kLanes * kBins;
    parts_.assign(parts * part_size, {});
    const bool complete = row_step == 1;
    block_columns_ = (light.width + kBlockSide - 1) / kBlockSide;
    block_rows_ = complete ? (light.height + kBlockSide - 1) / kBlockSide : 0;
    blocks_.assign(static_cast<std::size_t>(block_columns_) * static_cast<std::size_t>(block_rows_),
                   0.0F);
    parallel_for(parts, [&](std::size_t part, int) {
        Bin* bins = parts_.data() + part * part_size;
        std::vector<float> largest(static_cast<std::size_t>(light.width));
        std::vector<float> energy(largest.size());
        const int first = static_cast<int>(part) * kRowsPerPart;
        const int end = std::min(rows, first + kRowsPerPart);
        for (int i = first; i < end; ++i) {
            const int y = std::min(i * row_step + row_step / 2, light.height - 1);
            largest_channel_row(light, y, largest.data());
            energy_row(light, weights, y, energy.data());
            for (std::size_t x = 0; x < largest.size(); ++x) {
                Bin& bin = bins[bin_of(largest[x]) * kLanes + x % kLanes];
                bin.energy += static_cast<double>(energy[x]);
                bin.pixels += 1;
            }
            if (!complete) continue;
            float* blocks =
                blocks_.data() + static_cast<std::ptrdiff_t>(y / kBlockSide) * block_columns_;
            for (int block = 0; block < block_columns_; ++block) {
                const int x0 = block * kBlockSide;
                const int x1 = std::min(light.width, x0 + kBlockSide);
                for (int x = x0; x < x1; ++x) {
                    const float value = largest[static_cast<std::size_t>(x)];
                    blocks[block] = value > blocks[block] ? value : blocks[block];
                }
            }
        }
    });
    std::fill(bins_.begin(), bins_.end(), Bin{});
    total_ = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        for (std::size_t i = 0; i < kBins; ++i) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const Bin& bin = parts_[part * part_size + i * kLanes + lane];
                bins_[i].energy += row_step * bin.energy;
                bins_[i].pixels += row_step * bin.pixels;
            }
        }
    }
    for (const Bin& bin : bins_) total_ += bin.energy;
}

bool BrightnessHistogram::may_be_above(float limit, int x0, int y0, int x1, int y1) const noexcept {
    if (blocks_.empty()) return true;
    const int last_column = std::min(block_columns_ - 1, (x1 - 1) / kBlockSide);
    const int last_row = std::min(block_rows_ - 1, (y1 - 1) / kBlockSide);
    for (int row = std::max(0, y0) / kBlockSide; row <= last_row; ++row) {
        const float* blocks = blocks_.data() + static_cast<std::ptrdiff_t>(row) * block_columns_;
        for (int column = std::max(0, x0) / kBlockSide; column <= last_column; ++column) {
            if (blocks[column] > limit) return true;
        }
    }
    return false;
}

double BrightnessHistogram::blocks_above(float limit) const noexcept {
    return static_cast<double>(std::count_if(blocks_.begin(), blocks_.end(),
                                             [limit](float value) { return value > limit; }));
}

float BrightnessHistogram::dim_limit(double share) const {
    if (!(share >= 0 && share <= 1)) {
        throw InvalidArgument("share", fmt::format("{}", share), "must be in [0, 1]");
    }
    double below = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
        if (below + bins_[i].energy > share * total_) {
            return std::nextafter(lower_edge(i), 0.0F);
        }
        below += bins_[i].energy;
    }
    return std::numeric_limits<float>::max();
}

double BrightnessHistogram::pixels_above(float limit) const {
    // The limit is the last value below a bin.
    double pixels = 0;
    for (std::size_t i = limit > 0 ? bin_of(limit) + 1 : 1; i < kBins; ++i) {
        pixels += bins_[i].pixels;
    }
    return pixels;
}

float dim_limit_for(const ConstImageView& light, const float* weights, double share) {
    BrightnessHistogram histogram;
    histogram.measure(light, weights);
    return histogram.dim_limit(share);
}

}  // namespace aureole::sources
