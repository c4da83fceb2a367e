#include "lens/sparse_throughput.h"

#include <algorithm>

namespace aureole::lens {
namespace {

// Throughput where no ray arrives, continued from the two nodes beyond: it falls towards total
// reflection.
void continue_throughput(float* values, int columns, int rows, int stride) {
    constexpr int kRounds = 2;  // cubics reach so far
    for (int round = 0; round < kRounds; ++round) {
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                float* at = values + j * stride + i;
                if (*at > 0) continue;
                float sum = 0;
                int count = 0;
                const auto take = [&](bool exists, int step) {
                    if (!exists || !(at[step] > 0) || !(at[2 * step] > 0)) return;
                    sum += std::max(0.0F, 2 * at[step] - at[2 * step]);
                    ++count;
                };
                take(i + 2 < columns, 1);
                take(i >= 2, -1);
                take(j + 2 < rows, stride);
                take(j >= 2, -stride);
                if (count > 0) *at = sum / static_cast<float>(count);
            }
        }
    }
}

}  // namespace

SparseThroughput::Place::Place(double index, int nodes) {
    const double at = std::clamp(index / kEvery, 0.0, static_cast<double>(nodes - 1));
    const int first = std::min(static_cast<int>(at), nodes - 2);
    const auto t = static_cast<float>(at - first);
    const float t2 = t * t;
    const float t3 = t2 * t;
    weight[0] = 0.5F * (2 * t2 - t - t3);
    weight[1] = 0.5F * (3 * t3 - 5 * t2 + 2);
    weight[2] = 0.5F * (4 * t2 + t - 3 * t3);
    weight[3] = 0.5F * (t3 - t2);
    for (int k = 0; k < 4; ++k) node[k] = std::clamp(first + k - 1, 0, nodes - 1);
}

SparseThroughput::SparseThroughput(int side)
    : nodes_(nodes(side)),
      values_(static_cast<std::size_t>(ray_stride(nodes_) * nodes_)),
      row_(static_cast<std::size_t>(nodes_)),
      places_(static_cast<std::size_t>(side)) {
    std::fill(values_.data(), values_.data() + values_.size(), 0.0F);
}

std::size_t SparseThroughput::trace(std::span<const RayStep> way, const RayBundle& grid) noexcept {
    nodes_ = nodes(grid.columns);
    RayBundle sparse = grid;
    sparse.columns = sparse.rows = nodes_;
    sparse.step_x_mm *= kEvery;
    sparse.step_y_mm *= kEvery;
    ray_kernels().throughput(way, sparse, values_.data());
    continue_throughput(values_.data(), nodes_, nodes_, ray_stride(nodes_));
    return static_cast<std::size_t>(nodes_) * static_cast<std::size_t>(nodes_);
}

void SparseThroughput::interpolate(double i, double j, double step, float scale,
                                   Mesh& mesh) noexcept {
    const int stride = ray_stride(nodes_);
    for (int column = 0; column < mesh.columns; ++column) {
        places_[static_cast<std::size_t>(column)] = Place(i + column * step, nodes_);
    }
    for (int row = 0; row < mesh.rows; ++row) {
        const Place across(j + row * step, nodes_);
        for (int k = 0; k < nodes_; ++k) {
            float sum = 0;
            for (int n = 0; n < 4; ++n)
                sum += across.weight[n] * values_.data()[across.node[n] * stride + k];
            row_[static_cast<std::size_t>(k)] = scale * sum;
        }
        float* to = mesh.power + row * mesh.stride;
        for (int column = 0; column < mesh.columns; ++column) {
            const Place& along = places_[static_cast<std::size_t>(column)];
            float sum = 0;
            for (int n = 0; n < 4; ++n)
                sum += along.weight[n] * row_[static_cast<std::size_t>(along.node[n])];
            to[column] = std::max(0.0F, sum);
        }
    }
}

}  // namespace aureole::lens
