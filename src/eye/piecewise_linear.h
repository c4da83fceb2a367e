// Curves through points, straight between them and constant before and after.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"

namespace aureole::eye {

// Throws InvalidArgument unless there is a time at least, and all ascend within kFarthestTimeS of
// 0.
inline void check_times(const std::vector<double>& times_s) {
    if (times_s.empty()) throw InvalidArgument("times", "none", "must be one at least");
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        if (!(std::abs(times_s[i]) <= kFarthestTimeS)) {
            throw InvalidArgument(
                "time (s)", fmt::format("{}", times_s[i]),
                fmt::format("must be {:g} to {:g}", -kFarthestTimeS, kFarthestTimeS));
        }
        if (i > 0 && times_s[i] <= times_s[i - 1]) {
            throw InvalidArgument("time (s)", fmt::format("{}", times_s[i]),
                                  "must be later than the one before");
        }
    }
}

// The value at a time; as many values as times.
inline double value_at(const std::vector<double>& times_s, const std::vector<double>& values,
                       double time_s) noexcept {
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s);
    if (after == times_s.begin()) return values.front();
    const auto i = static_cast<std::size_t>(after - times_s.begin());
    if (after == times_s.end()) return values.back();
    const double part = (time_s - times_s[i - 1]) / (times_s[i] - times_s[i - 1]);
    return values[i - 1] + part * (values[i] - values[i - 1]);
}

}  // namespace aureole::eye
