// What the apertures on the way of a ghost leave open of its iris.
#pragma once

#include <span>

#include "aureole/lens/iris.h"
#include "lens/matrix_ghosts.h"
#include "lens/matrix_pupil.h"

namespace aureole::lens {

// A disc whose centre lies on a line.
struct LineDisc {
    double center = 0;
    double radius = 1;
    int clip = -1;    // who it is; -1: the iris
    double from = 0;  // of bounding_discs(): where on the line it begins to bound
};

// What discs have in common: which of them bound it, from left to right, each from `from` to where
// the next one begins, the last one to `high`.
struct BoundingDiscs {
    std::span<const LineDisc> discs;  // none: nothing is left
    double high = 0;
};

// Of discs sorted by rising centre. `scratch` has room for as many, and holds the result.
BoundingDiscs bounding_discs(std::span<const LineDisc> discs, std::span<LineDisc> scratch) noexcept;

struct CommonArea {
    double area = 0;
    double middle = 0;  // centroid, along the line
};
CommonArea common_area(const BoundingDiscs& bounds) noexcept;

// The part of the iris within clips of any kind, in iris units, by quadrature: to 1e-3 of the unit
// disc where edges are sharp, to 5e-3 where 28 x 28 points look at smooth corners or pictures.
struct OpenArea {
    double area = 0;  // weighted by transmission
    double middle_u = 0, middle_v = 0;
};
OpenArea open_area(const Pupil& pupil, const Entrance& entrance,
                   std::span<const MatrixGhost::Clip> clips) noexcept;
// The same without clips and dirt, exactly.
OpenArea whole_area(const Pupil& pupil);

}  // namespace aureole::lens
