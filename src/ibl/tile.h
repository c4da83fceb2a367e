// The unit of work of all filters: up to 8 x 8 neighbouring texels of one face, and what they
// share.
#pragma once

#include <algorithm>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

inline constexpr int kTileSide = 8;
inline constexpr int kTileTexels = kTileSide * kTileSide;

struct Tile {
    int face = 0;
    int x = 0;  // first texel
    int y = 0;
    int width = 0;  // 1 to kTileSide
    int height = 0;
};

constexpr int tiles_per_side(int size) { return (size + kTileSide - 1) / kTileSide; }
constexpr int tile_count(int size) { return kFaces * tiles_per_side(size) * tiles_per_side(size); }

// Tile `index` of tile_count(size), face by face, row by row.
constexpr Tile tile_at(int index, int size) {
    const int side = tiles_per_side(size);
    const int x = index % side * kTileSide;
    const int y = index / side % side * kTileSide;
    return {index / (side * side), x, y, std::min(kTileSide, size - x),
            std::min(kTileSide, size - y)};
}

}  // namespace aureole::ibl
