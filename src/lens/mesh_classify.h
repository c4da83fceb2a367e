// What there is to draw of a mesh, and in which way.
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

struct MeshClassifier {
    // Mesh::state from x, y, u, v, clip.
    void (*classify)(const Mesh& mesh, const ClassifyOptions& options);
    // Weights, radiance and shares from power and states (those still kCellRefined are not drawn),
    // and the groups to draw, at most 2 * rows * (columns / kGroup + 1). Returns their number.
    int (*divide)(const Mesh& mesh, MeshGroup* groups);
};

const MeshClassifier& mesh_classifier();

}  // namespace aureole::lens
