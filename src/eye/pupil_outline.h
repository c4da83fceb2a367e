// The outline of a pupil without its small irregularities, as geometry: a convex curve, symmetric
// under a half turn, around the axis of the eye.
#pragma once

#include "aureole/eye/anatomy.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::eye {

class PupilOutline {
  public:
    explicit PupilOutline(const Eye& eye) noexcept;

    bool round() const { return shape_ == PupilShape::kRound; }
    PupilAxes axes() const { return axes_; }
    wave::Shape shape() const;

    // How far it reaches from the axis to each side, upwards and downwards, and at most.
    double half_width_mm() const { return support_mm(1, 0); }
    double half_height_mm() const { return support_mm(0, 1); }
    double longest_radius_mm() const { return axes_.long_mm / 2; }
    // Distance of the outline in the direction phi, from +x.
    double radius_mm(double phi_rad) const;

    // What a vertical line has inside; nothing if high_mm <= low_mm.
    struct Chord {
        double low_mm = 0;
        double high_mm = 0;
    };
    Chord vertical_chord(double x_mm) const;

  private:
    double support_mm(double direction_x, double direction_y) const;

    PupilShape shape_;  // kRound too for others that have opened that far
    PupilAxes axes_;
    double axis_x_ = 1;  // unit vector of the long axis
    double axis_y_ = 0;
    double disc_radius_mm_ = 0;  // kSlit: of the two discs ...
    double disc_offset_mm_ = 0;  // ... and how far their centres are from the long axis
};

}  // namespace aureole::eye
