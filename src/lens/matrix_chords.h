// What clips leave of an iris with blades, by chords across the line through their centres: fast
// enough for hundreds of ghosts per light.
#pragma once

#include <span>
#include <vector>

#include "aureole/lens/iris.h"
#include "lens/matrix_chord_sums.h"

namespace aureole::lens {

// One of them, in iris units: a disc, or the iris itself, mirrored if the radius is negative.
struct LineClip {
    double center = 0;  // along the line
    double radius = 1;
    bool iris = false;
};

// Along the line, and across it a quarter turn further.
struct OpenChords {
    double area = 0;
    double middle_along = 0, middle_across = 0;  // centroid
};

// An iris as the common area of half planes, seen along one line through its middle. Straight
// blades are these half planes. Curved and rounded ones are replaced by some 40 tangents, whose
// polygon is scaled to the area of the iris: its edge is right to .2 % of the radius.
class IrisChords {
  public:
    // Neither a picture nor round.
    explicit IrisChords(const Iris& iris);

    // The line runs in this direction (unit).
    void turn_to(double along_u, double along_v) noexcept;
    // What lies within the iris and all clips, at most MatrixGhost::kMaxClips; right to .1 % of the
    // unit disc, and to 1 % of what is left.
    OpenChords open(std::span<const LineClip> clips) const noexcept;

    // A half plane normal . (u, v) <= distance.
    struct Line {
        double normal_u, normal_v;
        double distance;
    };

  private:
    std::vector<Line> lines_;  // in order of their angle
    ChordEdges edges_;
    ChordNodes nodes_;
    double low_ = -1, high_ = 1;  // along the line
};

}  // namespace aureole::lens
