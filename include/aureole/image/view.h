// How the pixels of a picture see the world: from pixels to angles and solid angles.
#pragma once

#include "aureole/image/image.h"

namespace aureole {

enum class Projection {
    // A rectilinear (tan) camera: what renderers and lenses produce. A pixel at distance r from
    // the optical axis looks atan(r / f) away from it, and its solid angle falls as cos^3.
    kPerspective,
    // Every pixel subtends the same angle: right for narrow fields and for plain pixel sums.
    kConstantPitch,
};

// The geometry of one picture. Pixel i covers [i, i + 1) in continuous pixel coordinates.
struct View {
    int width = 0;   // pixels
    int height = 0;  // pixels
    Projection projection = Projection::kPerspective;
    double pitch_deg = 0;  // angle that the pixel on the optical axis subtends
    double axis_x = 0;     // continuous pixel coordinates of the optical axis
    double axis_y = 0;

    // A picture whose optical axis is its centre and whose full width subtends fov_deg:
    // kPerspective: f = (width / 2) / tan(fov / 2) pixels; kConstantPitch: pitch = fov / width.
    // Throws InvalidArgument unless width and height are positive and fov_deg is in
    // (0, 180) for kPerspective, (0, 360] for kConstantPitch.
    static View from_fov(int width, int height, double fov_deg, Projection projection);

    // Pixels per unit tangent (kPerspective) or per radian (kConstantPitch).
    double focal_length_px() const;
    // Angle between the optical axis and the direction of a continuous pixel position, deg.
    double angle_from_axis_deg(double x, double y) const;
    // Solid angle of pixel (x, y), sr. kPerspective: cos^3(theta) / f^2, the midpoint value of
    // the integral over the pixel (relative error below 1 / (4 f^2)). kConstantPitch: pitch^2.
    double pixel_solid_angle_sr(int x, int y) const;
    // Angle that the full width subtends, deg: along the row through the axis.
    double horizontal_field_deg() const;
    // Solid angle of the whole picture, sr: the sum of its pixels' in closed form.
    double solid_angle_sr() const;

    bool operator==(const View&) const = default;
};

// One plane of pixel solid angles relative to that of the pixel on the axis; 1 everywhere for
// kConstantPitch.
Image relative_solid_angles(const View& view);

}  // namespace aureole
