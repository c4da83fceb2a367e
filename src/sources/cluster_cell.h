// The light of one square cell, and how far a single sprite is from it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "aureole/sources/clusters.h"

namespace aureole::sources {

// The energies of a block of up to kMaxClusterSide x kMaxClusterSide pixels: light times weight
// where it is bright; elsewhere they are not read.
struct BlockEnergies {
    static constexpr int kSide = kMaxClusterSide;
    int channels = 3;
    std::array<std::array<float, kSide * kSide>, 3> energy = {};
    std::array<std::uint64_t, kSide> bright = {};  // per row, bit x for column x
    static_assert(kSide == 64);

    static constexpr std::size_t index(int x, int y) {
        return static_cast<std::size_t>(y * kSide + x);
    }
};

// A square part of a block.
struct Cell {
    int x = 0;
    int y = 0;
    int side = 1;
};

struct CellSums {
    int bright_pixels = 0;
    std::array<double, 3> energy = {};
    double amount = 0;  // sum of |e| over pixels and channels
    double x = 0;       // centroid by |e|: continuous pixel coordinates within the block
    double y = 0;
};

CellSums sum_cell(const BlockEnergies& block, const Cell& cell);

// Bounds of clusters.h, in energy.
double cell_bound(const BlockEnergies& block, const Cell& cell, const CellSums& sums,
                  const KernelRoughness& roughness);
double point_bound(const BlockEnergies& block, const Cell& cell, const CellSums& sums,
                   const KernelRoughness& roughness);

// The largest |e - mean| over the mean of all channels: the paper's "colours do not vary greatly".
double color_spread(const BlockEnergies& block, const Cell& cell, const CellSums& sums);

}  // namespace aureole::sources
