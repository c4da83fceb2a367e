#include "aureole/sources/brightness_histogram.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"
#include "aureole/sources/clusters.h"
#include "sources/brightness_sums.h"

namespace aureole::sources {
namespace {

constexpr int kSide = BrightnessHistogram::kBlockSide;
// Bins of equal width in the bits of positive floats: 32 per octave, 3 % wide at most.
constexpr unsigned kDroppedBits = 18;
constexpr std::size_t kBins = std::size_t{1} << (31U - kDroppedBits);
constexpr std::size_t kParts = 8;
constexpr std::size_t kLanes = 2;  // histograms in turns: neighbours are often of one brightness
constexpr std::size_t kPartSize = kLanes * kBins;

std::size_t bin_of(float value) { return std::bit_cast<std::uint32_t>(value) >> kDroppedBits; }
float lower_edge(std::size_t bin) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bin) << kDroppedBits);
}

void check_share(double share) {
    if (!(share >= 0 && share <= 1)) {
        throw InvalidArgument("share", fmt::format("{}", share), "must be in [0, 1]");
    }
}

const float* weights_at(const float* weights, int width, int x, int y) {
    return weights == nullptr ? nullptr : weights + static_cast<std::ptrdiff_t>(y) * width + x;
}

// out[x] = sum of |light| over channels, times weight.
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
    for (int x = 0; x < light.width; ++x) out[x] *= weights[x];
}

struct BlockPlace {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

BlockPlace place_of(const ConstImageView& light, int columns, std::size_t block) {
    BlockPlace place;
    place.x = static_cast<int>(block % static_cast<std::size_t>(columns)) * kSide;
    place.y = static_cast<int>(block / static_cast<std::size_t>(columns)) * kSide;
    place.width = std::min(kSide, light.width - place.x);
    place.height = std::min(kSide, light.height - place.y);
    return place;
}

ConstImageView columns_of(const ConstImageView& light, const BlockPlace& place) {
    ConstImageView part = light;
    part.data += light.offset(place.x, 0, 0);
    part.width = place.width;
    return part;
}

}  // namespace

BrightnessHistogram::BrightnessHistogram()
    : bins_(kBins), block_bins_(kBins), parts_(kParts * kPartSize) {}

// Row by row, which is the order of memory, into one row of sums; then by blocks.
void BrightnessHistogram::look_at_strip(const ConstImageView& light, const float* weights, int row,
                                        float* scratch) {
    float* const energy = scratch;
    float* const largest = energy + light.width;
    float* const weight = largest + light.width;
    const int y0 = row * kSide;
    const int y1 = std::min(light.height, y0 + kSide);
    std::fill_n(energy, 3 * light.width, 0.0F);
    for (int y = y0; y < y1; ++y) {
        const float* w = weights_at(weights, light.width, 0, y);
        add_brightness_row(light, w, y, energy, largest);
        for (int x = 0; w != nullptr && x < light.width; ++x) weight[x] += w[x];
    }
    if (weights == nullptr) std::fill_n(weight, light.width, static_cast<float>(y1 - y0));
    for (int column = 0; column < block_columns_; ++column) {
        Block block;
        for (int x = column * kSide; x < std::min(light.width, (column + 1) * kSide); ++x) {
            block.largest = std::max(block.largest, largest[x]);
            block.energy += static_cast<double>(energy[x]);
            block.weight += static_cast<double>(weight[x]);
        }
        blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(block_columns_) +
                static_cast<std::size_t>(column)] = block;
    }
}

void BrightnessHistogram::look(const ConstImageView& light, const float* weights) {
    channels_ = light.channels;
    block_columns_ = (light.width + kSide - 1) / kSide;
    block_rows_ = (light.height + kSide - 1) / kSide;
    blocks_.resize(static_cast<std::size_t>(block_columns_) *
                   static_cast<std::size_t>(block_rows_));
    const std::size_t row_size = 3 * static_cast<std::size_t>(light.width);
    scratch_.resize(row_size * static_cast<std::size_t>(max_workers()));
    parallel_for(static_cast<std::size_t>(block_rows_), [&](std::size_t row, int worker) {
        look_at_strip(light, weights, static_cast<int>(row),
                      scratch_.data() + static_cast<std::size_t>(worker) * row_size);
    });
    std::fill(block_bins_.begin(), block_bins_.end(), BlockBin{});
    total_ = 0;
    for (const Block& block : blocks_) {
        BlockBin& bin = block_bins_[bin_of(block.largest)];
        total_ += block.energy;
        bin.energy += block.energy;
        bin.weight += block.weight;
        ++bin.blocks;
    }
    // All of a block at its largest value: what is really below a limit is at least that.
    for (std::size_t i = 0; i < kBins; ++i) {
        bins_[i] = {block_bins_[i].energy, static_cast<double>(block_bins_[i].blocks)};
    }
}

