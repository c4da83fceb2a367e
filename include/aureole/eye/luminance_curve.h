// Luminance over time, and how the eye's adaptation lags behind it.
#pragma once

#include <vector>

namespace aureole::eye {

// Luminances at given times. Their logarithms are joined by straight lines; the first and the last
// hold before and after. Luminances below kDarknessCdM2 are taken as that (ranges.h).
class LuminanceCurve {
  public:
    // The same at all times.
    explicit LuminanceCurve(double luminance_cd_m2);
    // As many luminances as times, one at least; times ascend, within kFarthestTimeS of 0.
    // Both throw InvalidArgument for anything else, and for luminances outside 0 to kBrightestCdM2.
    LuminanceCurve(std::vector<double> times_s, const std::vector<double>& luminances_cd_m2);

    double at(double time_s) const noexcept;  // cd/m2

    const std::vector<double>& times_s() const noexcept { return times_s_; }
    const std::vector<double>& log10_luminances() const noexcept { return log10_luminances_; }

  private:
    std::vector<double> times_s_;
    std::vector<double> log10_luminances_;
};

// The pupil light reflex as a delay and lags of first order. Constriction is about three times as
// fast as dilation (Ellis 1981, "The pupillary light reflex in normal subjects", British Journal of
// Ophthalmology 65:754; so modelled by Pamplona, Oliveira & Baranoski 2009, "Photorealistic models
// for pupil light reflex and iridal pattern deformation", ACM TOG 28:106). The delay falls with
// luminance in reality (Lee, Cohen & Boynton 1969, JOSA 59:97: .2 to .5 s); here it is constant.
struct PupilReflex {
    double delay_s = 0.2;         // 0 to 2
    double constriction_s = 0.3;  // time constant while luminance rises, 0.01 to 60
    double dilation_s = 0.9;      // while it falls, constriction_s to 60
};

// Throws InvalidArgument that names the first value outside the ranges above.
void check(const PupilReflex& reflex);

// The luminance that the pupil answers to at a time:
//     log10 L_d(t) = max over T in {constriction, dilation} of
//                    integral from 0 to infinity of e^(-u/T) / T log10 L(t - delay - u) du
// In the logarithm, because the diameter is nearly linear in it: the diameter itself then rises and
// falls with these time constants. Where light rises the faster lag is the larger one and counts,
// where it falls the slower one. Both integrals have closed forms (the curve is made of straight
// lines), so that any time can be asked for, in any order.
double damped_luminance_cd_m2(const LuminanceCurve& curve, double time_s,
                              const PupilReflex& reflex = {}) noexcept;

}  // namespace aureole::eye
