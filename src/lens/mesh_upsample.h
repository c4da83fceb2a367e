// Finer meshes without more rays.
#pragma once

#include "lens/mesh_types.h"

namespace aureole::lens {

inline constexpr int kMostUpsampling = 4;

// Vertices of a mesh whose cells are divided `factor` x `factor`, 2 to kMostUpsampling.
constexpr int upsampled(int vertices, int factor) { return (vertices - 3) * factor + 3; }

// Fills the vertices of `to`, whose columns and rows are upsampled(), and whose states receive
// those of the cells that they are part of. Cell (1, 1) of both begins at the same vertex: the rim,
// which is not drawn, is as fine as the rest. Positions and power follow cubics (Catmull & Rom
// 1974), which keep them smooth; apertures are linear. What touches a lost ray is lost.
void upsample(const Mesh& from, int factor, Mesh& to);

}  // namespace aureole::lens
