// An environment as a quad-tree on each face whose nodes know where their light comes from and how
// far it is spread: what a kernel needs to treat a node as a whole, to second order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/color/rgb.h"
#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

// Four nodes side by side: (0, 0), (1, 0), (0, 1), (1, 1) of a square. They are the children of one
// node of the level above. Nodes beyond the edge of a face cover no solid angle.
//
// c = (x, y, z) is the mean of the unit vectors of a node's light, weighted by the absolute value
// of its luminance, and not normalised; moment = mean |L - c|^2 = 1 - |c|^2.
struct alignas(64) RadianceBlock {
    float x[4];
    float y[4];
    float z[4];
    float moment[4];
    float r[4];  // radiance x solid angle, summed
    float g[4];
    float b[4];
    float solid_angle_sr[4];
};
static_assert(sizeof(RadianceBlock) == 128);

// Luminance of linear sRGB, in single precision.
inline constexpr std::array<float, 3> kLuminanceWeights = {
    static_cast<float>(color::kLuminanceWeights[0]),
    static_cast<float>(color::kLuminanceWeights[1]),
    static_cast<float>(color::kLuminanceWeights[2])};

// The blocks of one level: per_side x per_side on each face, row by row, face by face.
struct RadianceLevel {
    RadianceBlock* blocks = nullptr;
    // Four per block: how far from c its colours are. With E the radiance x solid angle of a part
    // of the node, a bound of the largest over the channels of |sum E (L - c)|, each as a share of
    // all that channel's light. None in level 0, as a texel has all of its colours in one place.
    float* dipoles = nullptr;
    int nodes_per_side = 0;
    int per_side = 0;

    RadianceBlock* row(int face, int y) const { return blocks + blocks_before(face, y); }
    float* dipole_row(int face, int y) const { return dipoles + 4 * blocks_before(face, y); }

    std::size_t blocks_before(int face, int y) const {
        return static_cast<std::size_t>(face * per_side + y) * static_cast<std::size_t>(per_side);
    }
};

// Sums of the absolute values of r, g and b.
using RowLight = std::array<float, 3>;

class RadianceTree {
  public:
    // For environments of `size` texels per side. Small ones are divided into smaller texels, so
    // that every texel is small compared with the sphere.
    explicit RadianceTree(int size);

    // Fills all nodes. `environment` is finite and of that size. Runs parallel loops.
    void build(const CubeMap& environment) noexcept;

    // Level 0 has the texels; the last one at most 4 x 4 nodes per face.
    const std::vector<RadianceLevel>& levels() const noexcept { return levels_; }
    // Mean over the sphere of the absolute value of each texel's luminance.
    double mean_luminance() const noexcept { return mean_luminance_; }

  private:
    int subdivision_ = 1;
    std::vector<std::vector<RadianceBlock, AlignedAllocator<RadianceBlock>>> storage_;
    std::vector<std::vector<float>> dipoles_;
    std::vector<RadianceLevel> levels_;
    std::vector<RowLight> rows_;  // of blocks of level 0
    double mean_luminance_ = 0;
};

}  // namespace aureole::ibl
