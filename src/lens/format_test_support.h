// For the tests of parsers.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"

namespace aureole::lens {

using Parser = Prescription (*)(std::string_view, const std::string&);

// The message of the FileError, "accepted" without one; any other exception goes through.
inline std::string refusal(Parser parse, std::string_view text) {
    try {
        parse(text, "some/file.ext");
    } catch (const FileError& error) {
        return error.what();
    }
    return "accepted";
}

// The text with the first `from` replaced; a test that finds none would test nothing.
inline std::string with(std::string_view text, std::string_view from, std::string_view to) {
    std::string out(text);
    const std::size_t at = out.find(from);
    if (at == std::string::npos) throw Error("not in the text: " + std::string(from));
    return out.replace(at, from.size(), to);
}

// A spoilt text, and what the message must hold.
struct Spoilt {
    std::string_view from, to;
    std::vector<std::string> said;
};

}  // namespace aureole::lens
