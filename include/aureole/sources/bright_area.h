// How much of a picture is bright, and how much of that is edge: what drawing it light by light
// will cost, before clusters are looked for.
#pragma once

#include "aureole/image/image.h"
#include "aureole/sources/brightness_histogram.h"

namespace aureole::sources {

// Of what is above a limit.
struct BrightArea {
    double blocks = 0;  // of BrightnessHistogram::kBlockSide^2 pixels, with such pixels
    double pixels = 0;
    // Those of them with a neighbour in the same block, sideways or up and down, that is not:
    // pixels that no cluster of even cells takes in.
    double edge_pixels = 0;
};

// `histogram`: has looked at the same light. With `block_step` > 1 an estimate, from one of so many
// blocks. The same for any number of threads.
BrightArea bright_area(const ConstImageView& light, const BrightnessHistogram& histogram,
                       float limit, int block_step = 1);

}  // namespace aureole::sources
