// A part of some work that reports as a whole.
#pragma once

#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/progress.h"

namespace aureole::lens {

struct ProgressPart {
    Progress* progress = nullptr;  // null: of no interest to anybody
    std::string_view stage = {};
    double begin = 0, size = 1;  // of the whole

    // This fraction of the part is done. Throws Cancelled if that is asked for.
    void reach(double fraction) const {
        if (progress == nullptr) return;
        if (progress->cancelled()) throw Cancelled();
        progress->report(stage, begin + size * fraction);
    }
    ProgressPart part(double from, double to) const {
        return {progress, stage, begin + size * from, size * (to - from)};
    }
};

}  // namespace aureole::lens
