#include "eye/field_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/error.h"
#include "aureole/eye/field_psf.h"

namespace aureole::eye {
namespace {

constexpr double kMostFieldDeg = 160;

}  // namespace

void require_deg(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(what, fmt::format("{}", value),
                          fmt::format("must be {} to {} deg", low, high));
}

void check_field_of(const View& view) {
    for (const double x : {0.0, static_cast<double>(view.width)}) {
        for (const double y : {0.0, static_cast<double>(view.height)}) {
            const FieldPosition corner = field_position(view, x, y);
            require_deg("field of view",
                        2 * std::max(std::abs(corner.x_deg), std::abs(corner.y_deg)), 0,
                        kMostFieldDeg);
        }
    }
}

}  // namespace aureole::eye
