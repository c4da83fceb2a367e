// The SIMD part of LineFft and Fft2d: one batch of lines, compiled per instruction set.
#pragma once

#include <cstddef>

#include "fourier/line_plan.h"

namespace aureole::fourier {

struct FftKernels {
    int lanes;  // lines per batch

    // Transforms columns [x, x + count), count <= lanes, of row-major planes with plan.length rows.
    // Natural order in and out. `scratch`: 2 * lanes * plan.length floats, 64-byte aligned.
    void (*columns)(const LinePlan& plan, bool inverse, float* re, float* im,
                    std::ptrdiff_t row_stride, std::ptrdiff_t x, int count, float scale,
                    float* scratch);
    // Transforms `count` <= lanes rows of plan.length samples each, starting at re and im.
    // Samples outside [first, end) are known to be 0 (forward only).
    void (*rows)(const LinePlan& plan, bool inverse, float* re, float* im,
                 std::ptrdiff_t row_stride, int count, int first, int end, float scale,
                 float* scratch);
};

// Those of the best instruction set of this machine.
FftKernels fft_kernels();

}  // namespace aureole::fourier
