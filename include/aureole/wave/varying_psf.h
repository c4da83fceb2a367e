// A point spread function that changes over the picture.
//
//     K(s) = (1 - e(s)) B + V(s),      e(s) = sum of V(s)
//
// B  the part that is the same everywhere, of unit energy
// V  the part that changes: energy kernels at nodes, blended bilinearly (varying_convolver.h)
//
// What V holds is taken from B, colour by colour, so that K has unit energy at every source pixel
// whatever the nodes hold.
#pragma once

#include <vector>

#include "aureole/fourier/kernel_nodes.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::wave {

struct VaryingPsf {
    Psf base;                                 // B
    std::vector<fourier::KernelNodes> parts;  // V, 3 channels
    View view;                                // of the picture over which the nodes are spread
};

// K for a source in pixel (x, y) of the picture, on the grid of B; what the grid cuts off V counts
// as off the kernel.
Psf psf_at(const VaryingPsf& psf, int x, int y);

}  // namespace aureole::wave
