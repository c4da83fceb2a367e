// When lids close, and how far.
#pragma once

#include <cstdint>
#include <vector>

namespace aureole::eye {

enum class Blinking {
    kSuppressed,   // none
    kSpontaneous,  // by themselves, at irregular intervals
    kVoluntary,    // at given times
};

struct BlinkSettings {
    Blinking blinking = Blinking::kSuppressed;
    // kSpontaneous. Men blink 11, women 19 times a minute (Sforza et al. 2008, "Spontaneous
    // blinking in healthy persons", Ophthalmic and Physiological Optics 28:345). 1 to 60.
    double per_minute = 15;
    std::vector<double> voluntary_s = {};  // kVoluntary: when the lids begin to close; ascending,
                                           // within kFarthestTimeS of 0 (ranges.h)
    // Lashes come down with the lids and bend, but the lids cover nothing and no light is lost: for
    // people who look at a screen and blink themselves (thesis, section 2.4).
    bool streaks_only = false;
};

// Throws InvalidArgument that names the first value outside the ranges above.
void check(const BlinkSettings& settings);

// One closing and opening. Durations of spontaneous blinks (VanderWerf et al. 2003, "Eyelid
// movements: behavioral studies of blinking in humans under different stimulus conditions", Journal
// of Neurophysiology 89:2784): closing 92 +- 17 ms, opening 242 +- 55 ms; here uniform with these
// means and standard deviations, so that no blink is longer than kLongestBlinkS.
struct Blink {
    double start_s = 0;
    double closing_s = 0.092;
    double opening_s = 0.242;

    double end_s() const noexcept { return start_s + closing_s + opening_s; }
    // 0 open to 1 closed; both ways with a smooth start and end.
    double closure(double time_s) const noexcept;
};
inline constexpr double kLongestBlinkS = 0.46;

// The blinks of one person. Spontaneous ones: one in each interval of 60 / per_minute seconds, at a
// random place in it, so that distances spread from a blink's duration to two intervals and any of
// them is known without those before.
class Blinks {
  public:
    // Throws as check().
    Blinks(const BlinkSettings& settings, std::uint64_t seed);

    // 0 open to 1 closed.
    double closure(double time_s) const noexcept;
    // Those that begin in [from_s, to_s), in order.
    std::vector<Blink> between(double from_s, double to_s) const;

  private:
    Blink spontaneous(std::int64_t interval) const noexcept;
    Blink voluntary(std::size_t index) const noexcept;

    BlinkSettings settings_;
    std::uint64_t seed_;
};

}  // namespace aureole::eye
