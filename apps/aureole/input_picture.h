// Pictures as commands read them.
#pragma once

#include <cstddef>
#include <string>

#include "aureole/io/picture.h"
#include "session.h"

namespace aureole::app {

struct InputPicture {
    io::Picture picture;
    std::size_t nonfinite_pixels = 0;  // had NaN or infinity, now 0; noted
};

// Timed as "read". Throws FileError.
InputPicture read_input(const std::string& file, Session& session);

}  // namespace aureole::app
