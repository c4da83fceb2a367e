// Memory for batches of lines: one area per worker, allocated once.
#pragma once

#include <cstddef>

#include "aureole/base/buffer.h"
#include "aureole/base/parallel.h"

namespace aureole::fourier {

class Scratch {
  public:
    explicit Scratch(std::size_t floats)
        : stride_((floats + 15) / 16 * 16),
          memory_(stride_ * static_cast<std::size_t>(max_workers())) {}
    float* of(int worker) noexcept {
        return memory_.data() + stride_ * static_cast<std::size_t>(worker);
    }

  private:
    std::size_t stride_;
    Buffer memory_;
};

}  // namespace aureole::fourier
