// The outlines of a block of texels of a cube, as weighted places in a picture of the sphere.
//
// The integral of the picture L over a texel is one along its outline (Green's theorem),
//
//     integral of L dcolumn dmu = contour integral of Q dmu,   Q = integral of L dcolumn,
//
// Q being the running sum of a row. Outlines are cut where they cross from one strip into the
// next; on each piece, Q is taken in the middle, or at two points about it. As Q is linear in mu
// within a strip, what is equal on both sides of a texel (all that lies to its left) cancels
// exactly; and as neighbours share their border with opposite signs, one gains what the other loses
// by approximation: the energy of the whole is exact.
#pragma once

#include <vector>

#include "ibl/lat_long_grid.h"
#include "ibl/rotation.h"
#include "ibl/tile.h"

namespace aureole::ibl {

// Of one piece of an outline.
struct OutlinePoint {
    double column = 0;    // not wrapped: outlines are continuous
    double weight = 0;    // of Q there: its length in mu, with sign
    double fraction = 0;  // from the upper node of its strip, 0, to the lower one, 1
    int strip = 0;
};

// A border: points [first, end), to be added to cell `plus` and taken from cell `minus`; -1: none.
struct OutlineRun {
    int first = 0;
    int end = 0;
    int plus = -1;
    int minus = -1;
};

// Cells are numbered row by row. All signs are those of one sense of rotation, which mirroring
// reverses; a mean, integral over area, does not depend on it.
class Outlines {
  public:
    Outlines(const LatLongGrid& grid, const Rotation& rotation)
        : grid_(grid), rotation_(rotation) {}

    // Fills points and runs for the part of the block in strips [first_strip, end_strip).
    void trace(const Tile& block, int size, int first_strip, int end_strip);

    const std::vector<OutlinePoint>& points() const { return points_; }
    const std::vector<OutlineRun>& runs() const { return runs_; }

  private:
    struct Vertex {
        Direction direction;  // in the picture, unit
        double per_radius2;   // 1 / (x^2 + z^2); 0 at a pole, where columns do not change
        double column;
        int strip;
    };
    Vertex vertex(const Direction& unit) const;
    void trace_borders(const Tile& block, double edge);
    void trace_cells(const Tile& block, double edge);
    void add_border(const Vertex& a, const Vertex& b, double edge, int plus, int minus);
    void divide(const Vertex& a, const Vertex& b, double edge);
    void add_arc(const Vertex& a, const Vertex& b, double sign);
    void add_monotonic(const Vertex& a, const Vertex& b, const Direction& along, double sign);
    void cut_to_pole(double mu, double column, bool north, int turns);
    // `share` of the piece from mu0 to mu1 in strip r, at `place` between the two.
    void push(double column, double mu0, double mu1, double place, double share, int r,
              double sign);

    const LatLongGrid& grid_;
    const Rotation& rotation_;
    int first_strip_ = 0;
    int end_strip_ = 0;
    std::vector<Vertex> vertices_;
    std::vector<Vertex> divided_;
    std::vector<OutlinePoint> points_;
    std::vector<OutlineRun> runs_;
};

// The part of the sphere that a block lies in: a circle about its centre, and the strips that it
// may reach.
struct BlockBounds {
    Direction centre;  // in the picture
    double radius_rad = 0;
    int first_strip = 0;
    int end_strip = 0;
    // It may hold a pole of the picture, or touch it.
    bool polar() const;
};
BlockBounds bounds_of(const Tile& block, int size, const LatLongGrid& grid,
                      const Rotation& rotation);

}  // namespace aureole::ibl
