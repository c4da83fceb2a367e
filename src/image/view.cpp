#include "aureole/image/view.h"

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"

namespace aureole {

View View::from_fov(int width, int height, double fov_deg, Projection projection) {
    if (width <= 0 || height <= 0) {
        throw InvalidArgument("picture size", std::to_string(width) + "x" + std::to_string(height),
                              "both must be positive");
    }
    const bool perspective = projection == Projection::kPerspective;
    const bool valid = perspective ? fov_deg > 0 && fov_deg < 180 : fov_deg > 0 && fov_deg <= 360;
    if (!valid) {
        throw InvalidArgument(
            "field of view (deg)", std::to_string(fov_deg),
            perspective ? "must be in (0, 180) for a perspective picture" : "must be in (0, 360]");
    }
    View view;
    view.width = width;
    view.height = height;
    view.projection = projection;
    view.pitch_deg = perspective
                         ? deg_from_rad(std::atan(2 * std::tan(rad_from_deg(fov_deg) / 2) / width))
                         : fov_deg / width;
    view.axis_x = width / 2.0;
    view.axis_y = height / 2.0;
    return view;
}

double View::focal_length_px() const {
    const double pitch = rad_from_deg(pitch_deg);
    return 1.0 / (projection == Projection::kPerspective ? std::tan(pitch) : pitch);
}

double View::angle_from_axis_deg(double x, double y) const {
    const double r = std::hypot(x - axis_x, y - axis_y) / focal_length_px();
    return deg_from_rad(projection == Projection::kPerspective ? std::atan(r) : r);
}

double View::pixel_solid_angle_sr(int x, int y) const {
    const double f = focal_length_px();
    if (projection == Projection::kConstantPitch) return 1 / (f * f);
    const double u = (x + 0.5 - axis_x) / f;
    const double v = (y + 0.5 - axis_y) / f;
    const double secant2 = 1 + u * u + v * v;
    return 1 / (f * f * secant2 * std::sqrt(secant2));
}

double View::horizontal_field_deg() const {
    return angle_from_axis_deg(0, axis_y) + angle_from_axis_deg(width, axis_y);
}

double View::solid_angle_sr() const {
    const double f = focal_length_px();
    if (projection == Projection::kConstantPitch) return width / f * (height / f);
    // The rectangle from the axis to (x, y), signed.
    const auto corner = [f](double x, double y) {
        return std::atan(x * y / (f * std::sqrt(f * f + x * x + y * y)));
    };
    const double left = -axis_x;
    const double right = width - axis_x;
    const double top = -axis_y;
    const double bottom = height - axis_y;
    return corner(right, bottom) - corner(left, bottom) - corner(right, top) + corner(left, top);
}

Image relative_solid_angles(const View& view) {
    Image plane(view.width, view.height, 1);
    const double f = view.focal_length_px();
    parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        float* out = plane.row(y, 0);
        for (int x = 0; x < view.width; ++x) {
            out[x] = static_cast<float>(view.pixel_solid_angle_sr(x, y) * f * f);
        }
    });
    return plane;
}

}  // namespace aureole
