#include "number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "aureole/base/error.h"
#include "aureole/io/text_file.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";  // U+FEFF in UTF-8

bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
}

// Bytes that no text has: a picture, or text of two bytes a letter.
bool is_text(const std::string& bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char c) {
        return is_control(c) && c != '\t' && c != '\r' && c != '\n';
    });
}

// As messages show it: what a terminal may not take as a question mark, and not all of a long one.
std::string shown(const std::string& cell) {
    constexpr std::size_t kMost = 40;
    if (cell.empty()) return "(nothing)";
    std::string text = cell.substr(0, kMost);
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return is_control(c) || static_cast<unsigned char>(c) > 0x7F; }, '?');
    return cell.size() > kMost ? text + "..." : text;
}

std::string trimmed(const std::string& text, const char* blanks = " \t\r") {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Calls visit(c, quoted) for each character but the quotes that open and close; two of them within
// quotes are one that counts. False if a quote does not end.
template <class Visit>
bool over_characters(const std::string& line, const Visit& visit) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] != '"') {
            visit(line[i], quoted);
        } else if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
            visit(line[++i], true);
        } else {
            quoted = !quoted;
        }
    }
    return !quoted;
}

char separator_of(const std::string& names) {
    char separator = ',';
    over_characters(names, [&](char c, bool quoted) {
        if (!quoted && (c == ';' || (c == '\t' && separator == ','))) separator = c;
    });
    return separator;
}

// False if a quote does not end.
bool split(const std::string& line, char separator, std::vector<std::string>& cells) {
    cells.assign(1, "");
    const bool whole = over_characters(line, [&](char c, bool quoted) {
        if (c == separator && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    });
    for (std::string& cell : cells) cell = trimmed(cell);
    return whole;
}

}  // namespace

NumberTable::NumberTable(const std::string& file) : file_(file) {
    std::string text = io::read_text_file(file);
    if (!is_text(text)) throw FileError(file, "is no table (CSV): it holds bytes that no text has");
    if (text.starts_with(kByteOrderMark)) text.erase(0, std::string(kByteOrderMark).size());
    std::istringstream stream(text);
    int number = 0;
    char separator = ',';
    std::vector<std::string> cells;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        line = trimmed(line, "\r");
        const std::string content = trimmed(line);
        if (content.empty() || content.front() == '#') continue;
        if (names_.empty()) separator = separator_of(line);
        if (!split(line, separator, cells)) {
            throw FileError(file, fmt::format("line {}: a quote does not end", number));
        }
        add_line(cells, number);
    }
    if (columns_.empty() || columns_[0].empty()) {
        throw FileError(file, "holds no numbers; must be a line of names and lines of numbers");
    }
}

void NumberTable::add_line(const std::vector<std::string>& cells, int line) {
    if (names_.empty()) {
        names_ = cells;
        columns_.resize(cells.size());
        return;
    }
    if (cells.size() != names_.size()) {
        throw FileError(file_, fmt::format("line {} has {} values; must have {}", line,
                                           cells.size(), names_.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto value = given_number(cells[i]);
        if (!value) {
            throw FileError(file_, fmt::format("line {}: {} = {}: must be a number such as 0.5",
                                               line, shown(names_[i]), shown(cells[i])));
        }
        columns_[i].push_back(*value);
    }
}

const std::vector<double>& NumberTable::column(const std::string& name) const {
    std::vector<std::string> others;
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (names_[i] == name) return columns_[i];
        others.push_back(shown(names_[i]));
    }
    throw FileError(file_, fmt::format("has no column {}, only {}", name, fmt::join(others, ", ")));
}

NumberTable table_of_option(const std::string& option, const std::string& file,
                            const std::string& words) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        throw FileError(file, fmt::format("there is no such file; {} must be {} or a table (CSV)",
                                          option, words));
    }
    return NumberTable(file);
}

}  // namespace aureole::app
