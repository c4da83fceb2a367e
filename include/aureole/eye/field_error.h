// How well streaks blended over the field follow those computed for each position.
#pragma once

#include <functional>

#include "aureole/eye/field_psf.h"
#include "aureole/image/image.h"

namespace aureole::eye {

struct FieldError {
    int positions = 0;
    double l1 = 0;     // sum over positions of |blend - truth|, over the truth's energy
    double mean = 0;   // mean over the positions of each one's own ratio, where there are streaks
    double worst = 0;  // largest of these
};

// At `positions` pixels drawn at random over the picture. The truth is streaks_at() without end,
// so that what the blend cuts off counts too. .2 s each at the default raster.
// Throws InvalidArgument for positions outside 1 to 10000.
FieldError field_error(const Eye& eye, const wave::VaryingPsf& psf, const EyePsfOptions& options,
                       int positions);

// The same for anything else that gives half a kernel (kernel_nodes.h) for pixel (x, y).
FieldError field_error(const Eye& eye, const View& view, const EyePsfOptions& options,
                       int positions, const std::function<Image(int x, int y)>& right_half_at);

}  // namespace aureole::eye
