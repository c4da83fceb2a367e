// Meshes as pieces of about a pixel.
//
// Positions in a cell follow cubics through the rays (Catmull & Rom 1974), so that brightness is as
// smooth as the map itself; each piece puts its share of the cell's energy on the pixels that a
// rectangle of its size covers. So energy is kept whatever the map does: folds add up, caustics are
// antialiased like everything else.
#pragma once

#include "lens/mesh_mask.h"
#include "lens/mesh_types.h"

namespace aureole::lens {

// Adds a group's pieces, weighted by 1 - Mesh::smooth.
void draw_pieces(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                 const MeshTile& tile);

}  // namespace aureole::lens
