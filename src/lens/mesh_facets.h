// The smooth parts of a mesh as triangles with linear brightness.
#pragma once

#include "lens/mesh_mask.h"
#include "lens/mesh_types.h"

namespace aureole::lens {

// Adds the radiance of a group's triangles, weight included, at the middle of each pixel that they
// hold. Triangles that share a side share no pixel and miss none. Apertures are antialiased over a
// pixel.
void draw_facets(const Mesh& mesh, const MeshGroup& group, const MeshMask& mask,
                 const MeshTile& tile);

}  // namespace aureole::lens
