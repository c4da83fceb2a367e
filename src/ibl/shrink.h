// The environment itself at another size.
#pragma once

#include "aureole/ibl/cube_map.h"
#include "ibl/tile.h"

namespace aureole::ibl {

// Fills one tile of `out` with the mean of `environment` over each texel, weighted by solid angle.
// out.size() <= environment.size(); any ratio: source texels that a texel shares with its neighbour
// count with the shared area.
void shrink_tile(const CubeMap& environment, const Tile& tile, CubeMap& out) noexcept;

}  // namespace aureole::ibl
