#include "scene/study_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "aureole/base/error.h"

namespace aureole::scene {

void check_range(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(what, fmt::format("{}", value),
                          fmt::format("must be in [{}, {}]", low, high));
}

void check_light(const char* what, const color::Rgb& rgb) {
    for (const double value : rgb) {
        if (value >= 0 && std::isfinite(value)) continue;
        throw InvalidArgument(what, fmt::format("{}", value), "must be finite and not negative");
    }
}

}  // namespace aureole::scene
