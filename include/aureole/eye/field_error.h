// How well streaks blended over the field follow those computed for each position.
#pragma once

#include <functional>

#include "aureole/eye/field_psf.h"
#include "aureole/image/image.h"
#include "aureole/wave/field_error.h"

namespace aureole::eye {

// At `positions` pixels drawn at random over the picture. The truth is streaks_at() without end,
// so that what the blend cuts off counts too. .2 s each at the default raster.
// Throws InvalidArgument for positions outside 1 to 10000.
wave::FieldError field_error(const Eye& eye, const wave::VaryingPsf& psf,
                             const EyePsfOptions& options, int positions);

// The same for anything else that gives half a kernel (kernel_nodes.h) for pixel (x, y).
wave::FieldError field_error(const Eye& eye, const View& view, const EyePsfOptions& options,
                             int positions,
                             const std::function<Image(int x, int y)>& right_half_at);

}  // namespace aureole::eye
