// TOML, before it is understood.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace aureole::lens {

// Throws FileError with the file, the line and the reason for what is no TOML.
//
// Asks for one thing more than TOML does: a [ that starts a line must be followed by a key, a digit
// or a quote, inside texts of several lines too. toml++ 3.3 takes that for granted where it reads
// the header of a table, and goes astray on "[#" (an assertion, or undefined behaviour without).
toml::table toml_table(std::string_view text, const std::string& file);

}  // namespace aureole::lens
