#include "sources/cluster_cell.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace aureole::sources {
namespace {

template <class Body>
void for_each_bright_pixel(const BlockEnergies& block, const Cell& cell, const Body& body) {
    const std::uint64_t all = ~std::uint64_t{0} >> (BlockEnergies::kSide - cell.side) << cell.x;
    for (int y = cell.y; y < cell.y + cell.side; ++y) {
        std::uint64_t row = block.bright[static_cast<std::size_t>(y)] & all;
        for (; row != 0; row &= row - 1) {
            const int x = std::countr_zero(row);
            body(x, y, BlockEnergies::index(x, y));
        }
    }
}

double mean_energy(double energy, const Cell& cell) {
    return energy / (static_cast<double>(cell.side) * cell.side);
}

// Kinks of a piecewise linear function between its value at c and at the grid point s, each
// weighted by its distance from s: 1 + 2 + ... + m with m of them, m <= |s - c|.
double kinks(double distance) {
    const double m = std::floor(distance);
    return 0.5 * m * (m + 1);
}

// Sums over the pixels of one channel, d being the distance from the centroid.
struct Spread {
    double x = 0;  // |e| |dx|
    double y = 0;
    double xx = 0;  // |e| kinks(|dx|)
    double yy = 0;
    double xy = 0;        // |e| |dx| |dy|
    double moment_x = 0;  // e dx
    double moment_y = 0;
};

}  // namespace

CellSums sum_cell(const BlockEnergies& block, const Cell& cell) {
    CellSums sums;
    for_each_bright_pixel(block, cell, [&](int x, int y, std::size_t i) {
        ++sums.bright_pixels;
        double amount = 0;
        for (std::size_t c = 0; c < static_cast<std::size_t>(block.channels); ++c) {
            const double e = static_cast<double>(block.energy[c][i]);
            sums.energy[c] += e;
            amount += std::abs(e);
        }
        sums.amount += amount;
        sums.x += amount * (x + 0.5);
        sums.y += amount * (y + 0.5);
    });
    if (sums.amount > 0) {
        sums.x /= sums.amount;
        sums.y /= sums.amount;
    }
    return sums;
}

double cell_bound(const BlockEnergies& block, const Cell& cell, const CellSums& sums,
                  const KernelRoughness& roughness) {
    double difference = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(block.channels); ++c) {
        const double mean = mean_energy(sums.energy[c], cell);
        for_each_bright_pixel(block, cell, [&](int, int, std::size_t i) {
            difference += std::abs(static_cast<double>(block.energy[c][i]) - mean);
        });
        const int dark = cell.side * cell.side - sums.bright_pixels;
        difference += dark * std::abs(mean);
    }
    return roughness.sum * difference;
}

double point_bound(const BlockEnergies& block, const Cell& cell, const CellSums& sums,
                   const KernelRoughness& roughness) {
    double first = 0;
    double second = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(block.channels); ++c) {
        Spread spread;
        for_each_bright_pixel(block, cell, [&](int x, int y, std::size_t i) {
            const double e = static_cast<double>(block.energy[c][i]);
            const double amount = std::abs(e);
            const double dx = x + 0.5 - sums.x;
            const double dy = y + 0.5 - sums.y;
            spread.x += amount * std::abs(dx);
            spread.y += amount * std::abs(dy);
            spread.xx += amount * kinks(std::abs(dx));
            spread.yy += amount * kinks(std::abs(dy));
            spread.xy += amount * std::abs(dx * dy);
            spread.moment_x += e * dx;
            spread.moment_y += e * dy;
        });
        first += roughness.variation_x * spread.x + roughness.variation_y * spread.y;
        second += roughness.variation_x * std::abs(spread.moment_x) +
                  roughness.variation_y * std::abs(spread.moment_y) +
                  roughness.curvature_xx * spread.xx + roughness.curvature_yy * spread.yy +
                  roughness.curvature_xy * spread.xy;
    }
    return std::min(first, second);
}

double color_spread(const BlockEnergies& block, const Cell& cell, const CellSums& sums) {
    double mean_of_all = 0;
    double largest = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(block.channels); ++c) {
        const double mean = mean_energy(sums.energy[c], cell);
        mean_of_all += std::abs(mean) / block.channels;
        for_each_bright_pixel(block, cell, [&](int, int, std::size_t i) {
            largest = std::max(largest, std::abs(static_cast<double>(block.energy[c][i]) - mean));
        });
    }
    return mean_of_all > 0 ? largest / mean_of_all : std::numeric_limits<double>::infinity();
}

}  // namespace aureole::sources
