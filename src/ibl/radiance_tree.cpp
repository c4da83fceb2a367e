#include "ibl/radiance_tree.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "ibl/radiance_kernels.h"

namespace aureole::ibl {
namespace {

constexpr int kFewestNodes = 64;  // per side, in level 0
constexpr int kMostRoots = 4;     // nodes per side, in the last level

float luminance(const RadianceBlock& block, int node) {
    return std::abs(kLuminanceWeights[0] * block.r[node] + kLuminanceWeights[1] * block.g[node] +
                    kLuminanceWeights[2] * block.b[node]);
}

// What makes the channels of a dipole comparable: one over all light of each. A channel that has
// next to none cannot be seen beside the others, and counts as if it had more.
RowLight channel_scales(const std::vector<RowLight>& rows) {
    constexpr double kLeast = 1.0 / 16;  // of luminance
    std::array<double, 3> light = {};
    for (const RowLight& row : rows) {
        for (std::size_t c = 0; c < 3; ++c) light[c] += row[c];
    }
    double luminance = 0;
    for (std::size_t c = 0; c < 3; ++c) luminance += kLuminanceWeights[c] * light[c];
    RowLight scales = {};
    for (std::size_t c = 0; c < 3 && luminance > 0; ++c) {
        scales[c] = static_cast<float>(1 / std::max(light[c], kLeast * luminance));
    }
    return scales;
}

}  // namespace

RadianceTree::RadianceTree(int size) : subdivision_((kFewestNodes + size - 1) / size) {
    for (int nodes = size * subdivision_;; nodes = (nodes + 1) / 2) {
        const int per_side = (nodes + 1) / 2;
        const auto count =
            static_cast<std::size_t>(kFaces * per_side) * static_cast<std::size_t>(per_side);
        storage_.emplace_back(count);
        dipoles_.emplace_back(levels_.empty() ? 0 : 4 * count);
        levels_.push_back({storage_.back().data(),
                           levels_.empty() ? nullptr : dipoles_.back().data(), nodes, per_side});
        if (nodes <= kMostRoots) break;
    }
    rows_.resize(static_cast<std::size_t>(kFaces * levels_.front().per_side));
}

void RadianceTree::build(const CubeMap& environment) noexcept {
    const RadianceLevel& texels = levels_.front();
    const RadianceKernels& kernels = radiance_kernels();
    const auto run = [](const RadianceLevel& level, const auto& body) {
        const auto side = static_cast<std::size_t>(level.per_side);
        parallel_for(kFaces * side, [&](std::size_t i, int) {
            body(static_cast<int>(i / side), static_cast<int>(i % side));
        });
    };
    run(texels, [&](int face, int y) {
        rows_[static_cast<std::size_t>(face * texels.per_side + y)] = kernels.make_leaves(
            environment, subdivision_, face, y, texels.nodes_per_side, texels.row(face, y));
    });
    const RowLight scales = channel_scales(rows_);
    for (std::size_t k = 1; k < levels_.size(); ++k) {
        run(levels_[k], [&](int face, int y) {
            kernels.join_row(levels_[k - 1], levels_[k], scales, face, y);
        });
    }
    double total = 0;
    for (const RadianceBlock& block : storage_.back()) {
        for (int i = 0; i < 4; ++i) total += luminance(block, i);
    }
    mean_luminance_ = total / (4 * kPi);
}

}  // namespace aureole::ibl
