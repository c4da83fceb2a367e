#include "aureole/eye/gaze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "aureole/base/error.h"
#include "eye/band_noise.h"
#include "eye/piecewise_linear.h"
#include "eye/time_range.h"

namespace aureole::eye {
namespace {

constexpr double kFixationS = 1.0 / 3;
constexpr double kFixationSdDeg = 5.3;
constexpr double kSaccadeS = 0.021;
constexpr double kSaccadeSPerDeg = 0.0022;
constexpr double kLongestSaccadeS = 0.15;
constexpr double kMostDeg = 1e6;  // thousands of turns
// e^-40 is below the rounding of a double: older turns change no bit.
constexpr double kMemory = 40;

Rotation mix(const Rotation& a, const Rotation& b, double part) {
    return {a.yaw_deg + part * (b.yaw_deg - a.yaw_deg),
            a.pitch_deg + part * (b.pitch_deg - a.pitch_deg),
            a.roll_deg + part * (b.roll_deg - a.roll_deg)};
}

// sum += weight (b - a)
void add_difference(Rotation& sum, const Rotation& a, const Rotation& b, double weight) {
    sum.yaw_deg += weight * (b.yaw_deg - a.yaw_deg);
    sum.pitch_deg += weight * (b.pitch_deg - a.pitch_deg);
    sum.roll_deg += weight * (b.roll_deg - a.roll_deg);
}

// The lag that a unit change of the gaze's velocity leaves after a time, with its sign turned.
class ImpulseResponse {
  public:
    explicit ImpulseResponse(const VitreousMechanics& mechanics)
        : decay_(2 * kPi * mechanics.frequency_hz * mechanics.damping),
          square_(decay_ * decay_ - std::pow(2 * kPi * mechanics.frequency_hz, 2)),
          root_(std::sqrt(std::abs(square_))) {}

    double at(double after_s) const noexcept {
        if (after_s <= 0) return 0;
        if (root_ * after_s < 1e-6) return after_s * std::exp(-decay_ * after_s);
        if (square_ < 0) return std::exp(-decay_ * after_s) * std::sin(root_ * after_s) / root_;
        return (std::exp((root_ - decay_) * after_s) - std::exp(-(root_ + decay_) * after_s)) /
               (2 * root_);
    }
    double memory_s() const noexcept { return kMemory / (square_ > 0 ? decay_ - root_ : decay_); }

  private:
    double decay_;
    double square_;
    double root_;
};

Rotation fixation(std::uint64_t seed, std::int64_t number) {
    Random random = random_of(seed, kSaccadeStream, number);
    const double yaw_deg = kFixationSdDeg * random.normal();
    return {yaw_deg, kFixationSdDeg * random.normal(), 0};
}

}  // namespace

void check(const VitreousMechanics& mechanics) {
    if (!(mechanics.frequency_hz >= 0.05 && mechanics.frequency_hz <= 20)) {
        throw InvalidArgument("vitreous frequency", fmt::format("{}", mechanics.frequency_hz),
                              "must be 0.05 to 20 Hz");
    }
    if (!(mechanics.damping >= 0.1 && mechanics.damping <= 10)) {
        throw InvalidArgument("vitreous damping", fmt::format("{}", mechanics.damping),
                              "must be 0.1 to 10");
    }
}

Gaze Gaze::through(std::vector<double> times_s, std::vector<Rotation> rotations) {
    check_times(times_s);
    if (rotations.size() != times_s.size()) {
        throw InvalidArgument("rotations", fmt::format("{}", rotations.size()),
                              fmt::format("must be as many as times, {}", times_s.size()));
    }
    for (const Rotation& rotation : rotations) {
        for (const double angle_deg : {rotation.yaw_deg, rotation.pitch_deg, rotation.roll_deg}) {
            if (std::abs(angle_deg) <= kMostDeg) continue;
            throw InvalidArgument("rotation", fmt::format("{}", angle_deg),
                                  fmt::format("must be {:g} to {:g} deg", -kMostDeg, kMostDeg));
        }
    }
    Gaze gaze;
    gaze.times_s_ = std::move(times_s);
    gaze.rotations_ = std::move(rotations);
    return gaze;
}

Gaze Gaze::saccades(std::uint64_t seed) {
    Gaze gaze;
    gaze.saccades_ = true;
    gaze.seed_ = seed;
    return gaze;
}

Gaze::Saccade Gaze::saccade(std::int64_t number) const noexcept {
    Saccade saccade{};
    saccade.from = fixation(seed_, number - 1);
    saccade.to = fixation(seed_, number);
    const double angle_deg = std::hypot(saccade.to.yaw_deg - saccade.from.yaw_deg,
                                        saccade.to.pitch_deg - saccade.from.pitch_deg);
    Random random = random_of(~seed_, kSaccadeStream, number);
    saccade.start_s = (static_cast<double>(number)) * kFixationS +
                      random.uniform(0, kFixationS - kLongestSaccadeS);
    saccade.end_s =
        saccade.start_s + std::min(kSaccadeS + kSaccadeSPerDeg * angle_deg, kLongestSaccadeS);
    return saccade;
}

Rotation Gaze::at(double time_s) const noexcept {
    time_s = nearest_moment_s(time_s);
    if (saccades_) {
        const Saccade s = saccade(static_cast<std::int64_t>(std::floor(time_s / kFixationS)));
        return mix(s.from, s.to,
                   std::clamp((time_s - s.start_s) / (s.end_s - s.start_s), 0.0, 1.0));
    }
    if (times_s_.empty()) return {};
    const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), time_s);
    if (after == times_s_.begin()) return rotations_.front();
    if (after == times_s_.end()) return rotations_.back();
    const auto i = static_cast<std::size_t>(after - times_s_.begin());
    return mix(rotations_[i - 1], rotations_[i],
               (time_s - times_s_[i - 1]) / (times_s_[i] - times_s_[i - 1]));
}

Rotation Gaze::vitreous_lag(double time_s, const VitreousMechanics& mechanics) const noexcept {
    time_s = nearest_moment_s(time_s);
    const ImpulseResponse response(mechanics);
    Rotation lag;
    // A straight piece of the curve changes the velocity at its start, and back at its end.
    const auto turn = [&](double start_s, double end_s, const Rotation& from, const Rotation& to) {
        const double weight =
            (response.at(time_s - end_s) - response.at(time_s - start_s)) / (end_s - start_s);
        add_difference(lag, from, to, weight);
    };
    const double since_s = time_s - response.memory_s();
    if (saccades_) {
        const auto last = static_cast<std::int64_t>(std::floor(time_s / kFixationS));
        for (auto i = static_cast<std::int64_t>(std::floor(since_s / kFixationS)); i <= last; ++i) {
            const Saccade s = saccade(i);
            turn(s.start_s, s.end_s, s.from, s.to);
        }
        return lag;
    }
    const auto first = std::lower_bound(times_s_.begin(), times_s_.end(), since_s);
    auto i = static_cast<std::size_t>(first - times_s_.begin());
    if (i > 0) --i;
    for (; i + 1 < times_s_.size() && times_s_[i] < time_s; ++i) {
        turn(times_s_[i], times_s_[i + 1], rotations_[i], rotations_[i + 1]);
    }
    return lag;
}

}  // namespace aureole::eye