// Below bin i lies at most the energy of the blocks that are all below it, and in the others what
// there would be if all their pixels reached it. As long as that is at most the share, no limit for
// it is below.
BrightnessHistogram::Begin BrightnessHistogram::begin_of(double least_share) const {
    check_share(least_share);
    Begin begin{0, blocks_.size()};
    double weight = 0;
    for (const BlockBin& bin : block_bins_) weight += bin.weight;
    double below = 0;
    std::size_t above = blocks_.size();
    for (std::size_t i = 0; i < kBins && below <= least_share * total_; ++i) {
        const double most = static_cast<double>(lower_edge(i)) * channels_ * std::max(0.0, weight);
        if (below + most <= least_share * total_) begin = {i, above};
        below += block_bins_[i].energy;
        above -= block_bins_[i].blocks;
        weight -= block_bins_[i].weight;
    }
    return begin;
}

std::size_t BrightnessHistogram::blocks_to_count(double least_share) const {
    return begin_of(least_share).blocks;
}

void BrightnessHistogram::count_block(const ConstImageView& light, const float* weights,
                                      std::size_t block, std::size_t least, Bin* bins) const {
    const BlockPlace place = place_of(light, block_columns_, block);
    const ConstImageView part = columns_of(light, place);
    std::array<float, kSide> largest;
    std::array<float, kSide> energy;
    for (int y = place.y; y < place.y + place.height; ++y) {
        largest_channel_row(part, y, largest.data());
        energy_row(part, weights_at(weights, light.width, place.x, y), y, energy.data());
        for (std::size_t x = 0; x < static_cast<std::size_t>(place.width); ++x) {
            Bin& bin = bins[std::max(bin_of(largest[x]), least) * kLanes + x % kLanes];
            bin.energy += static_cast<double>(energy[x]);
            bin.pixels += 1;
        }
    }
}

void BrightnessHistogram::count(const ConstImageView& light, const float* weights,
                                double least_share, int block_step) {
    if (block_step < 1) {
        throw InvalidArgument("block step", fmt::format("{}", block_step), "must be at least 1");
    }
    const std::size_t first = begin_of(least_share).bin;
    // What is below the first bin, wherever.
    const std::size_t least = first > 0 ? first - 1 : 0;
    std::size_t last = first;
    std::size_t matter = 0;
    std::fill(bins_.begin(), bins_.end(), Bin{});
    chosen_.clear();
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const std::size_t bin = bin_of(blocks_[i].largest);
        if (bin < first) {
            bins_[least].energy += blocks_[i].energy;
            continue;
        }
        last = std::max(last, bin);
        if (matter++ % static_cast<std::size_t>(block_step) == 0) {
            chosen_.push_back(static_cast<std::uint32_t>(i));
        }
    }
    if (chosen_.empty()) return;
    const std::size_t per_part = (chosen_.size() + kParts - 1) / kParts;
    const std::size_t begin_bin = least * kLanes;
    const std::size_t end_bin = (last + 1) * kLanes;
    parallel_for(kParts, [&](std::size_t part, int) {
        Bin* bins = parts_.data() + part * kPartSize;
        std::fill(bins + begin_bin, bins + end_bin, Bin{});
        const std::size_t end = std::min(chosen_.size(), (part + 1) * per_part);
        for (std::size_t i = part * per_part; i < end; ++i) {
            count_block(light, weights, chosen_[i], least, bins);
        }
    });
    const double scale = static_cast<double>(matter) / static_cast<double>(chosen_.size());
    for (std::size_t part = 0; part < kParts; ++part) {
        const Bin* bins = parts_.data() + part * kPartSize;
        for (std::size_t i = begin_bin; i < end_bin; ++i) {
            bins_[i / kLanes].energy += scale * bins[i].energy;
            bins_[i / kLanes].pixels += scale * bins[i].pixels;
        }
    }
}

void BrightnessHistogram::measure(const ConstImageView& light, const float* weights,
                                  double least_share) {
    look(light, weights);
    count(light, weights, least_share);
}

bool BrightnessHistogram::may_be_above(float limit, int x0, int y0, int x1, int y1) const noexcept {
    const int last_column = std::min(block_columns_ - 1, (x1 - 1) / kSide);
    const int last_row = std::min(block_rows_ - 1, (y1 - 1) / kSide);
    for (int row = std::max(0, y0) / kSide; row <= last_row; ++row) {
        const Block* blocks = blocks_.data() + static_cast<std::ptrdiff_t>(row) * block_columns_;
        for (int column = std::max(0, x0) / kSide; column <= last_column; ++column) {
            if (blocks[column].largest > limit) return true;
        }
    }
    return false;
}

float BrightnessHistogram::dim_limit(double share) const {
    check_share(share);
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
    histogram.measure(light, weights, share);
    return histogram.dim_limit(share);
}

}  // namespace aureole::sources
