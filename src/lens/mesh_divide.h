// What of a mesh is drawn as facets, and what as pieces.
#pragma once

#include "lens/mesh_types.h"

namespace aureole::lens {

// Weights, radiance and shares from power and states (those still kCellRefined are not drawn), and
// the groups to draw, at most most_groups(). Returns their number.
int divide(const Mesh& mesh, MeshGroup* groups);

constexpr int most_groups(int columns, int rows) { return 2 * rows * (columns / kGroup + 1); }

}  // namespace aureole::lens
