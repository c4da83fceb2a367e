// What there is to draw of a mesh, and where it needs more rays.
#pragma once

#include "lens/mesh_types.h"

namespace aureole::lens {

struct ClassifyOptions {
    float inner_radius = 1;                // within it the iris is open
    float outer_radius = 1;                // beyond it, closed
    bool all_masked = false;               // something other than apertures may be anywhere
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // of the level that can be drawn on, pixels
    // The mesh is upsampled: states hold those of the cells before. None is refined but the parts
    // of those that were.
    bool upsampled = false;
};

// Mesh::state from x, y, u, v, clip.
void classify(const Mesh& mesh, const ClassifyOptions& options);

}  // namespace aureole::lens
