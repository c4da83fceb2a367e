#include "aureole/sources/clusters.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"
#include "aureole/sources/brightness_histogram.h"
#include "sources/cluster_cell.h"

namespace aureole::sources {
namespace {

void check(const ConstImageView& light, const ClusterOptions& options) {
    if (light.data == nullptr || light.width < 1 || light.height < 1) {
        throw InvalidArgument("picture", fmt::format("{}x{}", light.width, light.height),
                              "must have pixels");
    }
    if (light.channels != 1 && light.channels != 3) {
        throw InvalidArgument("channels of the picture", fmt::format("{}", light.channels),
                              "must be 3, or 1 for grey");
    }
    if (!(options.error >= 0 && options.error <= 1)) {
        throw InvalidArgument("error of clusters", fmt::format("{}", options.error),
                              "must be in [0, 1]");
    }
    if (!(options.color_spread >= 0)) {
        throw InvalidArgument("colour spread of clusters", fmt::format("{}", options.color_spread),
                              "must be at least 0");
    }
    if (options.max_side < 1 || options.max_side > kMaxClusterSide ||
        !std::has_single_bit(static_cast<unsigned>(options.max_side))) {
        throw InvalidArgument("side of clusters", fmt::format("{}", options.max_side),
                              fmt::format("must be a power of two up to {}", kMaxClusterSide));
    }
    if (!(options.dim_limit >= 0)) {
        throw InvalidArgument("dim limit", fmt::format("{}", options.dim_limit),
                              "must be at least 0");
    }
}

// The clusters of one block of max_side x max_side pixels.
class BlockSearch {
  public:
    void set(const KernelRoughness& roughness, const ClusterOptions& options) {
        roughness_ = roughness;
        options_ = options;
    }

    void load(const ConstImageView& light, const float* weights, int x0, int y0) {
        x0_ = x0;
        y0_ = y0;
        block_.channels = light.channels;
        for (int y = 0; y < options_.max_side; ++y) load_row(light, weights, y);
    }

    void search(Clusters& found) { search({0, 0, options_.max_side}, found); }

  private:
    void load_row(const ConstImageView& light, const float* weights, int y) {
        std::uint64_t& bright = block_.bright[static_cast<std::size_t>(y)];
        bright = 0;
        if (y0_ + y >= light.height) return;
        ConstImageView part = light;
        part.data += light.offset(x0_, 0, 0);
        part.width = std::min(options_.max_side, light.width - x0_);
        std::array<float, kMaxClusterSide> largest;
        largest_channel_row(part, y0_ + y, largest.data());
        if (!any_above(largest.data(), part.width, options_.dim_limit)) return;
        const float* row = weights == nullptr ? nullptr
                                              : weights +
                                                    static_cast<std::size_t>(y0_ + y) *
                                                        static_cast<std::size_t>(light.width) +
                                                    x0_;
        for (int x = 0; x < part.width; ++x) {
            if (!(largest[static_cast<std::size_t>(x)] > options_.dim_limit)) continue;
            bright |= std::uint64_t{1} << static_cast<unsigned>(x);
            const float weight = bright_share(largest[static_cast<std::size_t>(x)],
                                              options_.dim_limit, options_.full_limit) *
                                 (row == nullptr ? 1.0F : row[x]);
            for (int c = 0; c < light.channels; ++c) {
                block_.energy[static_cast<std::size_t>(c)][BlockEnergies::index(x, y)] =
                    light.at(x0_ + x, y0_ + y, c) * weight;
            }
        }
    }

