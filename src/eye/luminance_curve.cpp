#include "aureole/eye/luminance_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "aureole/base/error.h"
#include "aureole/eye/ranges.h"
#include "eye/piecewise_linear.h"

namespace aureole::eye {
namespace {

// e^-40 is below the rounding of a double: older history changes no bit.
constexpr double kMemory = 40;

double log10_luminance(double luminance_cd_m2) {
    if (!(luminance_cd_m2 >= 0 && luminance_cd_m2 <= kBrightestCdM2)) {
        throw InvalidArgument("luminance", fmt::format("{}", luminance_cd_m2),
                              fmt::format("must be 0 to {:g} cd/m2", kBrightestCdM2));
    }
    return std::log10(std::max(luminance_cd_m2, kDarknessCdM2));
}

// Not beyond the range by a rounding.
double luminance_cd_m2(double log10_luminance) noexcept {
    return std::min(std::pow(10.0, log10_luminance), kBrightestCdM2);
}

// x(t) behind a lag of first order. By parts, x(t) minus the integral of e^(-u/T) x'(t - u) over
// the past, where x' is constant between two points of the curve.
double lagged(const std::vector<double>& times_s, const std::vector<double>& values, double time_s,
              double lag_s) noexcept {
    double behind = 0;
    const auto first = std::lower_bound(times_s.begin(), times_s.end(), time_s - kMemory * lag_s);
    auto i = static_cast<std::size_t>(first - times_s.begin());
    if (i > 0) --i;
    for (; i + 1 < times_s.size() && times_s[i] < time_s; ++i) {
        const double slope = (values[i + 1] - values[i]) / (times_s[i + 1] - times_s[i]);
        const double end_s = std::min(times_s[i + 1], time_s);
        behind += slope * lag_s *
                  (std::exp((end_s - time_s) / lag_s) - std::exp((times_s[i] - time_s) / lag_s));
    }
    return value_at(times_s, values, time_s) - behind;
}

void require(const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(name, fmt::format("{}", value),
                          fmt::format("must be {} to {} s", low, high));
}

}  // namespace

LuminanceCurve::LuminanceCurve(double luminance_cd_m2)
    : times_s_{0}, log10_luminances_{log10_luminance(luminance_cd_m2)} {}

LuminanceCurve::LuminanceCurve(std::vector<double> times_s,
                               const std::vector<double>& luminances_cd_m2)
    : times_s_(std::move(times_s)) {
    check_times(times_s_);
    if (luminances_cd_m2.size() != times_s_.size()) {
        throw InvalidArgument("luminances", fmt::format("{}", luminances_cd_m2.size()),
                              fmt::format("must be as many as times, {}", times_s_.size()));
    }
    for (const double value : luminances_cd_m2) log10_luminances_.push_back(log10_luminance(value));
}

double LuminanceCurve::at(double time_s) const noexcept {
    return luminance_cd_m2(value_at(times_s_, log10_luminances_, time_s));
}

void check(const PupilReflex& reflex) {
    require("delay", reflex.delay_s, 0, 2);
    require("constriction", reflex.constriction_s, 0.01, 60);
    require("dilation", reflex.dilation_s, reflex.constriction_s, 60);
}

double damped_luminance_cd_m2(const LuminanceCurve& curve, double time_s,
                              const PupilReflex& reflex) noexcept {
    const double heard_s = time_s - reflex.delay_s;
    const auto behind = [&](double lag_s) {
        return lagged(curve.times_s(), curve.log10_luminances(), heard_s, lag_s);
    };
    return luminance_cd_m2(std::max(behind(reflex.constriction_s), behind(reflex.dilation_s)));
}

}  // namespace aureole::eye
