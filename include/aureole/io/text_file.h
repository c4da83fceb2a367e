// Small files of text: lens tables, settings.
#pragma once

#include <cstddef>
#include <string>

namespace aureole::io {

inline constexpr std::size_t kMostTextBytes = std::size_t{16} << 20;

// The bytes of a file. Throws FileError if it is missing, a folder, cannot be read or is longer
// than kMostTextBytes: no text that people write is.
std::string read_text_file(const std::string& path);

// The file appears whole or not at all (io/picture.h). Throws FileError.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace aureole::io
