// The SIMD part of drawing: meshes of rays as light on pixels.
//
// A mesh is a grid of rays with what they carry to the sensor. Its cells are divided until each
// piece is at most a pixel wide, positions following cubics through the rays (Catmull & Rom 1974),
// and each piece puts its share of the cell's energy on the pixels under it. So energy is kept
// whatever the map does, folds add up, caustics are antialiased like everything else, and the
// brightness inside is as smooth as the map: there are no facets.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lens/canvas.h"
#include "lens/ray_kernels.h"

namespace aureole::lens {

inline constexpr int kGroup = 16;  // cells along a row that are drawn together

// Cells [column, column + kGroup) of a row that have light to draw.
struct MeshGroup {
    std::int16_t row = 0;
    std::int16_t column = 0;
    std::int16_t pieces_i = 1;             // each cell is divided into so many along a row ...
    std::int16_t pieces_j = 1;             // ... and across
    bool masked = false;                   // some aperture may cut through
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // bounds of what they draw on, pixels of the level
};

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
    float* clip = nullptr;   // see RayFields
    float* power = nullptr;  // energy per cell, in pixels of the level times radiance
    float* share = nullptr;  // by cell: 1 to be drawn, 0 not
    // Entrance position of vertex (0, 0), and steps between vertices, mm.
    float entrance_x = 0, entrance_y = 0, entrance_step_x = 0, entrance_step_y = 0;
};
inline constexpr int kMeshPadding = 3 * kGroup;  // floats behind the last row that may be read

// What kind of cells a mesh has.
enum CellState : std::uint8_t {
    kCellDead = 0,  // nothing passes, or outside the picture
    kCellDrawn = 1,
    kCellRefined = 2,  // to be traced again more finely
};

struct ClassifyOptions {
    float inner_radius = 1;                // within it the iris is open; below 0: never
    float outer_radius = 1;                // beyond it, closed
    float blur_px = 0;                     // pieces reach so much farther
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // of the level that can be drawn on, pixels
    float tolerance_px = 0.25F;            // cells whose cubic may be farther off are refined
};

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

// Part of one plane, light of one colour. Pixel (x, y) of the level is at
// sums[(y - y0 + 1) * stride + x - x0 + 1]: there is a rim of one pixel that is not kept.
struct MeshTile {
    float* sums = nullptr;
    std::ptrdiff_t stride = 0;
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

struct MeshKernels {
    // Finds what is to be drawn of a mesh with all vertex arrays filled: `state` by cell (columns x
    // rows), shares, and groups, of which there are at most rows * (columns / kGroup + 1). Returns
    // their number.
    int (*classify)(const Mesh& mesh, const ClassifyOptions& options, std::uint8_t* state,
                    MeshGroup* groups);
    void (*draw)(const Mesh& mesh, const MeshGroup& group, const PieceMask& mask,
                 const MeshTile& tile);
    // plane[x] += weight * sums[x], and zeroes sums.
    void (*flush)(float* sums, int count, const float weight[3], float* const planes[3]);
    // to[x] += the sum over k of weights[k] from[x + k], k in [0, taps).
    void (*blur)(const float* from, const float* weights, int taps, int count, float* to);
};

const MeshKernels& mesh_kernels();

}  // namespace aureole::lens
