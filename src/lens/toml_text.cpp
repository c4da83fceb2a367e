#include "lens/toml_text.h"

#include "lens/format_text.h"

namespace aureole::lens {
namespace {

bool starts_key(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '"' || c == '\'';
}

void require_keys_in_headers(std::string_view text, const std::string& file) {
    constexpr std::string_view kBlank = " \t";
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    for (Place place{file, 1}; !text.empty(); ++place.line) {
        const std::string_view line = take_line(text);
        std::size_t at = line.find_first_not_of(kBlank);
        if (at == std::string_view::npos || line[at] != '[') continue;
        ++at;
        if (at < line.size() && line[at] == '[') ++at;
        at = line.find_first_not_of(kBlank, at);
        if (at == std::string_view::npos || !starts_key(line[at])) {
            place.fail("line", line, "a [ that starts a line must be followed by a name");
        }
    }
}

}  // namespace

toml::table toml_table(std::string_view text, const std::string& file) {
    require_keys_in_headers(text, file);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        Place{file, error.source().begin.line}.fail(
            fmt::format("no TOML: {}", error.description()));
    }
}

}  // namespace aureole::lens
