// Whether there is a file to read: internal to the module.
#pragma once

#include <string>

namespace aureole::io {

// Throws FileError if `path` is missing, a folder, empty or may not be read: what decoders say of
// these is hard to understand.
void check_readable(const std::string& path);

}  // namespace aureole::io
