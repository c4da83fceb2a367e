// Where the nodes of a varying PSF look, and how a kernel is cut into parts.
#pragma once

#include <vector>

#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::wave {

// Pixel positions (x, y) of columns x rows nodes, row by row (fourier/kernel_nodes.h).
struct NodePlaces {
    struct Place {
        double x = 0;
        double y = 0;
    };
    int columns = 1;
    int rows = 1;
    std::vector<Place> places;
};
// As many as it takes for neighbours to be at most `spacing_deg` apart, measured on the axis.
NodePlaces node_places(const View& view, double spacing_deg);

// The odd grid that reaches `angle_deg` from the centre, no further than from pixel to pixel of the
// view.
KernelGrid grid_within(const View& view, double angle_deg);

// 1 towards the centre of the grid, falling smoothly to 0 at `end_deg` over the last quarter of
// that, so that no edge shows between what is blended over different nodes.
Image radial_window(const KernelGrid& grid, double end_deg);

// What lies between: 0 where the window to `from_deg` is 1, then rising to 1 as that falls, and
// falling to 0 at `end_deg` as the window to that does.
Image radial_ring(const KernelGrid& grid, double from_deg, double end_deg);

// scale * window * kernel: the middle of a kernel on the window's grid.
Image windowed(const Image& kernel, const Image& window, double scale = 1);

// Takes a part, which is no more than there is, from the middle of a kernel of unit energy and
// gives unit energy to what is left: the base of a varying PSF whose parts hold such a part.
void take_out(Psf& psf, const Image& part);

}  // namespace aureole::wave