    void search(const Cell& cell, Clusters& found) {
        const CellSums sums = sum_cell(block_, cell);
        if (sums.bright_pixels == 0) return;
        const bool try_cell =
            sums.bright_pixels > 1 && (options_.tree || cell.side == options_.max_side);
        if (sums.bright_pixels == 1 && (cell.side == 1 || bounded())) {
            emit(cell, sums, Cluster::Shape::kPoint, 0, found);
        } else if (!try_cell || !emit_cell(cell, sums, found)) {
            const int half = cell.side / 2;
            for (const auto& [dx, dy] : {std::pair{0, 0}, {half, 0}, {0, half}, {half, half}}) {
                search({cell.x + dx, cell.y + dy, half}, found);
            }
        }
    }

    bool bounded() const { return options_.criterion == ClusterOptions::Criterion::kBoundedError; }

    // Emits the whole cell as one cluster, if it may be one.
    bool emit_cell(const Cell& cell, const CellSums& sums, Clusters& found) const {
        if (!bounded()) {
            if (sums.bright_pixels < cell.side * cell.side ||
                color_spread(block_, cell, sums) > options_.color_spread) {
                return false;
            }
            emit(cell, sums, Cluster::Shape::kCell, 0, found);
            return true;
        }
        const double most = options_.error * sums.amount;
        const double as_cell = options_.cells ? cell_bound(block_, cell, sums, roughness_)
                                              : std::numeric_limits<double>::infinity();
        const double as_point = point_bound(block_, cell, sums, roughness_);
        if (std::min(as_cell, as_point) > most) return false;
        if (as_cell < as_point) {
            emit(cell, sums, Cluster::Shape::kCell, as_cell, found);
        } else {
            emit(cell, sums, Cluster::Shape::kPoint, as_point, found);
        }
        return true;
    }

    void emit(const Cell& cell, const CellSums& sums, Cluster::Shape shape, double bound,
              Clusters& found) const {
        Cluster cluster;
        cluster.shape = shape;
        cluster.x = x0_ + cell.x;
        cluster.y = y0_ + cell.y;
        cluster.side = cell.side;
        const bool point = shape == Cluster::Shape::kPoint;
        cluster.centroid_x = point ? x0_ + sums.x : cluster.x + 0.5 * cell.side;
        cluster.centroid_y = point ? y0_ + sums.y : cluster.y + 0.5 * cell.side;
        for (std::size_t c = 0; c < 3; ++c) {
            cluster.energy[c] = static_cast<float>(sums.energy[c]);
        }
        cluster.error_bound = bound;
        found.clusters.push_back(cluster);
        found.bright_pixels += static_cast<std::size_t>(sums.bright_pixels);
        found.energy += sums.amount;
        found.error_bound += bound;
    }

