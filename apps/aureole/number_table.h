// Tables of numbers in files of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace aureole::app {

// A line of names, then as many finite numbers in every line; blanks around them do not matter.
// Empty lines and lines that start with # are skipped.
class NumberTable {
  public:
    // Throws FileError that names the file and the line.
    explicit NumberTable(const std::string& file);

    // Throws FileError that lists the columns there are unless there is one of this name.
    const std::vector<double>& column(const std::string& name) const;

  private:
    std::string file_;
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
};

}  // namespace aureole::app
