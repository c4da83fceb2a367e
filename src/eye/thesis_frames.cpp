#include "aureole/eye/thesis_frames.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "eye/time_range.h"

namespace aureole::eye {
namespace {

constexpr int kLast = kThesisFrames - 1;
constexpr double kMeanPupilMm = 4.9;
constexpr double kPupilSwingMm = 3;
constexpr double kLensSwing = 0.05;

std::int64_t positive_remainder(std::int64_t value, std::int64_t period) {
    return ((value % period) + period) % period;
}

// -1 to 1.
double swing(int page) { return std::sin(kPi * (static_cast<double>(page) / kLast - 0.5)); }

int page_at(double swing) {
    return static_cast<int>(
        std::lround(kLast * (std::asin(std::clamp(swing, -1.0, 1.0)) / kPi + 0.5)));
}

}  // namespace

int thesis_ping_pong(std::int64_t step) noexcept {
    constexpr int kPeriod = 2 * kLast;
    const auto phase = static_cast<int>(positive_remainder(step, kPeriod));
    return phase <= kLast ? phase : kPeriod - phase;
}

ThesisFrames thesis_frames(std::int64_t frame) noexcept {
    const std::int64_t phase = positive_remainder(frame, kThesisRepeat);
    return {thesis_ping_pong(phase), thesis_ping_pong(phase + kThesisGratingsOffset),
            static_cast<int>(phase % kThesisFrames), thesis_ping_pong(phase / kThesisLidsSlowness)};
}

std::int64_t thesis_frame_at(double time_s) noexcept {
    // n / 30 is not exact in binary.
    constexpr double kRounding = 1e-6;
    return static_cast<std::int64_t>(
        std::floor(nearest_moment_s(time_s) * kThesisFramesPerSecond + kRounding));
}

double thesis_pupil_mm(int page) noexcept { return kMeanPupilMm + kPupilSwingMm * swing(page); }
int thesis_pupil_page(double diameter_mm) noexcept {
    return page_at((diameter_mm - kMeanPupilMm) / kPupilSwingMm);
}
double thesis_lens_scale(int page) noexcept { return 1 + kLensSwing * swing(page); }
double thesis_lid_closure(int page) noexcept { return 0.5 * (1 + swing(page)); }
int thesis_lid_page(double closure) noexcept { return page_at(2 * closure - 1); }

}  // namespace aureole::eye
