// The lobe of one level in the form in which the gather evaluates it, and how far its cut may be
// from the truth.
#pragma once

#include "aureole/ibl/prefilter.h"

namespace aureole::ibl {

// With q = 1 + scale |N - L|^2 / 2, which is 1 in the middle of the lobe, the weight of prefilter.h
// is (but for a constant)
//
//     w(q) = (c0 - c1 q) / q^2      while N.L = c0 - c1 q > 0.
//
// For alpha = 1 the lobe is the cosine alone.
enum class LobeShape { kNarrow, kWide, kCosine };

struct GatherLobe {
    LobeShape shape = LobeShape::kWide;
    float scale = 1;  // (1 - a^2) / (2 a^2)
    float c0 = 1;
    float c1 = 0;
    float total = 0;  // the integral of w over the hemisphere
    // |N - L|^2 is never nearer to a pole of w than this.
    float pole = 0;

    // A node is opened when its size^2 (solid angle) exceeds this many q / scale...
    float most_spread = 0;
    float most_relative = 0;
    float most_interpolation_error = 0;
    // ...or when an estimate of what is neglected exceeds these, in units of total x the mean
    // luminance of the environment: beyond second order, and at the horizon.
    float most_error = 0;
    float most_horizon_error = 0;
    // Nodes farther than this many tile radii are evaluated at 4 x 4 points of a tile and
    // interpolated.
    float interpolation = 0;
};

GatherLobe gather_lobe(double alpha, FilterQuality quality);

}  // namespace aureole::ibl