    KernelRoughness roughness_;
    ClusterOptions options_;
    BlockEnergies block_;
    int x0_ = 0;
    int y0_ = 0;
};

// Memory of one thread.
struct Scratch {
    BlockSearch search;
    std::vector<char> bright;    // blocks of a strip
    std::vector<float> largest;  // channel of each pixel of a row
};

// Which blocks of the strip of max_side rows from y0 on have bright pixels: most have none.
void find_bright_blocks(const ConstImageView& light, int y0, const ClusterOptions& options,
                        Scratch& scratch) {
    const int side = options.max_side;
    scratch.largest.resize(static_cast<std::size_t>(light.width));
    float* const largest = scratch.largest.data();
    for (int y = y0; y < std::min(light.height, y0 + side); ++y) {
        largest_channel_row(light, y, largest);
        if (!any_above(largest, light.width, options.dim_limit)) continue;
        for (std::size_t block = 0; block < scratch.bright.size(); ++block) {
            const int x = static_cast<int>(block) * side;
            if (any_above(largest + x, std::min(side, light.width - x), options.dim_limit)) {
                scratch.bright[block] = 1;
            }
        }
    }
}

void find_bright_blocks(const BrightnessHistogram& measured, int y0, const ClusterOptions& options,
                        Scratch& scratch) {
    const int side = options.max_side;
    for (std::size_t block = 0; block < scratch.bright.size(); ++block) {
        const int x0 = static_cast<int>(block) * side;
        if (measured.may_be_above(options.dim_limit, x0, y0, x0 + side, y0 + side)) {
            scratch.bright[block] = 1;
        }
    }
}

void clear(Clusters& clusters) {
    std::vector<Cluster> kept = std::move(clusters.clusters);
    kept.clear();
    clusters = {};
    clusters.clusters = std::move(kept);
}

// Sum of |light| * weight over the channels of rows [first, end).
double strip_energy(const ConstImageView& light, const float* weights, int first, int end) {
    std::array<double, 4> sums = {};  // independent, so that additions overlap
    for (int y = first; y < end; ++y) {
        const float* row = weights == nullptr ? nullptr
                                              : weights + static_cast<std::size_t>(y) *
                                                              static_cast<std::size_t>(light.width);
        for (int c = 0; c < light.channels; ++c) {
            const float* values = light.data + light.offset(0, y, c);
            for (int x = 0; x < light.width; ++x) {
                const double value = std::abs(static_cast<double>(values[x * light.pixel_stride]));
                sums[static_cast<std::size_t>(x) % 4] +=
                    row == nullptr ? value : value * static_cast<double>(row[x]);
            }
        }
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

struct ClusterFinder::Impl {
    std::vector<Scratch> scratch{static_cast<std::size_t>(max_workers())};
    std::vector<Clusters> strips;
    Clusters all;
};

ClusterFinder::ClusterFinder() : impl_(std::make_unique<Impl>()) {}
ClusterFinder::~ClusterFinder() = default;
ClusterFinder::ClusterFinder(ClusterFinder&&) noexcept = default;
ClusterFinder& ClusterFinder::operator=(ClusterFinder&&) noexcept = default;

const Clusters& ClusterFinder::find(const ConstImageView& light, const float* weights,
                                    const KernelRoughness& roughness, const ClusterOptions& options,
                                    const BrightnessHistogram* measured) {
    check(light, options);
    const int side = options.max_side;
    const int columns = (light.width + side - 1) / side;
    const int rows = (light.height + side - 1) / side;
    for (Scratch& scratch : impl_->scratch) scratch.search.set(roughness, options);
    std::vector<Clusters>& strips = impl_->strips;
    strips.resize(static_cast<std::size_t>(rows));
    parallel_for(strips.size(), [&](std::size_t row, int worker) {
        Scratch& scratch = impl_->scratch[static_cast<std::size_t>(worker)];
        Clusters& found = strips[row];
        clear(found);
        const int y0 = static_cast<int>(row) * side;
        scratch.bright.assign(static_cast<std::size_t>(columns), 0);
        if (measured == nullptr) {
            find_bright_blocks(light, y0, options, scratch);
        } else {
            find_bright_blocks(*measured, y0, options, scratch);
        }
        for (int column = 0; column < columns; ++column) {
            if (scratch.bright[static_cast<std::size_t>(column)] == 0) continue;
            scratch.search.load(light, weights, column * side, y0);
            scratch.search.search(found);
        }
        if (measured != nullptr) return;
        found.energy_left =
            strip_energy(light, weights, y0, std::min(light.height, y0 + side)) - found.energy;
    });
    Clusters& all = impl_->all;
    clear(all);
    for (const Clusters& strip : strips) {
        all.clusters.insert(all.clusters.end(), strip.clusters.begin(), strip.clusters.end());
        all.bright_pixels += strip.bright_pixels;
        all.energy += strip.energy;
        all.energy_left += strip.energy_left;
        all.error_bound += strip.error_bound;
    }
    if (measured != nullptr) all.energy_left = std::max(0.0, measured->energy() - all.energy);
    return all;
}

Clusters find_clusters(const ConstImageView& light, const float* weights,
                       const KernelRoughness& roughness, const ClusterOptions& options,
                       const BrightnessHistogram* measured) {
    return ClusterFinder().find(light, weights, roughness, options, measured);
}

}  // namespace aureole::sources
