// Technical drawings as SVG and PDF (to print) and PNG (to look at).
#pragma once

#include <string>

#include "aureole/image/drawing.h"

namespace aureole::io {

// By extension: .svg, .png (`png_width_px` wide, antialiased) or .pdf. Letters are DejaVu Sans, or
// what the machine has in its place; in SVG they are outlines, which look the same everywhere. The
// file appears whole or not at all (io/picture.h).
// Bytes that are no printable UTF-8 are drawn as "?". Throws InvalidArgument for another extension,
// a sheet that is empty or larger than 5 m, numbers that are not finite, colours outside [0, 1], a
// width outside [16, 20000] or one at which the picture would be higher than that; FileError if it
// cannot be written.
void write_drawing(const std::string& path, const Drawing& drawing, int png_width_px = 1600);

// Throws InvalidArgument unless write_drawing() knows the extension.
void check_drawing_extension(const std::string& path);

}  // namespace aureole::io
