// Looking up a chain of cube maps in any direction, as a GPU does with seamless filtering: linear
// in both directions of a face, across its edges, and between levels.
#pragma once

#include <array>
#include <memory>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

class CubeSampler {
  public:
    // Keeps a copy of its own, with borders of one texel from the neighbouring faces; at a corner,
    // where only three texels meet, the mean of these three stands for the fourth.
    // Throws InvalidArgument for an empty chain or an empty level.
    explicit CubeSampler(const CubeChain& chain);
    ~CubeSampler();
    CubeSampler(CubeSampler&&) noexcept;
    CubeSampler& operator=(CubeSampler&&) noexcept;

    int levels() const noexcept;
    // R, G, B in `direction` (any length but 0) at a level that is clamped to [0, levels() - 1].
    // From any number of threads.
    std::array<float, 3> sample(const Direction& direction, double level) const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::ibl
