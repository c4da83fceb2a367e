#include "number_table.h"

#include <fmt/format.h>

#include <sstream>

#include "aureole/base/error.h"
#include "aureole/io/text_file.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

std::string trimmed(const std::string& text) {
    constexpr const char* kBlanks = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
    return cells;
}

}  // namespace

NumberTable::NumberTable(const std::string& file) : file_(file) {
    std::istringstream stream(io::read_text_file(file));
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        line = trimmed(line);
        if (line.empty() || line.front() == '#') continue;
        const std::vector<std::string> cells = cells_of(line);
        if (names_.empty()) {
            names_ = cells;
            columns_.resize(cells.size());
            continue;
        }
        if (cells.size() != names_.size()) {
            throw FileError(file, fmt::format("line {} has {} values; must have {}", number,
                                              cells.size(), names_.size()));
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto value = given_number(cells[i]);
            if (!value) {
                throw FileError(file, fmt::format("line {}: {} = {}: must be a number", number,
                                                  names_[i], cells[i]));
            }
            columns_[i].push_back(*value);
        }
    }
    if (columns_.empty() || columns_[0].empty()) {
        throw FileError(file, "holds no numbers; must be a line of names and lines of numbers");
    }
}

const std::vector<double>& NumberTable::column(const std::string& name) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (names_[i] == name) return columns_[i];
    }
    throw FileError(file_, fmt::format("has no column {}, only {}", name, fmt::join(names_, ", ")));
}

}  // namespace aureole::app
