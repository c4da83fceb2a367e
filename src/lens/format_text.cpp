#include "lens/format_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "aureole/base/error.h"

namespace aureole::lens {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 20;
constexpr std::size_t kExcerptLength = 60;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

void Place::fail(const std::string& reason) const {
    std::string where;
    if (line > 0) where += fmt::format("line {}: ", line);
    if (surface > 0) where += fmt::format("surface {}: ", surface);
    throw FileError(file, where + reason);
}

void Place::fail(std::string_view what, std::string_view value, std::string_view allowed) const {
    fail(fmt::format("{} = {}: {}", what, excerpt(value), allowed));
}

void require_size(std::string_view bytes, const std::string& file) {
    if (bytes.empty()) throw FileError(file, "empty: must hold a lens table");
    if (bytes.size() > kMaxBytes) {
        throw FileError(
            file, fmt::format("{} bytes: a lens table has at most {}", bytes.size(), kMaxBytes));
    }
}

std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    std::string plain(text);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    double value = 0;
    const char* end = plain.data() + plain.size();
    const auto [stopped, error] = std::from_chars(plain.data(), end, value);
    if (stopped != end || plain.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range) return HUGE_VAL;
    if (error != std::errc()) return std::nullopt;
    return value;
}

double finite_number(std::string_view text, std::string_view what, const Place& place) {
    const std::optional<double> value = number_in(text);
    if (!value || !std::isfinite(*value)) place.fail(what, text, "must be a finite number");
    return *value;
}

std::vector<std::string_view> words_in(std::string_view line) {
    std::vector<std::string_view> words;
    std::size_t at = 0;
    while (true) {
        while (at < line.size() && blank(line[at])) ++at;
        if (at == line.size()) return words;
        const char quote = line[at];
        const bool quoted = quote == '"' || quote == '\'';
        const std::size_t start = quoted ? at + 1 : at;
        at = start;
        while (at < line.size() && (quoted ? line[at] != quote : !blank(line[at]))) ++at;
        words.push_back(line.substr(start, at - start));
        if (quoted && at < line.size()) ++at;
    }
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string upper_case(std::string_view text) {
    std::string upper(text);
    // Not std::toupper, which follows the locale.
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return upper;
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string excerpt(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, kExcerptLength)) {
        shown += c >= ' ' && c <= '~' ? c : '?';
    }
    if (text.size() > kExcerptLength) shown += "...";
    return shown;
}

Prescription checked(Prescription prescription, const std::string& file) {
    try {
        validate(prescription);
    } catch (const InvalidArgument& error) {
        throw FileError(file, error.what());
    }
    return prescription;
}

}  // namespace aureole::lens
