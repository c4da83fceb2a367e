// What the ways of applying glare will cost on this machine, before one is chosen.
#pragma once

#include "aureole/fourier/convolver.h"
#include "glare/sprite_layer.h"

namespace aureole::glare {

// Seconds per unit of work, with the threads there are.
struct MachineSpeed {
    double transform = 0;  // transform_work()
    double histogram = 0;  // pixel of 3 channels looked at
    double clusters = 0;   // pixel of 3 channels without bright ones
    double search = 0;     // bright pixel of 3 channels
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

// The operations of a convolution, up to a factor: real columns to and fro, rows of half of the
// frequencies to and fro.
double transform_work(const fourier::Convolver& convolver);

double transform_seconds(const MachineSpeed& speed, const fourier::Convolver& convolver);
double drawing_seconds(const MachineSpeed& speed, const SpriteWork& work, int channels);

// Seconds of a steady clock; only differences mean anything.
double clock_seconds();

}  // namespace aureole::glare
