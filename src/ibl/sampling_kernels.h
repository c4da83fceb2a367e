// The inner loops of the sampling methods.
#pragma once

#include <span>

#include "ibl/bordered_chain.h"
#include "ibl/tile.h"

namespace aureole::ibl {

// One direction about the normal that a texel reads, and where: weights[0] of `level` and, unless
// it is 0, weights[1] of the level after it.
struct LobeTap {
    float x = 0;
    float y = 0;
    float z = 1;
    float weights[2] = {1, 0};
    int level = 0;
};

// What a texel of the reference or of FIS computes its samples from.
struct LobeLoop {
    float alpha = 1;
    int samples = 1;
    // FIS: reads level (log2(w_sample) + level_offset) / 2, at least 0 and at most that of the
    // chain; w_sample is the inverse of the density times `samples`. Else level 0.
    bool filtered = false;
    float level_offset = 0;
};

// RGB0 of a tile's texels, row by row.
struct TileColors {
    alignas(64) float rgb[kTileTexels][kTexelFloats];
};

struct SamplingKernels {
    // The sum of `taps`, the same for each texel of the tile but for its frame.
    void (*sum_taps)(const BorderedChain& chain, std::span<const LobeTap> taps, const Tile& tile,
                     int size, TileColors& out);
    // The document's loop: each texel makes its own samples. The mean by N.L.
    void (*run_loop)(const BorderedChain& chain, const LobeLoop& loop, const Tile& tile, int size,
                     TileColors& out);
};

// Of the best instruction set that this machine has.
SamplingKernels sampling_kernels();

}  // namespace aureole::ibl
