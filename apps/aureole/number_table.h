// Tables of numbers in text files: comma-separated values, as programs and spreadsheets write them.
#pragma once

#include <string>
#include <vector>

namespace aureole::app {

// A line of names, then as many finite numbers in every line. If a semicolon or a tab is in the
// line of names it separates the cells, else the comma does; numbers have a decimal point
// and no comma. Blanks
// and quotes around a cell do not matter, nor does the mark of UTF-8 at the start. Empty lines and
// lines that start with # are skipped.
class NumberTable {
  public:
    // Throws FileError that names the file and the line.
    explicit NumberTable(const std::string& file);

    // Throws FileError that lists the columns there are unless there is one of this name.
    const std::vector<double>& column(const std::string& name) const;

  private:
    void add_line(const std::vector<std::string>& cells, int line);

    std::string file_;
    std::vector<std::string> names_;
    std::vector<std::vector<double>> columns_;
};

// The table that an option names which takes words too ("off, auto"). What is no file may be a word
// misspelt: throws FileError that names the option and its words. Else as NumberTable.
NumberTable table_of_option(const std::string& option, const std::string& file,
                            const std::string& words);

}  // namespace aureole::app
