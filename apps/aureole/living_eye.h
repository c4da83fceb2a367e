// The eye of the options as it is at a moment.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "aureole/eye/motion.h"
#include "aureole/image/view.h"
#include "eye_options.h"
#include "motion_options.h"

namespace aureole::app {

class LivingEye {
  public:
    // Reads the files that the options name. Throws FileError, InvalidArgument.
    LivingEye(const EyeOptions& eye, const MotionOptions& motion);

    // Looking at a view. `metered_cd_m2` is used if EyeOptions::needs_adaptation().
    eye::Moment at(double time_s, double metered_cd_m2, const View& view);
    // Every value of the moment that at() gave last, and where it came from.
    nlohmann::ordered_json report() const;

  private:
    const EyeOptions& options_;
    const MotionOptions& motion_;
    eye::MotionSettings settings_;
    std::optional<eye::LuminanceCurve> adaptation_;  // none: what is metered
    double time_s_ = 0;
    eye::Moment moment_;
};

}  // namespace aureole::app
