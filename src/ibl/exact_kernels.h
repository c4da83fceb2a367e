// The SIMD part of exact filtering: what one environment texel, or a point of one, gives to up to
// 64 outputs at once, one lane each. See exact_filter.cpp for which texel goes where.
#pragma once

#include "ibl/tile.h"

namespace aureole::ibl {

// Texels in the frame of their face: s, t and the face's axis.
struct TexelMoments {
    float mean[3];        // of the unit vectors L over the texel
    float covariance[6];  // of L: ss, tt, aa, st, sa, ta
};
// Half the change of the mean from one side of the texel to the other.
struct TexelSpread {
    float along_s[3];
    float along_t[3];
};
// A point of a texel, relative to the centre of the outputs.
struct LobePoint {
    float offset[3];
    float light[3];  // radiance times solid angle, R, G, B
};

// A multiple of this many outputs is computed.
inline constexpr int kOutputBlock = 16;

struct LobeOutputs {
    int count = 0;  // up to kTileTexels
    float a2 = 1;   // of GgxLobe
    float b = 0;
    // Normals N in the frame of a face, and s^2, t^2, a^2, 2 st, 2 sa, 2 ta of each.
    alignas(64) float normal[3][kTileTexels];
    alignas(64) float square[6][kTileTexels];
    // N - the centre of the outputs, in the frame of the world.
    alignas(64) float offset[3][kTileTexels];
};

struct LobeSums {
    alignas(64) double rgb[3][kTileTexels];
};

// Each adds weight times light over `count` texels or points; `light` has three floats for each.
struct ExactKernels {
    // By the second-order Taylor polynomial of the weight about the mean of the texel.
    void (*whole)(const LobeOutputs& outputs, const TexelMoments* texels, const float* light,
                  int count, LobeSums& sums);
    // The same for texels that the horizons of some outputs may cut.
    void (*cut)(const LobeOutputs& outputs, const TexelMoments* texels, const TexelSpread* spreads,
                const float* light, int count, LobeSums& sums);
    // The weight itself.
    void (*points)(const LobeOutputs& outputs, const LobePoint* points, int count, LobeSums& sums);
};

const ExactKernels& exact_kernels();

}  // namespace aureole::ibl
