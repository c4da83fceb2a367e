// The SIMD part of the gather: the cut of the tree for one tile, and the sum over it.
//
// Everything works on groups of 16 outputs, a grid of 4 x 4 points of a face: the four quarters of
// a tile, and 16 points from which the tile is interpolated.
#pragma once

#include <cstdint>
#include <vector>

#include "ibl/gather_lobe.h"
#include "ibl/radiance_tree.h"

namespace aureole::ibl {

inline constexpr int kGroupSide = 4;
inline constexpr int kGroup = kGroupSide * kGroupSide;

// s and t of the columns and rows of a group.
struct GatherGrid {
    float s[kGroupSide];
    float t[kGroupSide];
};

inline constexpr int kMostQuarters = 4;

struct GatherTile {
    int face = 0;
    GatherGrid interpolation;  // its corners are those of the tile
    GatherGrid quarters[kMostQuarters];
    int quarter_count = 0;
};

struct GroupSums {
    alignas(64) float r[kGroup];
    alignas(64) float g[kGroup];
    alignas(64) float b[kGroup];
    alignas(64) float length[kGroup];  // of (s, t, 1): what makes it a unit vector
};

// Sums of w(N, L) E(L) over the sphere: those over near nodes at the outputs of each quarter, and
// those over far nodes at the points of interpolation. There they are multiplied by the length, so
// that N, and with it a lobe that is linear in N, is a polynomial of s and t.
struct TileSums {
    GroupSums far;
    GroupSums near[kMostQuarters];
};

// A node of the cut, relative to the middle of a group of outputs.
struct GatherRecord {
    float x, y, z;
    float base;  // q (or, for the cosine, N.L) for an output in the middle of the group
    float r, g, b;
    float variance;  // three times that of L across itself, in the direction of the group
};

// Some of the nodes of one block.
struct BlockRef {
    std::uint32_t place = 0;  // face, row and column of the block
    std::uint16_t level = 0;
    std::uint16_t nodes = 0;  // a bit for each
};

// Lists of fixed length: what is full is summed up and emptied.
struct GatherScratch {
    static constexpr int kRecords = 1024;
    static constexpr int kDeferred = 512;
    // Roots, and three blocks more per level on the way down.
    static constexpr int kStack = 128;
    alignas(64) GatherRecord far[kRecords];
    alignas(64) GatherRecord near[kRecords];
    BlockRef deferred[kDeferred];
    BlockRef stack[kStack];
    BlockRef near_stack[kStack];
};

struct GatherKernels {
    void (*gather)(const std::vector<RadianceLevel>& levels, const GatherLobe& lobe,
                   const GatherTile& tile, GatherScratch& scratch, TileSums& sums);
};

const GatherKernels& gather_kernels();

}  // namespace aureole::ibl
