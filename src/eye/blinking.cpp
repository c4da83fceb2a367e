#include "aureole/eye/blinking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "aureole/base/error.h"
#include "aureole/base/smoothstep.h"
#include "eye/band_noise.h"
#include "eye/piecewise_linear.h"
#include "eye/time_range.h"

namespace aureole::eye {
namespace {

constexpr double kClosingS = 0.092;
constexpr double kClosingSdS = 0.017;
constexpr double kOpeningS = 0.242;
constexpr double kOpeningSdS = 0.055;

// Uniform, with this mean and standard deviation.
double uniform_about(Random& random, double mean, double sd) {
    const double half_width = std::sqrt(3.0) * sd;
    return random.uniform(mean - half_width, mean + half_width);
}

Blink random_blink(Random& random) {
    Blink blink;
    blink.closing_s = uniform_about(random, kClosingS, kClosingSdS);
    blink.opening_s = uniform_about(random, kOpeningS, kOpeningSdS);
    return blink;
}

}  // namespace

void check(const BlinkSettings& settings) {
    if (!(settings.per_minute >= 1 && settings.per_minute <= 60)) {
        throw InvalidArgument("blinks per minute", fmt::format("{}", settings.per_minute),
                              "must be 1 to 60");
    }
    if (settings.blinking == Blinking::kVoluntary) check_times(settings.voluntary_s);
}

double Blink::closure(double time_s) const noexcept {
    const double after_s = time_s - start_s;
    if (after_s <= 0 || after_s >= closing_s + opening_s) return 0;
    return after_s < closing_s ? smoothstep(0, closing_s, after_s)
                               : smoothstep(0, opening_s, closing_s + opening_s - after_s);
}

Blinks::Blinks(const BlinkSettings& settings, std::uint64_t seed)
    : settings_(settings), seed_(seed) {
    check(settings);
}

Blink Blinks::spontaneous(std::int64_t interval) const noexcept {
    const double length_s = 60 / settings_.per_minute;
    Random random = random_of(seed_, kBlinkStream, interval);
    Blink blink = random_blink(random);
    blink.start_s =
        static_cast<double>(interval) * length_s + random.uniform(0, length_s - kLongestBlinkS);
    return blink;
}

Blink Blinks::voluntary(std::size_t index) const noexcept {
    Random random = random_of(seed_, kBlinkStream, static_cast<std::int64_t>(index));
    Blink blink = random_blink(random);
    blink.start_s = settings_.voluntary_s[index];
    return blink;
}

double Blinks::closure(double time_s) const noexcept {
    time_s = nearest_moment_s(time_s);
    if (settings_.blinking == Blinking::kSpontaneous) {
        const double interval = std::floor(time_s * settings_.per_minute / 60);
        return spontaneous(static_cast<std::int64_t>(interval)).closure(time_s);
    }
    if (settings_.blinking == Blinking::kSuppressed) return 0;
    const auto& starts = settings_.voluntary_s;
    const auto first = std::lower_bound(starts.begin(), starts.end(), time_s - kLongestBlinkS);
    double closure = 0;
    for (auto i = static_cast<std::size_t>(first - starts.begin());
         i < starts.size() && starts[i] < time_s; ++i) {
        closure = std::max(closure, voluntary(i).closure(time_s));
    }
    return closure;
}

std::vector<Blink> Blinks::between(double from_s, double to_s) const {
    from_s = nearest_moment_s(from_s);
    to_s = nearest_moment_s(to_s);
    std::vector<Blink> found;
    const auto add = [&](const Blink& blink) {
        if (blink.start_s >= from_s && blink.start_s < to_s) found.push_back(blink);
    };
    if (settings_.blinking == Blinking::kSpontaneous) {
        const double per_second = settings_.per_minute / 60;
        const auto last = static_cast<std::int64_t>(std::floor(to_s * per_second));
        for (auto i = static_cast<std::int64_t>(std::floor(from_s * per_second)); i <= last; ++i) {
            add(spontaneous(i));
        }
    } else if (settings_.blinking == Blinking::kVoluntary) {
        for (std::size_t i = 0; i < settings_.voluntary_s.size(); ++i) add(voluntary(i));
    }
    return found;
}

}  // namespace aureole::eye
