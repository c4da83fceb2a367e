#include "ibl/filter_options.h"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/ibl/roughness.h"

namespace aureole::ibl {

void check_count(const char* name, int value, int most) {
    if (value < 1 || value > most) {
        throw InvalidArgument(name, std::to_string(value), fmt::format("must be in [1, {}]", most));
    }
}

void check_levels(int size, const std::vector<double>& roughness) {
    check_count("size", size, 16384);
    const int levels = static_cast<int>(roughness.size());
    if (levels < 1 || levels > most_levels(size)) {
        throw InvalidArgument("levels", std::to_string(levels),
                              fmt::format("an environment of {} texels per side has 1 to {} levels",
                                          size, most_levels(size)));
    }
    for (const double value : roughness) {
        if (!(value >= 0 && value <= 1)) {
            throw InvalidArgument("roughness", fmt::format("{}", value), "must be in [0, 1]");
        }
    }
}

void check_fis(double overlap, double bias) {
    if (!(overlap > 0) || !std::isfinite(overlap)) {
        throw InvalidArgument("fis_overlap", fmt::format("{}", overlap),
                              "must be a positive number");
    }
    if (!std::isfinite(bias)) {
        throw InvalidArgument("fis_bias", fmt::format("{}", bias), "must be a finite number");
    }
}

}  // namespace aureole::ibl
