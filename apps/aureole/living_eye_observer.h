// An eye that lives: each picture is seen at a moment of its own.
#pragma once

#include <optional>
#include <string>

#include "aureole/eye/motion.h"
#include "eye_book.h"
#include "eye_options.h"
#include "living_eye.h"
#include "motion_options.h"
#include "observer.h"
#include "session.h"
#include "spread_options.h"
#include "view_options.h"

namespace aureole::app {

// Nothing that a picture leaves behind changes what comes after it: frames may be rendered in any
// order, by any number of runs.
class LivingEyeObserver : public Observer {
  public:
    // Reads the files that the options name; `book` is a flipbook that the PSFs come from, or
    // empty: then each is computed. Throws FileError, InvalidArgument.
    LivingEyeObserver(const EyeOptions& eye, const MotionOptions& motion, const ViewOptions& view,
                      Passes passes, const std::string& book, Session& session)
        : options_(eye),
          living_(eye, motion, session),
          view_options_(view),
          passes_(passes),
          session_(session) {
        if (!book.empty()) book_.emplace(book);
    }

    void set_time(double time_s) override { time_s_ = time_s; }
    View view_of(const io::Picture& picture) override;
    bool adapt(const io::Picture& picture) override;
    Spreading spreading(const View& display, const View& data) override;
    double light_share() const override { return moment_.light_share; }
    void report(nlohmann::ordered_json& json) const override;

  private:
    const EyeOptions& options_;
    LivingEye living_;
    const ViewOptions& view_options_;
    Passes passes_;
    Session& session_;
    std::optional<EyeBook> book_;
    View view_;
    double time_s_ = 0;
    double white_luminance_cd_m2_ = 0;
    eye::Moment moment_;
};

}  // namespace aureole::app
