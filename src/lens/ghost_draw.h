// What the renderers of ghosts are asked to do.
#pragma once

namespace aureole::lens {

// One ghost of the list that a renderer was built with.
struct GhostDraw {
    int ghost = 0;              // index into that list
    int level = 0;              // of the canvas
    float gain[3] = {1, 1, 1};  // of R, G, B, tints included
};

}  // namespace aureole::lens
