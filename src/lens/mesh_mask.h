// How light passes where an aperture may cut through a mesh.
#pragma once

#include "lens/ray_kernels.h"

namespace aureole::lens {

struct MeshMask {
    IrisField iris;
    // Null, or the transmission of an iris that is a picture, a texture, dirt on the front: called
    // for `count` places with iris and entrance positions and the widths of the places there, and
    // multiplied into `light`.
    void (*extra)(const void* context, const float* u, const float* v, const float* iris_width,
                  const float* entrance_x, const float* entrance_y, float entrance_width, int count,
                  float* light) = nullptr;
    const void* context = nullptr;
    bool open = false;  // the iris is among `extra`, and has no outline of its own
};

}  // namespace aureole::lens
