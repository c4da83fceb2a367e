// The outer part of a large kernel on a coarse raster: it is smooth there, and most of a sprite's
// area.
#pragma once

#include <optional>

#include "aureole/image/image.h"
#include "aureole/sources/clusters.h"

namespace aureole::glare {

// k = near + far: near ends `near_radius` pixels from the centre, far begins at half of that;
// smooth weights between.
struct FarKernel {
    int scale = 4;        // fine pixels per coarse one
    int near_radius = 0;  // fine pixels
    Image near;           // (2 near_radius + 1) square
    // far at displacements of whole coarse pixels: pixel (x, y) is `scale` (x - width / 2,
    // y - height / 2) fine pixels from the source.
    Image coarse;
    // Of far, in fine pixels.
    sources::KernelRoughness roughness;
    // How far what is drawn, bilinear in the positions of source and pixel, is from far: sum of
    // |difference| per energy, the largest over colours and places of the source within a coarse
    // pixel (a grid of 2 x 2 of them).
    double error = 0;
};

// The cheapest split whose error is at most `most_error`; nothing if there is none, or the kernel
// is too small for one to pay.
std::optional<FarKernel> find_far_kernel(const ConstImageView& kernel, double most_error);

// Weights of the nodes at and right of floor(t), t = (x + 0.5) / scale - 0.5, of linear
// interpolation at fine pixel x of a raster whose node j is the middle of fine pixels
// [scale j, scale (j + 1)).
struct Between {
    int node = 0;
    float right = 0;  // weight of node + 1
};
Between coarse_place(int x, int scale);

}  // namespace aureole::glare
