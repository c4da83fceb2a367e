// The eye of the options as it is at a moment.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "aureole/eye/motion.h"
#include "aureole/image/view.h"
#include "eye_options.h"
#include "motion_options.h"
#include "session.h"

namespace aureole::app {

// Throws InvalidArgument for an eye that cannot be, and for options that contradict each other or
// have no effect, of an eye that lives or is at rest.
void check_eye(const EyeOptions& eye, const MotionOptions& motion);

class LivingEye {
  public:
    // Reads the files that the options name. Throws FileError, InvalidArgument.
    LivingEye(const EyeOptions& eye, const MotionOptions& motion, Session& session);

    // Whether at() depends on `metered_cd_m2`: pupil or lids follow the light, and nothing else
    // tells it. With --fps lids then do not: the luminance would have to be known for every frame.
    bool meters() const;
    // Looking at a view. Notes where a table does not reach to the moment.
    eye::Moment at(double time_s, double metered_cd_m2, const View& view);
    // Every value of the moment that at() gave last, and where it came from.
    nlohmann::ordered_json report() const;

  private:
    const eye::LivingEye& living_for(double metered_cd_m2, const View& view);
    void note_ends(double time_s);

    const EyeOptions& options_;
    const MotionOptions& motion_;
    Session& session_;
    eye::MotionSettings settings_;
    std::optional<eye::LuminanceCurve> adaptation_;  // none: a number, or what is metered
    // The eye of all its moments, as long as it looks at the same view in the same light.
    struct Built {
        View view;
        double luminance_cd_m2;
        eye::LivingEye eye;
    };
    std::optional<Built> built_;
    double time_s_ = 0;
    eye::Moment moment_;
};

}  // namespace aureole::app
