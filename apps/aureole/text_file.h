// Small files of text.
#pragma once

#include <string>

namespace aureole::app {

// The bytes of a file. Throws FileError if it cannot be read or is a folder.
std::string read_text_file(const std::string& path);

// The file appears whole or not at all. Throws FileError.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace aureole::app
