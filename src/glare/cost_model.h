// What the ways of applying glare will cost on this machine, before one is chosen.
#pragma once

#include "aureole/fourier/convolver.h"
#include "glare/sprite_layer.h"

namespace aureole::glare {

// Seconds per unit of work, with the threads there are.
struct MachineSpeed {
    double histogram = 0;  // pixel of 3 channels looked at
    double search = 0;     // block of pixels (BrightnessHistogram) with bright ones
    double tile = 0;       // pixel of 3 channels drawn by nothing but its tile
    double far = 0;        // the same for what a far layer adds
    double core = 0;       // pixel of a core, 3 channels
    double one_tap = 0;    // pixel of a sprite, 3 channels
    double four_taps = 0;
    double row = 0;  // of a sprite within a tile, beside its pixels
};

// Measured when first asked for, in some 50 ms, and kept for the life of the process, for each
// number of threads apart. To be called from several threads at once.
const MachineSpeed& machine_speed();

// Transforms are timed themselves: what they cost depends on sizes and caches in ways that no
// formula tells. The less of two runs.
double transform_seconds(fourier::Convolver& convolver);

double drawing_seconds(const MachineSpeed& speed, const SpriteWork& work, int channels);

// Seconds of a steady clock; only differences mean anything.
double clock_seconds();

}  // namespace aureole::glare
