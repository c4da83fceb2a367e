// The SIMD part of irradiance: one output, the texels of a block as lanes.
#pragma once

#include "ibl/tile.h"

namespace aureole::ibl {

// 8 x 8 texels in the frame of their face; see TexelMoments and TexelSpread. Texels that are not
// there have a solid angle of 0.
struct IrradianceBlock {
    alignas(64) float mean[3][kTileTexels];
    alignas(64) float along_s[3][kTileTexels];
    alignas(64) float along_t[3][kTileTexels];
    alignas(64) float solid_angle_sr[kTileTexels];
};

// Adds the integral of radiance times max(0, N.L) over a block to rgb.
using AddIrradianceOfBlock = void (*)(const IrradianceBlock& block,
                                      const float (&radiance)[3][kTileTexels],
                                      const float (&normal)[3], double (&rgb)[3]);

AddIrradianceOfBlock add_irradiance_of_block();

}  // namespace aureole::ibl
