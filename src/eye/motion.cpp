#include "aureole/eye/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/smoothstep.h"
#include "eye/band_noise.h"
#include "eye/before_pupil.h"
#include "eye/piecewise_linear.h"
#include "eye/pupil_outline.h"
#include "eye/time_range.h"

namespace aureole::eye {
namespace {

// Hippus, eq. 2.13 of the thesis: h = p + noise(t / p) (pmax / p) sqrt(1 - p / pmax). Three octaves
// of noise between .4 and 3.2 cycles per unit of t / p: .05 to 2 Hz for pupils of 8 to 1.6 mm.
constexpr double kWidestMm = 9;
constexpr double kNarrowestRateMm = 1.6;  // narrower pupils would be restless beyond 2 Hz
constexpr double kHippusFromHz = 0.4;
constexpr int kHippusOctaves = 3;
constexpr int kHippusLines = 3;      // per octave
constexpr double kHippusMm = 0.125;  // bound of the noise: at 2 mm half a millimetre in all
constexpr double kMostHippusMm = 0.5;

// Accommodation (Charman & Heron 1988, "Fluctuations in accommodation: a review", Ophthalmic and
// Physiological Optics 8:153): below 0.6 Hz and from 1.0 to 2.3 Hz, within +-0.5 D.
constexpr int kAccommodationLines = 8;
constexpr double kSlowLineD = 0.04;    // 8 of them: at most .32 D, rms .08
constexpr double kFastLineD = 0.0225;  // at most .18 D, rms .045
// Stronger with larger pupils: in proportion, full at
constexpr double kFullAccommodationPupilMm = 8;
// The equator of the lens shrinks by .067 mm per dioptre (Jones, Atchison & Pope 2007, "Changes in
// lens dimensions and refractive index with age and accommodation", Optometry and Vision Science
// 84:990), 9.2 mm across.
constexpr double kLensScalePerD = -0.067 / 9.2;

constexpr double kSquintFromCdM2 = 3000;
constexpr double kSquintFullCdM2 = 30000;

constexpr double kClosedShare = 0.002;
constexpr double kLidRadiusMm = 12;  // wave::lid_opening()

void require(const char* name, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;
    throw InvalidArgument(name, fmt::format("{}", value),
                          fmt::format("must be {} to {}{}", low, high, unit));
}

}  // namespace

double open_share(const Eye& eye) {
    constexpr int kColumns = 512;
    const PupilOutline pupil(eye);
    const Lids lids(eye, pupil, eye.eyelid);
    const double half_width = pupil.half_width_mm();
    double open = 0;
    double all = 0;
    for (int i = 0; i < kColumns; ++i) {
        const double x = half_width * (2 * (i + 0.5) / kColumns - 1);
        const auto [low, high] = pupil.vertical_chord(x);
        const double sag = kLidRadiusMm - std::sqrt(kLidRadiusMm * kLidRadiusMm - x * x);
        all += high - low;
        open +=
            std::max(0.0, std::min(high, lids.upper_mm - sag) - std::max(low, lids.lower_mm + sag));
    }
    return open / all;
}

struct LivingEye::Impl {
    Impl(const Eye& eye, MotionSettings motion, LuminanceCurve curve);

    double mean_pupil_mm(double luminance_cd_m2) const {
        return settings.mean_pupil_mm.value_or(
            pupil_diameter_mm(settings.pupil_model, luminance_cd_m2, settings.pupil_conditions));
    }
    double hippus_phase(double time_s) const noexcept;
    double hippus_mm(double time_s, double pupil_mm) const noexcept;
    void close_lids(Moment& moment, double lid) const noexcept;

    Eye rest;
    MotionSettings settings;
    LuminanceCurve adaptation;
    Blinks blinks;
    BandNoise hippus;
    BandNoise slow_accommodation;
    BandNoise fast_accommodation;
    // 1 / p at the times of the curve, and its integral from the first of them.
    std::vector<double> rates;
    std::vector<double> phases;
};

LivingEye::Impl::Impl(const Eye& eye, MotionSettings motion, LuminanceCurve curve)
    : rest(eye),
      settings(std::move(motion)),
      adaptation(std::move(curve)),
      blinks(settings.blinks, eye.seed) {
    check(rest);
    check(settings.vitreous);
    require("hippus", settings.hippus, 0, 1, "");
    require("accommodation", settings.accommodation, 0, 1, "");
    require("squint", settings.squint, 0, 0.8, "");
    if (settings.mean_pupil_mm) require("pupil", *settings.mean_pupil_mm, 1, 9, " mm");

    Random random(rest.seed, kHippusStream);
    double amplitude = 1;
    double bound = 0;
    for (int octave = 0; octave < kHippusOctaves; ++octave, amplitude /= 2) {
        bound += kHippusLines * amplitude;
    }
    amplitude = kHippusMm / bound;
    double from_hz = kHippusFromHz;
    for (int octave = 0; octave < kHippusOctaves; ++octave, amplitude /= 2, from_hz *= 2) {
        hippus.add_band(random, from_hz, 2 * from_hz, kHippusLines, amplitude);
    }
    Random slow(rest.seed, kSlowAccommodationStream);
    slow_accommodation.add_band(slow, 0.05, 0.6, kAccommodationLines, kSlowLineD);
    Random fast(rest.seed, kFastAccommodationStream);
    fast_accommodation.add_band(fast, 1.0, 2.3, kAccommodationLines, kFastLineD);

    const auto& times_s = adaptation.times_s();
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        rates.push_back(1 / std::max(mean_pupil_mm(adaptation.at(times_s[i])), kNarrowestRateMm));
        phases.push_back(i == 0 ? 0.0
                                : phases[i - 1] + (rates[i - 1] + rates[i]) / 2 *
                                                      (times_s[i] - times_s[i - 1]));
    }
}

