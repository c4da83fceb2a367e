// What the parsers of lens files share: numbers, lines, and where in a file something is wrong.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

// A place in a file, for messages. line and surface count from 1; 0 is left out.
struct Place {
    const std::string& file;
    std::size_t line = 0;
    std::size_t surface = 0;

    // Throws FileError: "FILE: line 12: surface 3: WHAT = VALUE: ALLOWED".
    [[noreturn]] void fail(const std::string& reason) const;
    [[noreturn]] void fail(std::string_view what, std::string_view value,
                           std::string_view allowed) const;
};

// Throws FileError for an empty file and one above 4 MiB, which is no lens.
void require_size(std::string_view bytes, const std::string& file);

// The whole text as a number, decimal point whatever the locale, a sign and an exponent of E or D
// allowed; nothing if it is none. "inf" and "nan" are numbers here: callers use finite_number().
std::optional<double> number_in(std::string_view text);
// Throws FileError if it is no number or not finite.
double finite_number(std::string_view text, std::string_view what, const Place& place);

// Words between blanks (space, tab); "..." and '...' are one word, without the quotes.
std::vector<std::string_view> words_in(std::string_view line);
std::string_view trimmed(std::string_view text);
std::string upper_case(std::string_view text);
// Takes the first line, without its end (LF or CR LF), off the text.
std::string_view take_line(std::string_view& text);

// At most 60 printable characters of something found in a file, for messages.
std::string excerpt(std::string_view text);

// The prescription, validated; throws FileError instead of InvalidArgument.
Prescription checked(Prescription prescription, const std::string& file);

}  // namespace aureole::lens
