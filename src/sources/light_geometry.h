// From pixels to tangents of angles, and what that does to the size of small things.
#pragma once

#include <cmath>

#include "aureole/image/view.h"

namespace aureole::sources {

// Second central moments, in squared tangents.
struct Moments {
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double trace() const { return xx + yy; }
};

// Those of something small on the sphere, with the same moment `angular` (rad^2) in every
// direction across the line of sight, seen in direction (tan_x, tan_y). At an angle theta from the
// axis tangents stretch by sec^2(theta) away from the axis and by sec(theta) around it, so that
// J J^T = (1 + t^2) (I + t t^T), t the vector of tangents.
inline Moments moments_on_tangents(double angular, double tan_x, double tan_y) {
    const double scale = angular * (1 + tan_x * tan_x + tan_y * tan_y);
    return {scale * (1 + tan_x * tan_x), scale * tan_x * tan_y, scale * (1 + tan_y * tan_y)};
}

// What find_lights() needs of a pixel.
struct PixelRay {
    double tan_x = 0;
    double tan_y = 0;
    double solid_angle_sr = 0;  // of a pixel centred there
    Moments extent;             // of its square, evenly bright
};

// A view made ready for many pixels.
class PixelGeometry {
  public:
    // Throws InvalidArgument for a pitch that is not positive or, in perspective, not below 90.
    explicit PixelGeometry(const View& view);

    // Of a continuous pixel position. False, and nothing written, for a direction 90 deg or more
    // from the axis.
    bool ray(double x, double y, PixelRay& out) const {
        const double u = (x - axis_x_) * pixel_;
        const double v = (axis_y_ - y) * pixel_;
        const double r2 = u * u + v * v;
        const double square = pixel_ * pixel_ / 12;
        if (perspective_) {
            const double secant2 = 1 + r2;
            out = {u, v, pixel_ * pixel_ / (secant2 * std::sqrt(secant2)), {square, 0, square}};
            return true;
        }
        // Constant pitch: (u, v) is the angle from the axis, in its direction.
        const double theta = std::sqrt(r2);
        if (!(theta < kRightAngle)) return false;
        const double tangent = std::tan(theta);
        const double around = theta > 0 ? tangent / theta : 1;
        const double away = 1 + tangent * tangent;
        const double along = r2 > 0 ? square * (away * away - around * around) / r2 : 0;
        const double across = square * around * around;
        out = {u * around,
               v * around,
               pixel_ * pixel_,
               {across + along * u * u, along * u * v, across + along * v * v}};
        return true;
    }
    // Tangent that a pixel on the axis spans.
    double pixel_tangent() const { return pixel_; }

  private:
    static constexpr double kRightAngle = 1.57079632679489662;
    bool perspective_;
    double pixel_;
    double axis_x_;
    double axis_y_;
};

}  // namespace aureole::sources
