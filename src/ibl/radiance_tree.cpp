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

float sum4(const float (&v)[4]) { return (v[0] + v[1]) + (v[2] + v[3]); }
float sum4(const float (&v)[4], const float (&weights)[4]) {
    return (v[0] * weights[0] + v[1] * weights[1]) + (v[2] * weights[2] + v[3] * weights[3]);
}

// Node `node` of `parent` from its four children.
void join(const RadianceBlock& children, RadianceBlock& parent, int node) {
    // Black nodes need a mean direction, too.
    constexpr float kBlack = 1e-24F;
    float weight[4];
    for (int i = 0; i < 4; ++i) {
        weight[i] = luminance(children, i) + kBlack * children.solid_angle_sr[i];
    }
    const float scale = 1 / sum4(weight);
    for (float& w : weight) w *= scale;
    const float x = sum4(children.x, weight);
    const float y = sum4(children.y, weight);
    const float z = sum4(children.z, weight);
    float spread[4];
    for (int i = 0; i < 4; ++i) {
        const float dx = children.x[i] - x;
        const float dy = children.y[i] - y;
        const float dz = children.z[i] - z;
        spread[i] = children.moment[i] + (dx * dx + (dy * dy + dz * dz));
    }
    parent.x[node] = x;
    parent.y[node] = y;
    parent.z[node] = z;
    parent.moment[node] = sum4(spread, weight);
    parent.r[node] = sum4(children.r);
    parent.g[node] = sum4(children.g);
    parent.b[node] = sum4(children.b);
    parent.solid_angle_sr[node] = sum4(children.solid_angle_sr);
}

void join_row(const RadianceLevel& children, const RadianceLevel& parents, int face, int y) {
    RadianceBlock* out = parents.row(face, y);
    for (int half = 0; half < 2 && 2 * y + half < parents.nodes_per_side; ++half) {
        const RadianceBlock* in = children.row(face, 2 * y + half);
        for (int x = 0; x < parents.nodes_per_side; ++x) {
            join(in[x], out[x / 2], 2 * half + x % 2);
        }
    }
}

}  // namespace

RadianceTree::RadianceTree(int size) : subdivision_((kFewestNodes + size - 1) / size) {
    for (int nodes = size * subdivision_;; nodes = (nodes + 1) / 2) {
        const int per_side = (nodes + 1) / 2;
        const auto count =
            static_cast<std::size_t>(kFaces * per_side) * static_cast<std::size_t>(per_side);
        storage_.emplace_back(count);
        levels_.push_back({storage_.back().data(), nodes, per_side});
        if (nodes <= kMostRoots) break;
    }
}

void RadianceTree::build(const CubeMap& environment) noexcept {
    const RadianceLevel& texels = levels_.front();
    const auto make_leaves = radiance_kernels().make_leaves;
    const auto run = [](const RadianceLevel& level, const auto& body) {
        const auto side = static_cast<std::size_t>(level.per_side);
        parallel_for(kFaces * side, [&](std::size_t i, int) {
            body(static_cast<int>(i / side), static_cast<int>(i % side));
        });
    };
    run(texels, [&](int face, int y) {
        make_leaves(environment, subdivision_, face, y, texels.nodes_per_side, texels.row(face, y));
    });
    for (std::size_t k = 1; k < levels_.size(); ++k) {
        run(levels_[k], [&](int face, int y) { join_row(levels_[k - 1], levels_[k], face, y); });
    }
    double total = 0;
    for (const RadianceBlock& block : storage_.back()) {
        for (int i = 0; i < 4; ++i) total += luminance(block, i);
    }
    mean_luminance_ = total / (4 * kPi);
}

}  // namespace aureole::ibl
