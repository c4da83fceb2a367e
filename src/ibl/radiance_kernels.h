// The SIMD part of building a RadianceTree.
#pragma once

#include "ibl/radiance_tree.h"

namespace aureole::ibl {

struct RadianceKernels {
    // One row of blocks of level 0, `nodes` nodes per side; each texel of the environment is
    // divided into subdivision x subdivision nodes. Returns their light.
    RowLight (*make_leaves)(const CubeMap& environment, int subdivision, int face, int y, int nodes,
                            RadianceBlock* row);
};

const RadianceKernels& radiance_kernels();

}  // namespace aureole::ibl
