// The order in which light meets the faces of a lens, without making a list of it.
#pragma once

#include "aureole/lens/ghosts.h"

namespace aureole::lens {

// Calls `visit(Step)` for each crossing of the way of `bounces` through `faces` faces, until it
// returns false.
template <class Visit>
void visit_steps(int faces, const Bounces& bounces, Visit&& visit) {
    const bool direct = bounces.direct();
    for (int face = 0; face < (direct ? faces : bounces.far); ++face) {
        if (!visit(Step{face, false, false})) return;
    }
    if (direct || !visit(Step{bounces.far, true, false})) return;
    for (int face = bounces.far - 1; face > bounces.near; --face) {
        if (!visit(Step{face, false, true})) return;
    }
    if (!visit(Step{bounces.near, true, true})) return;
    for (int face = bounces.near + 1; face < faces; ++face) {
        if (!visit(Step{face, false, false})) return;
    }
}

// Throws InvalidArgument unless 0 <= near < far < faces, or the bounces are direct.
void validate_bounces(int faces, const Bounces& bounces);

}  // namespace aureole::lens
