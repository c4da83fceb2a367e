// Text of other programs as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace aureole::lens {

// UTF-16 of either byte order, told by its mark, and UTF-8 with or without one. Half a surrogate
// pair, and bytes that are no UTF-8, become '?': only names and comments can hold them. Throws
// FileError for UTF-16 with an odd number of bytes.
std::string utf8_text(std::string_view bytes, const std::string& file);

}  // namespace aureole::lens
