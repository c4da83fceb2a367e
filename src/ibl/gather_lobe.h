// The lobe of one level in the form in which the gather evaluates it, and how far its cut may be
// from the truth.
#pragma once

#include "aureole/ibl/prefilter.h"

namespace aureole::ibl {

enum class LobeShape {
    kNarrow,  // so little of it is at the horizon that nothing needs care there
    kWide,
    kCosine,  // alpha = 1
};

// With q = 1 + scale |N - L|^2 / 2, which is 1 in the middle of the lobe, the weight of prefilter.h
// is (but for a constant)
//
//     w(q) = (c0 - c1 q) / q^2      while N.L = c0 - c1 q > 0;
//
// kCosine is w = N.L.
//
// What is left to choose is the cut, by what it neglects. Errors below are estimates, in units of
// total x the mean luminance of the environment, of what one node adds to the error of an output.
struct GatherLobe {
    LobeShape shape = LobeShape::kWide;
    float scale = 1;  // (1 - a^2) / (2 a^2)
    float c0 = 1;
    float c1 = 0;
    float total = 0;  // the integral of w over the hemisphere

    // A node is opened if scale / q times its solid angle, or times twice its moment, exceeds
    // these: the expansion of w needs small ones, however dark the node is.
    float most_size = 0;
    float most_spread = 0;
    // If the part of its light beyond second order does.
    float most_error = 0;
    // If the first order of w, which vanishes for luminance, but not for each color, does: the
    // slope of w times the dipole of radiance_tree.h, in shares of total / (4 pi) here.
    float most_dipole = 0;
    // If it lies across the horizon, where w has an edge, and this does.
    float most_horizon_error = 0;
    // The weight of a node is interpolated over a tile of radius rho if D^2 = |N - L|^2 + pole,
    // the distance to where w is singular, is at least that many rho^2, and the error less than
    // this: that of four points falls as (rho / D)^4.
    float pole = 0;
    float least_distance2 = 0;
    float most_interpolation_error = 0;
};

// alpha in (0, 1].
GatherLobe gather_lobe(double alpha, FilterQuality quality);

// With errors in units of radiance x solid angle x w.
GatherLobe scaled_to(const GatherLobe& lobe, double mean_luminance);

}  // namespace aureole::ibl
