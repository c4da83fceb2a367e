// Technical drawings as SVG (to edit and to print) and PNG (to look at).
#pragma once

#include <string>

#include "aureole/image/drawing.h"

namespace aureole::io {

// By extension: .svg, .png (`png_width_px` wide, antialiased) or .pdf. The file appears whole or
// not at all. Throws InvalidArgument for another extension, an empty sheet, coordinates that are
// not finite, or a width outside [16, 20000]; FileError if it cannot be written.
void write_drawing(const std::string& path, const Drawing& drawing, int png_width_px = 1600);

// Throws InvalidArgument unless write_drawing() knows the extension.
void check_drawing_extension(const std::string& path);

}  // namespace aureole::io
