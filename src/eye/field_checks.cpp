#include "eye/field_checks.h"

#include <fmt/format.h>

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
            const double across_deg = 2 * std::abs(corner.x_deg);
            const double up_deg = 2 * std::abs(corner.y_deg);
            if (across_deg <= kMostFieldDeg && up_deg <= kMostFieldDeg) continue;
            throw InvalidArgument("field of view",
                                  fmt::format("{:.4g} x {:.4g} deg", across_deg, up_deg),
                                  fmt::format("must be at most {:g} deg wide and high where glare "
                                              "varies over it",
                                              kMostFieldDeg));
        }
    }
}

}  // namespace aureole::eye
