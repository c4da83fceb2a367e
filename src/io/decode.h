// From what display formats store to linear, upright, alpha-multiplied light: internal to the
// module.
#pragma once

#include <OpenImageIO/imageio.h>

#include "aureole/image/image.h"
#include "aureole/io/picture.h"

namespace aureole::io {

// Decodes the transfer function of integer files (sRGB unless the file names another) and
// multiplies colour by alpha where the file stores it unmultiplied, so that what is transparent
// sends no light. Floating-point files are linear.
void linearize(const OIIO::ImageSpec& spec, const ColorChannels& channels, Image& image);

// Turns a picture as the Exif / TIFF tag Orientation (1 to 8) demands: row 0 on top, column 0 on
// the left. Other values leave it as it is.
Image upright(Image image, int orientation);

}  // namespace aureole::io
