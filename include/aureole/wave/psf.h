// The point spread function that everything downstream uses: an energy kernel on a pixel grid.
#pragma once

#include <array>

#include "aureole/image/image.h"
#include "aureole/image/view.h"

namespace aureole::wave {

// Where the kernel's pixels look: an odd grid whose central pixel is centred on the source.
struct KernelGrid {
    int width = 0;   // odd
    int height = 0;  // odd
    double pitch_deg = 0;
    Projection projection = Projection::kPerspective;

    // The grid that reaches from any pixel of the view to any other: (2 w - 1) x (2 h - 1).
    static KernelGrid full_reach(const View& view);
    // The geometry of a `size` x `size` kernel for pictures seen as `view`. Throws InvalidArgument
    // unless size is odd and positive.
    static KernelGrid square(const View& view, int size);
    // The kernel seen as a picture whose axis is the centre of its central pixel.
    View view() const;
};

// Pixel (x, y, c) of `kernel` is the share of the energy of colour c of a central point source
// that lands in that pixel (not a density). Over the whole sphere each colour sums to 1:
// sum(kernel plane c) + off_kernel_energy[c] == 1.
// Values may be slightly negative in RGB where a spectral colour lies outside the gamut.
struct Psf {
    // 3 channels: linear sRGB, white = (1, 1, 1). Or 9, a matrix: channel 3 j + c is where the
    // light of the primary j (red, green, blue) lands in colour c; it sums to 1 for j == c and to 0
    // else, and its sum over j is the kernel of white.
    Image kernel;
    KernelGrid grid;
    std::array<double, 3> off_kernel_energy = {};  // of white
};

}  // namespace aureole::wave
