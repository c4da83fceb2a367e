// The field of view that a picture's metadata tells.
#pragma once

#include <optional>
#include <string>

#include "aureole/io/picture.h"

namespace aureole::io {

struct FieldOfView {
    double deg = 0;      // horizontal, over the width of the display window
    std::string source;  // the attribute it comes from
};

// The first of these that is there and makes sense:
//   aureole:fov_deg              as it is, in (0, 360)
//   screenWindowWidth            2 atan(w / 2), unless it is 1, which is what writers without a
//                                camera put there
//   Exif:FocalLengthIn35mmFilm   2 atan(18 / f) for the long side of the picture, f in mm
// nullopt if none is.
std::optional<FieldOfView> field_of_view(const Picture& picture);

}  // namespace aureole::io