// t / p for a pupil that changes: the integral of dt / p, with 1 / p straight between the times of
// the curve. (t / p itself would race whenever p moves late in a sequence.)
double LivingEye::Impl::hippus_phase(double time_s) const noexcept {
    const auto& times_s = adaptation.times_s();
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s);
    const auto i =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - times_s.begin() - 1, 0));
    const double mean_rate = (rates[i] + value_at(times_s, rates, time_s)) / 2;
    return phases[i] + mean_rate * (time_s - times_s[i]);
}

double LivingEye::Impl::hippus_mm(double time_s, double pupil_mm) const noexcept {
    const double share = std::min(pupil_mm / kWidestMm, 1.0);
    const double deviation = hippus.at(hippus_phase(time_s)) / share * std::sqrt(1 - share);
    return settings.hippus * std::clamp(deviation, -kMostHippusMm, kMostHippusMm);
}

// Lids at `lid`, and the light that is left.
void LivingEye::Impl::close_lids(Moment& moment, double lid) const noexcept {
    Eye open = moment.eye;
    open.eyelid = rest.eyelid;
    moment.eye.eyelid = std::min(lid, std::nextafter(1.0, 0.0));
    const double share = open_share(moment.eye);
    moment.light_share = share / open_share(open);
    moment.closed = share < kClosedShare;
    if (!moment.closed) return;
    // For whoever draws it all the same.
    double narrow = rest.eyelid;
    double shut = moment.eye.eyelid;
    for (int step = 0; step < 40; ++step) {
        moment.eye.eyelid = (narrow + shut) / 2;
        (open_share(moment.eye) < kClosedShare ? shut : narrow) = moment.eye.eyelid;
    }
    moment.eye.eyelid = narrow;
}

LivingEye::LivingEye(const Eye& rest, MotionSettings settings, LuminanceCurve adaptation)
    : impl_(std::make_unique<Impl>(rest, std::move(settings), std::move(adaptation))) {
    if (open_share(at(0).eye) < kClosedShare) {
        throw InvalidArgument("eyelid", fmt::format("{}", rest.eyelid),
                              "leaves no opening; must be smaller");
    }
}
LivingEye::~LivingEye() = default;
LivingEye::LivingEye(LivingEye&&) noexcept = default;
LivingEye& LivingEye::operator=(LivingEye&&) noexcept = default;

Moment LivingEye::at(double time_s) const noexcept {
    time_s = nearest_moment_s(time_s);
    const Impl& own = *impl_;
    const MotionSettings& settings = own.settings;
    Moment moment;
    moment.eye = own.rest;
    moment.adaptation_cd_m2 = own.adaptation.at(time_s);
    moment.mean_pupil_mm = own.mean_pupil_mm(moment.adaptation_cd_m2);
    moment.eye.pupil_diameter_mm = std::clamp(
        moment.mean_pupil_mm + own.hippus_mm(time_s, moment.mean_pupil_mm), 1.0, kWidestMm);

    moment.accommodation_d =
        settings.accommodation * std::min(moment.mean_pupil_mm / kFullAccommodationPupilMm, 1.0) *
        (own.slow_accommodation.at(time_s) + own.fast_accommodation.at(time_s));
    moment.gaze = settings.gaze.at(time_s);
    const Rotation lag = settings.gaze.vitreous_lag(time_s, settings.vitreous);
    Pose& pose = moment.eye.pose;
    pose.lens_scale =
        std::clamp(pose.lens_scale * (1 + kLensScalePerD * moment.accommodation_d), 0.9, 1.1);
    pose.vitreous_yaw_deg = std::clamp(lag.yaw_deg, -90.0, 90.0);
    pose.vitreous_pitch_deg = std::clamp(lag.pitch_deg, -90.0, 90.0);
    pose.vitreous_roll_deg = std::clamp(lag.roll_deg, -90.0, 90.0);

    moment.blink = own.blinks.closure(time_s);
    moment.squint =
        settings.squint * smoothstep(std::log10(kSquintFromCdM2), std::log10(kSquintFullCdM2),
                                     std::log10(moment.adaptation_cd_m2));
    const double squinting = 1 - (1 - own.rest.eyelid) * (1 - moment.squint);
    const double blinking = 1 - (1 - squinting) * (1 - moment.blink);
    pose.lash_closure = std::max(pose.lash_closure, blinking);
    own.close_lids(moment, settings.blinks.streaks_only ? squinting : blinking);
    return moment;
}

}  // namespace aureole::eye
