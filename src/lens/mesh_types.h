// A ghost at one wavelength as a mesh: a grid of rays with what they carry to the sensor.
//
// A mesh is drawn in two ways, whose weights add up to 1 everywhere.
//   Facets (mesh_facets.h), where it is smooth and its cells cover some pixels: triangles with
//     linear brightness, sampled at the middles of pixels. Fast, but with hard outlines.
//   Pieces (mesh_pieces.h), elsewhere: at folds and caustics, and where cells are small. Cells are
//     divided until each piece is less than a pixel wide, and each puts its energy on the pixels
//     under it. Exact whatever the map does; folds add up, and all is antialiased.
// The weight of the facets is linear between vertices and 0 at the border between the two, so that
// it cannot be seen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lens/ray_kernels.h"

namespace aureole::lens {

// Vertex (i, j) is at [j * stride + i]; cell (i, j) has vertices i, i + 1 and j, j + 1. Cells on
// the rim, which have no neighbours on one side, are not drawn.
struct Mesh {
    int columns = 0;  // vertices
    int rows = 0;
    std::ptrdiff_t stride = 0;  // floats between rows
    float* x = nullptr;         // pixels of the level
    float* y = nullptr;
    float* u = nullptr;  // iris
    float* v = nullptr;
    float* clip = nullptr;          // see RayFields
    float* power = nullptr;         // energy per cell: radiance times pixels of the level
    float* smooth = nullptr;        // weight of the facets
    float* radiance = nullptr;      // of the facets, weight included
    float* share = nullptr;         // by cell: 1 if drawn by pieces, else 0
    std::uint8_t* state = nullptr;  // by cell, [j * columns + i]: CellState
    // Entrance position of vertex (0, 0), and steps between vertices, mm.
    float entrance_x = 0, entrance_y = 0, entrance_step_x = 0, entrance_step_y = 0;
};
inline constexpr int kMeshFields = 9;

inline constexpr int kGroup = 16;                // cells along a row that are drawn together
inline constexpr int kMeshPadding = 4 * kGroup;  // floats behind the last row that are used up

// Cells [column, column + kGroup) of a row that have light to draw.
struct MeshGroup {
    std::int16_t row = 0;
    std::int16_t column = 0;
    std::int16_t pieces_i = 0;             // each cell is divided into so many along a row, ...
    std::int16_t pieces_j = 0;             // ... and across; 0: facets
    bool masked = false;                   // some cell is kCellMasked
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // bounds of what they draw on, pixels of the level
};

enum CellState : std::uint8_t {
    kCellDead,     // nothing passes, or outside the picture
    kCellOpen,     // drawn; no aperture cuts through
    kCellMasked,   // drawn
    kCellRefined,  // to be traced again more finely
};

// Part of one plane, light of one colour. Pixel (x, y) of the level is at
// sums[(y - y0 + 1) * stride + x - x0 + 1]: there is a rim of one pixel that is not kept.
struct MeshTile {
    float* sums = nullptr;
    std::ptrdiff_t stride = 0;
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

}  // namespace aureole::lens
