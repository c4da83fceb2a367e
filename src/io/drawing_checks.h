// What a drawing must be before it can be drawn.
#pragma once

#include "aureole/image/drawing.h"

namespace aureole::io {

inline constexpr double kLargestSheetMm = 5000;  // what a PDF can be: 14400 points
inline constexpr int kMostPixels = 20000;        // per side of a PNG and of an image in a drawing

// Throws InvalidArgument, "WHAT of a drawing", unless value is a number in [least, most].
void check_number(const char* what, double value, double least = -kLargestSheetMm * 1e3,
                  double most = kLargestSheetMm * 1e3);

// The same for all that is in it.
void check_drawing(const Drawing& drawing);

}  // namespace aureole::io
