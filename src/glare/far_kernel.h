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
    // What stands for far on the raster (raster.h): pixel (x, y) is `scale` (x - width / 2,
    // y - height / 2) fine pixels from the source. scale^2 times its sum is the sum of far.
    Image coarse;
    // Of far, in fine pixels.
    sources::KernelRoughness roughness;
    // How far what is drawn, bilinear in the positions of source and pixel, is from far: sum of
    // |difference| per energy, the largest over colours and places of the source within a coarse
    // pixel (a grid of 2 x 2 of them).
    double error = 0;
};

// The split whose far part is the cheapest to draw, with an error of at most `most_error`; nothing
// if there is none, or the kernel is too small for one to pay.
std::optional<FarKernel> find_far_kernel(const ConstImageView& kernel, double most_error);
// With a given scale, for transforms: a near part of 256 pixels if that will do.
std::optional<FarKernel> find_far_kernel(const ConstImageView& kernel, int scale,
                                         double most_error);

}  // namespace aureole::glare
