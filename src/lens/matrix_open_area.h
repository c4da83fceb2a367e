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
    int clip = -1;  // who it is; -1: the iris
};

struct CommonArea {
    static constexpr int kMaxEdges = 32;
    double area = 0;    // 0: nothing is left
    double middle = 0;  // centroid, along the line
    double low = 0, high = 0;
    int edges = 0;             // how many discs bound it; at most kMaxEdges are told
    int edge[kMaxEdges] = {};  // LineDisc::clip of those
};

// The area that discs, sorted by rising centre, have in common. `scratch` has room for as many.
CommonArea common_area(std::span<const LineDisc> discs, std::span<LineDisc> scratch) noexcept;

// The part of the iris within clips of any kind, in iris units, by quadrature: to 1e-3 of the unit
// disc where edges are sharp, to 5e-3 where 20 x 20 points look at smooth corners or pictures.
struct OpenArea {
    double area = 0;  // weighted by transmission
    double middle_u = 0, middle_v = 0;
};
OpenArea open_area(const Pupil& pupil, const Entrance& entrance,
                   std::span<const MatrixGhost::Clip> clips) noexcept;

}  // namespace aureole::lens
