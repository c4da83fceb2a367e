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

// Node `node` of `parent` from its four children. Returns their dipole about its mean direction;
// those that they have themselves add to it.
float join(const RadianceBlock& children, const RowLight& scales, RadianceBlock& parent, int node) {
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
    float dx[4];
    float dy[4];
    float dz[4];
    float spread[4];
    for (int i = 0; i < 4; ++i) {
        dx[i] = children.x[i] - x;
        dy[i] = children.y[i] - y;
        dz[i] = children.z[i] - z;
        spread[i] = children.moment[i] + (dx[i] * dx[i] + (dy[i] * dy[i] + dz[i] * dz[i]));
    }
    const auto dipole2 = [&](const float(&light)[4], float scale) {
        const float along_x = scale * sum4(dx, light);
        const float along_y = scale * sum4(dy, light);
        const float along_z = scale * sum4(dz, light);
        return along_x * along_x + (along_y * along_y + along_z * along_z);
    };
    parent.x[node] = x;
    parent.y[node] = y;
    parent.z[node] = z;
    parent.moment[node] = sum4(spread, weight);
    parent.r[node] = sum4(children.r);
    parent.g[node] = sum4(children.g);
    parent.b[node] = sum4(children.b);
    parent.solid_angle_sr[node] = sum4(children.solid_angle_sr);
    return std::sqrt(std::max({dipole2(children.r, scales[0]), dipole2(children.g, scales[1]),
                               dipole2(children.b, scales[2])}));
}

void join_row(const RadianceLevel& children, const RadianceLevel& parents, const RowLight& scales,
              int face, int y) {
    RadianceBlock* out = parents.row(face, y);
    float* dipoles = parents.dipole_row(face, y);
    for (int half = 0; half < 2 && 2 * y + half < parents.nodes_per_side; ++half) {
        const RadianceBlock* in = children.row(face, 2 * y + half);
        const float* theirs =
            children.dipoles == nullptr ? nullptr : children.dipole_row(face, 2 * y + half);
        for (int x = 0; x < parents.nodes_per_side; ++x) {
            const int node = 2 * half + x % 2;
            float dipole = join(in[x], scales, out[x / 2], node);
            if (theirs != nullptr) {
                const float* of_four = theirs + 4 * x;
                dipole += (of_four[0] + of_four[1]) + (of_four[2] + of_four[3]);
            }
            dipoles[4 * (x / 2) + node] = dipole;
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
        dipoles_.emplace_back(levels_.empty() ? 0 : 4 * count);
        levels_.push_back({storage_.back().data(),
                           levels_.empty() ? nullptr : dipoles_.back().data(), nodes, per_side});
        if (nodes <= kMostRoots) break;
    }
    rows_.resize(static_cast<std::size_t>(kFaces * levels_.front().per_side));
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
        rows_[static_cast<std::size_t>(face * texels.per_side + y)] = make_leaves(
            environment, subdivision_, face, y, texels.nodes_per_side, texels.row(face, y));
    });
    const RowLight scales = channel_scales(rows_);
    for (std::size_t k = 1; k < levels_.size(); ++k) {
        run(levels_[k],
            [&](int face, int y) { join_row(levels_[k - 1], levels_[k], scales, face, y); });
    }
    double total = 0;
    for (const RadianceBlock& block : storage_.back()) {
        for (int i = 0; i < 4; ++i) total += luminance(block, i);
    }
    mean_luminance_ = total / (4 * kPi);
}

}  // namespace aureole::ibl
