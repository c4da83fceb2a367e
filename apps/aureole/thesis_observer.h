// The eye of the thesis: a look, whose parts turn the pages of their books.
#pragma once

#include <optional>

#include "aureole/eye/thesis_glare.h"
#include "eye_options.h"
#include "motion_options.h"
#include "observer.h"
#include "session.h"
#include "view_options.h"

namespace aureole::app {

class ThesisObserver : public Observer {
  public:
    // `moving`: pages turn with the time of each picture; otherwise the eye is at rest.
    // Throws InvalidArgument for options that the look does not know.
    ThesisObserver(const EyeOptions& eye, const MotionOptions& motion, const ViewOptions& view,
                   bool moving, Session& session);
    // When frame `number` of a sequence is seen that has no time: a page each.
    static double time_of_frame(int number);

    void set_time(double time_s) override { time_s_ = time_s; }
    View view_of(const io::Picture& picture) override;
    bool adapt(const io::Picture& picture) override;
    Spreading spreading(const View& display, const View& data) override;
    double gain() const override { return energy_; }
    void report(nlohmann::ordered_json& json) const override;

  private:
    void note_clamped(double pupil_mm);

    const EyeOptions& options_;
    const ViewOptions& view_options_;
    bool moving_;
    bool lids_move_;
    Session& session_;
    View view_;
    double time_s_ = 0;
    double white_luminance_cd_m2_ = 0;
    std::optional<double> pupil_mm_;  // asked for, in place of its page by time
    std::optional<eye::ThesisFrames> frames_;
    eye::ThesisLook look_;
    double energy_ = 0;
};

}  // namespace aureole::app
