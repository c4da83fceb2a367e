// Integrals along the rows of a picture of the sphere, and what outlines make of them.
#pragma once

#include <vector>

#include "aureole/image/image.h"
#include "ibl/lat_long_grid.h"
#include "ibl/outlines.h"

namespace aureole::ibl {

// Three channels and the area: what a texel's value is the quotient of.
struct CellSum {
    double rgb[3] = {};
    double area = 0;
};

class RunningSums {
  public:
    explicit RunningSums(const LatLongGrid& grid) : grid_(grid) {}

    // Adds to cells[i] the integrals over cell i of `outlines`, moved by `shift` columns. Row y of
    // `rows`, of three planar channels, is that of node first_node + y; all that the outlines touch
    // are there.
    void integrate(const Outlines& outlines, double shift, const ConstImageView& rows,
                   int first_node, CellSum* cells);

  private:
    // At one pixel: the integral from the first pixel of the table to the middle of this one, and
    // the value there. The fourth element pads.
    struct Node {
        double sum[4];
        float value[4];
    };
    void build(const ConstImageView& rows, int first_node, int node, Node* out) const;
    void add_points(const Outlines& outlines, double shift, int first_strip, int end_strip,
                    CellSum* cells) const;

    const LatLongGrid& grid_;
    int first_column_ = 0;
    int columns_ = 0;
    std::vector<Node> table_;
};

}  // namespace aureole::ibl
