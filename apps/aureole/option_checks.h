// Checks of option values. Their messages name the option, the value and what is allowed:
// "--age = old: must be a number". Each returns the option that it was given.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace aureole::app {

// One of these words; the help shows them.
CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words);

// A finite number in [least, most].
CLI::Option* number(CLI::Option* option, double least = -std::numeric_limits<double>::infinity(),
                    double most = std::numeric_limits<double>::infinity());
// A finite number above 0, up to `most`.
CLI::Option* positive_number(CLI::Option* option,
                             double most = std::numeric_limits<double>::infinity());

// An integer in [least, most], decimal.
CLI::Option* whole_number(CLI::Option* option, std::int64_t least, std::int64_t most);
// An integer in [0, 2^64).
CLI::Option* seed_number(CLI::Option* option);

// "auto" or a finite number; given_number() is that number, or nothing for auto.
CLI::Option* number_or_auto(CLI::Option* option);
std::optional<double> given_number(const std::string& text);

// "0.5,1,2" with the separator ',' as numbers, or nothing unless all parts are finite numbers.
std::optional<std::vector<double>> given_numbers(const std::string& text, char separator);

// Throws InvalidArgument "OPTION: WHY" unless `option` is empty: for options that contradict each
// other or have no effect.
void refuse(const std::string& option, const std::string& why);

// The first option of a group that was given on the command line; else empty.
std::string first_given(const CLI::App& group);

}  // namespace aureole::app
