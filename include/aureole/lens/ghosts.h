// Which ways light can take through a lens with two reflections.
#pragma once

#include <vector>

#include "aureole/lens/lens.h"

namespace aureole::lens {

// The faces that reflect: light passes on to `far`, is sent back to `near` < far, and goes on to
// the sensor. Face numbers from 0; users and files count surfaces from 1.
struct Bounces {
    int far = -1;  // -1: no reflection, the image itself
    int near = -1;
    bool direct() const { return far < 0; }
    bool operator==(const Bounces&) const = default;
};

enum class GhostSet {
    kSameSide,  // both reflections in front of the stop or both behind it: the stop is crossed once
                // (the blog)
    kAll,       // every pair of refracting faces: n (n - 1) / 2
};

// In the order of `near`, then `far`. The stop reflects nothing; nor does a face between equal
// indices (at the d line).
std::vector<Bounces> enumerate_ghosts(const Lens& lens, GhostSet set);

// The faces in the order in which light meets them: every crossing, reflecting or not, the stop
// included. `backwards`: light travels towards the scene when it arrives.
struct Step {
    int face = 0;
    bool reflects = false;
    bool backwards = false;
};
std::vector<Step> steps_of(const Lens& lens, const Bounces& bounces);

}  // namespace aureole::lens
