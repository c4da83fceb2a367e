// The picture of lat_long.h as a function on the sphere that is linear between pixels.
#pragma once

#include <vector>

namespace aureole::ibl {

// Coordinates are `column`, in pixels, whole at the middle of a pixel, to the right and round and
// round; and mu = sine of latitude, so that areas are solid angles but for a factor. Values are
// interpolated linearly in column and in mu between the nodes
//
//     mu_r = sin(latitude of the middle of row r) / cos(pi / (2 height)),
//
// which are 1 and -1 for the first and the last row. Halfway between two nodes lies, exactly, the
// border of their rows, so a pixel has the weight of its own solid angle in the integral of the
// interpolated function: it keeps constants and energy at once. The nodes are 1 / (8 r + 4) rows
// from the middle of row r: only the first few rows at the poles are moved noticeably.
// The nodes at the poles have one value, the mean of their row.
struct LatLongGrid {
    LatLongGrid(int width, int height);

    int width = 0;
    int height = 0;
    int strips = 0;                 // between two nodes each; at least one
    std::vector<double> node_mu;    // strips + 1, falling
    std::vector<double> per_strip;  // 1 / (node_mu[r] - node_mu[r + 1])

    // Row whose node is r, for the node at the lower end of a strip too: a picture of one row has
    // a strip of one value.
    int row(int node) const { return node < height ? node : height - 1; }
    double column(double x, double z) const;  // of a direction (x, *, z)
    // The strip that mu is in; a node belongs to either of its strips.
    int strip(double mu) const;

  private:
    double shrink_ = 0;  // cos(pi / (2 height))
};

}  // namespace aureole::ibl
