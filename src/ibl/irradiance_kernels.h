// The SIMD part of irradiance: one output, the texels of a block as lanes.
#pragma once

#include "ibl/tile.h"

namespace aureole::ibl {

// 8 x 8 texels of a face.
struct IrradianceBlock {
    float s = 0;  // middle of the first texel
    float t = 0;
    float side = 0;  // of a texel, in s and t
    // R, G, B, row by row; 0 where there is no texel.
    alignas(64) float radiance[3][kTileTexels];
};

// Adds the integral of radiance times max(0, N.L) over a block to rgb, with N in the frame of the
// face.
using AddIrradianceOfBlock = void (*)(const IrradianceBlock& block, const float (&normal)[3],
                                      double (&rgb)[3]);

AddIrradianceOfBlock add_irradiance_of_block();

}  // namespace aureole::ibl
