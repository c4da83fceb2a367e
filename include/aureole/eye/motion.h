// The eye in motion: what it is like at any moment.
//
//     const eye::LivingEye living(eye, settings, eye::LuminanceCurve(10));
//     const eye::Moment now = living.at(12.5);
//     psf = eye_psf(now.eye, grid);  and the picture gets now.light_share of its light
//
// A moment is a pure function of the eye, its seed, the settings, the curves and the time: nothing
// is integrated, so that frames may be computed in any order and on any machine. docs/motion.md has
// all equations and their sources.
#pragma once

#include <memory>
#include <optional>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/blinking.h"
#include "aureole/eye/gaze.h"
#include "aureole/eye/luminance_curve.h"
#include "aureole/eye/pupil.h"

namespace aureole::eye {

struct MotionSettings {
    // The mean pupil follows from the adaptation luminance, or is fixed (mm, 1 to 9).
    PupilModel pupil_model = PupilModel::kWatsonYellott;
    PupilConditions pupil_conditions;
    std::optional<double> mean_pupil_mm;
    double hippus = 1;         // scale of the pupil's restlessness, 0 to 1
    double accommodation = 1;  // scale of the lens's, 0 to 1
    Gaze gaze;                 // moves the vitreous
    VitreousMechanics vitreous;
    BlinkSettings blinks;
    // How far lids close against bright light, as Eye::eyelid; 0 to 0.8. They start at 3000 cd/m2
    // (a bright sky) and are there at 30000 (snow in the sun): assumed, no measurement was found.
    double squint = 0.5;
};

struct Moment {
    double adaptation_cd_m2 = 0;
    double mean_pupil_mm = 0;    // without hippus
    double accommodation_d = 0;  // fluctuation, dioptres, > 0 nearer; -0.5 to 0.5
    Rotation gaze;
    double blink = 0;   // 0 open to 1 closed
    double squint = 0;  // 0 to MotionSettings::squint
    // What the lids let through, over what those of the eye at rest do. The picture dims by it.
    double light_share = 1;
    // Ready to be drawn: pupil, lids and pose. Of closed lids it is the last one that has an
    // opening, so that glare fades with light_share and never jumps.
    Eye eye;
    bool closed = false;  // less than 0.2 % of the pupil is open
};

class LivingEye {
  public:
    // `rest` gives everything that does not move, the lids between blinks, and what moves is put on
    // top of: fluctuations multiply pose.lens_scale, and lashes are never less closed than
    // pose.lash_closure. Its pupil and the turns of its vitreous (pose.vitreous_*_deg) are
    // replaced. `adaptation` is the luminance that the pupil answers to, damped already
    // (damped_luminance_cd_m2, `aureole meter`).
    // Throws InvalidArgument for values out of range.
    LivingEye(const Eye& rest, MotionSettings settings, LuminanceCurve adaptation);
    ~LivingEye();
    LivingEye(LivingEye&&) noexcept;
    LivingEye& operator=(LivingEye&&) noexcept;

    // Continuous in time. Times may be negative; beyond kFarthestTimeS of 0 (ranges.h) the eye is
    // as it is there.
    Moment at(double time_s) const noexcept;

  private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

// Share of the pupil's disc that the lids leave open, 0 to 1, by quadrature over its width.
double open_share(const Eye& eye);

}  // namespace aureole::eye
