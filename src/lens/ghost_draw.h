// What the renderers of ghosts are asked to do, and to tell.
#pragma once

namespace aureole::lens {

// One ghost of the list that a renderer was built with.
struct GhostDraw {
    int ghost = 0;              // index into that list
    int level = 0;              // of the canvas
    float gain[3] = {1, 1, 1};  // of R, G, B, tints included
};

// What few exact rays say of a ghost beside its placement: sums over the pixels of the picture and
// RGB, without gains.
struct GhostComparison {
    float energy = 0;       // of the traced ghost
    float difference = -1;  // of |matrix - traced|; negative: not known
};

}  // namespace aureole::lens
