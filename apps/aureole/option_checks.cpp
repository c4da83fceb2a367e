#include "option_checks.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "aureole/base/error.h"

namespace aureole::app {
namespace {

// The whole text as a number of type T, or nothing.
template <class T>
std::optional<T> parsed(const std::string& text) {
    T value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) return std::nullopt;
    return value;
}

// Throwing from the check, and not returning a message as CLI11 would have it, gives all wrong
// values the same form wherever they are found.
template <class Accept>
CLI::Option* check(CLI::Option* option, std::string allowed, Accept accept) {
    const std::string name = option->get_name();
    return option->check([name, allowed = std::move(allowed), accept](const std::string& text) {
        if (!accept(text)) throw InvalidArgument(name, text, allowed);
        return std::string();
    });
}

std::string listed(const std::vector<std::string>& words) {
    std::string text = words.front();
    for (std::size_t i = 1; i < words.size(); ++i) {
        text += (i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    return text;
}

std::string range_text(double least, double most) {
    if (std::isfinite(most)) return fmt::format("must be a number from {:g} to {:g}", least, most);
    if (std::isfinite(least)) return fmt::format("must be a number, at least {}", least);
    return "must be a number";
}

}  // namespace

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& words) {
    option->type_name(fmt::format("{}", fmt::join(words, "|")));
    return check(option, "must be " + listed(words), [words](const std::string& text) {
        return std::find(words.begin(), words.end(), text) != words.end();
    });
}

CLI::Option* number(CLI::Option* option, double least, double most) {
    return check(option, range_text(least, most), [least, most](const std::string& text) {
        const std::optional<double> value = given_number(text);
        return value && *value >= least && *value <= most;
    });
}

CLI::Option* positive_number(CLI::Option* option, double most) {
    const std::string allowed = std::isfinite(most)
                                    ? fmt::format("must be a number above 0, up to {:g}", most)
                                    : "must be a number above 0";
    return check(option, allowed, [most](const std::string& text) {
        const std::optional<double> value = given_number(text);
        return value && *value > 0 && *value <= most;
    });
}

CLI::Option* whole_number(CLI::Option* option, std::int64_t least, std::int64_t most) {
    return check(option, fmt::format("must be a whole number from {} to {}", least, most),
                 [least, most](const std::string& text) {
                     const std::optional<std::int64_t> value = parsed<std::int64_t>(text);
                     return value && *value >= least && *value <= most;
                 });
}

CLI::Option* seed_number(CLI::Option* option) {
    return check(option, "must be a whole number from 0 to 18446744073709551615",
                 [](const std::string& text) { return parsed<std::uint64_t>(text).has_value(); });
}

CLI::Option* number_or_auto(CLI::Option* option) {
    return check(option, "must be auto or a number", [](const std::string& text) {
        return text == "auto" || given_number(text).has_value();
    });
}

std::optional<double> given_number(const std::string& text) {
    const std::optional<double> value = parsed<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::vector<double>> given_numbers(const std::string& text, char separator) {
    std::vector<double> numbers;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(separator, start), text.size());
        const std::optional<double> value = given_number(text.substr(start, end - start));
        if (!value) return std::nullopt;
        numbers.push_back(*value);
        start = end + 1;
    }
    return numbers;
}

void refuse(const std::string& option, const std::string& why) {
    if (!option.empty()) throw InvalidArgument(option + ": " + why);
}

std::string first_given(const CLI::App& group) {
    for (const CLI::Option* option : group.get_options()) {
        if (option->count() > 0) return option->get_name();
    }
    return "";
}

}  // namespace aureole::app
