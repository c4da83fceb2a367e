// The SIMD part of Canvas, compiled per instruction set.
#pragma once

#include "aureole/image/image.h"
#include "lens/canvas.h"

namespace aureole::lens {

struct CanvasKernels {
    // Adds pixels of `coarse` to all rows and planes of the next finer level's row `y`, which marks
    // what becomes used.
    void (*refine_row)(const CanvasLevel& coarse, const CanvasLevel& fine, int y);
    // Adds row `y` of the finest level and what the next one (or null) holds there to the picture.
    void (*add_row)(const CanvasLevel& fine, const CanvasLevel* coarse, const ImageView& out,
                    int y);
};

CanvasKernels canvas_kernels();

}  // namespace aureole::lens
