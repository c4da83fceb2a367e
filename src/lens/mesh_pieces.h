// Meshes as pieces of about a pixel.
//
// Positions in a cell follow cubics through the rays (Catmull & Rom 1974), so that brightness is as
// smooth as the map itself; each piece puts its share of the cell's energy on the pixels that a
// rectangle of its size covers. So energy is kept whatever the map does: folds add up, caustics are
// antialiased like everything else.
#pragma once

#include "lens/mesh_types.h"

namespace aureole::lens {

// How light passes a piece where an aperture may cut through it.
struct PieceMask {
    IrisField iris;
    // Null, or the transmission of an iris that is a picture, a texture, dirt on the front: called
    // for `count` pieces with iris and entrance positions and the widths of the pieces there, and
    // multiplied into `light`. `open` tells that the iris is among it, and has no outline of its
    // own.
    void (*extra)(const void* context, const float* u, const float* v, const float* iris_width,
                  const float* entrance_x, const float* entrance_y, float entrance_width, int count,
                  float* light) = nullptr;
    const void* context = nullptr;
    bool open = false;
};

// Adds a group's pieces, weighted by 1 - Mesh::smooth.
void draw_pieces(const Mesh& mesh, const MeshGroup& group, const PieceMask& mask,
                 const MeshTile& tile);

}  // namespace aureole::lens
