// Where the gather evaluates a tile, and how the outputs are put together.
#pragma once

#include <array>

#include "ibl/gather_kernels.h"
#include "ibl/tile.h"

namespace aureole::ibl {

GatherTile gather_tile(const Tile& tile, int size);

// Values at 1 to 8 outputs from values at four points between them (Lagrange's polynomials).
struct Interpolation {
    // Position of the points, -1 the first output, 1 the last one.
    static std::array<double, kGroupSide> points();
    explicit Interpolation(int outputs);

    float weight[kTileSide][kGroupSide] = {};
};

// The outputs of `tile` from the sums, multiplied by `scale`. `columns` and `rows` are
// interpolations of tile.width and tile.height outputs.
void store_tile(const TileSums& sums, const Interpolation& columns, const Interpolation& rows,
                float scale, const Tile& tile, CubeMap& out);

}  // namespace aureole::ibl
