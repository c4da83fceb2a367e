// What the ways of applying glare cost on this machine: measured, not derived from formulas.
#pragma once

#include "aureole/fourier/convolver.h"
#include "glare/far_layer.h"
#include "glare/sprite_layer.h"
#include "glare/sprite_painter.h"

namespace aureole::glare {

// Seconds per unit of what does not depend on the kernel, for 3 channels, with the threads there
// are.
struct MachineSpeed {
    double search = 0;  // block with bright pixels, searched for clusters
    double pass = 0;    // pixel of the picture, whatever is drawn
    double lit = 0;     // pixel of a tile with light in or around it, in addition
    double core = 0;    // pixel of a core
    double far = 0;     // pixel of the picture to which a far layer is added, in addition
};

// Measured when first asked for, in some 20 ms, and kept for the life of the process, for each
// number of threads apart. To be called from several threads at once.
const MachineSpeed& machine_speed();

// Seconds per unit of SpriteWork. It depends on how much of the layer's kernels the caches hold.
struct DrawingSpeed {
    double one_tap = 0;
    double four_taps = 0;
    double row = 0;
    double seconds(const SpriteWork& work) const {
        return one_tap * work.one_tap_pixels + four_taps * work.four_tap_pixels + row * work.rows;
    }
};
// Draws a few sprites for some ms: replaces those of the layer.
DrawingSpeed drawing_speed(SpriteLayer& layer, int channels);

// Of one sprite, drawn up to a radius in pixels of the layer, if that share of all is between
// pixels.
SpriteWork typical_work(const SpriteLayer& layer, double radius, double between_pixels);

// The less of a few runs.
double transform_seconds(fourier::Convolver& convolver);

// Seconds of a steady clock; only differences mean anything.
double clock_seconds();

}  // namespace aureole::glare
