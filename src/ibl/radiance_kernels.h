// The SIMD part of building a RadianceTree.
#pragma once

#include "ibl/radiance_tree.h"

namespace aureole::ibl {

struct RadianceKernels {
    // One row of blocks of level 0, `nodes` nodes per side; each texel of the environment is
    // divided into subdivision x subdivision nodes. Returns their light.
    RowLight (*make_leaves)(const CubeMap& environment, int subdivision, int face, int y, int nodes,
                            RadianceBlock* row);
    // One row of blocks of `parents` from those of the level below. `scales`: what the dipole of
    // each channel is multiplied by.
    void (*join_row)(const RadianceLevel& children, const RadianceLevel& parents,
                     const RowLight& scales, int face, int y);
};

const RadianceKernels& radiance_kernels();

}  // namespace aureole::ibl
