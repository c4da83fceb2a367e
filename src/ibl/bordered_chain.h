// Chains of cube maps laid out for looking up: RGB0 side by side, so that one load fetches a texel,
// and each face with a border of one texel from its neighbours, so that no lookup asks on which
// face a neighbouring texel lies.
//
// The borders are those of seamless filtering (OpenGL 4.6 specification, section 8.13.1): a border
// texel is the texel on the other side of the edge; at a corner, where only three texels meet, it
// is their mean. A linear lookup is then continuous over the whole sphere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

inline constexpr int kTexelFloats = 4;

// Where a level's texels are. x and y in [-1, size].
struct BorderedLevel {
    int size = 0;
    std::uint32_t first = 0;
    std::uint32_t stride = 0;       // from row to row
    std::uint32_t face_stride = 0;  // from face to face

    std::uint32_t texel(int face, int x, int y) const {
        return first + static_cast<std::uint32_t>(face) * face_stride +
               static_cast<std::uint32_t>(y + 1) * stride + static_cast<std::uint32_t>(x + 1);
    }
};

class BorderedChain {
  public:
    BorderedChain() = default;
    // One level of each of these sizes; contents undefined until filled.
    explicit BorderedChain(const std::vector<int>& sizes);

    const std::vector<BorderedLevel>& levels() const noexcept { return levels_; }
    // kTexelFloats for each texel, the last one 0.
    float* texels() noexcept { return texels_.data(); }
    const float* texels() const noexcept { return texels_.data(); }

    // A copy of `map`, which is of the level's size, with its border. Allocates nothing; runs a
    // parallel loop.
    void fill(std::size_t level, const CubeMap& map) noexcept;
    // The border of a level whose faces are complete.
    void fill_border(std::size_t level) noexcept;

  private:
    // Texel `to` is the mean of 1 or 3 others.
    struct Copy {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
    };
    struct Corner {
        std::uint32_t from[3] = {};
        std::uint32_t to = 0;
    };
    struct Border {
        std::vector<Copy> edges;
        std::vector<Corner> corners;  // made of faces and edges
    };

    std::vector<BorderedLevel> levels_;
    std::vector<Border> borders_;
    Buffer texels_;
};

// An environment and its means over 2 x 2, 4 x 4, ... texels, each weighted by its solid angle, for
// filtered importance sampling. Where a size is odd neighbours share the texel between them.
class EnvironmentMips {
  public:
    EnvironmentMips() = default;
    // `levels` of the full chain of environments of `size`, at most most_levels(size).
    EnvironmentMips(int size, int levels);

    const BorderedChain& chain() const noexcept { return chain_; }
    // Allocates nothing; runs parallel loops.
    void fill(const CubeMap& environment) noexcept;

  private:
    // What one column (or row) of a level takes from those of the level above it.
    struct Cover {
        int first = 0;
        int count = 0;
        float share[3] = {};
    };

    void halve(std::size_t above) noexcept;

    BorderedChain chain_;
    std::vector<std::vector<Cover>> covers_;        // of each level below the first
    std::vector<std::vector<float>> solid_angles_;  // of each level above the last, row by row
};

}  // namespace aureole::ibl
