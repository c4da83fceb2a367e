#include "aureole/sources/light.h"

#include <fmt/format.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "sources/light_geometry.h"

namespace aureole::sources {
namespace {

constexpr const char* kBehind = "the light is behind the camera: must be below 90 deg off the axis";

void check_radiance(const std::array<float, 3>& radiance) {
    for (const float value : radiance) {
        if (!(value >= 0) || !std::isfinite(value)) {
            throw InvalidArgument("radiance",
                                  fmt::format("{},{},{}", radiance[0], radiance[1], radiance[2]),
                                  "must be finite and not negative");
        }
    }
}

Light disc(double tan_x, double tan_y, const std::array<float, 3>& radiance, double diameter_deg,
           double point_solid_angle_sr) {
    check_radiance(radiance);
    if (!(diameter_deg >= 0 && diameter_deg < 90)) {
        throw InvalidArgument("diameter of the light (deg)", fmt::format("{}", diameter_deg),
                              "must be in [0, 90)");
    }
    Light light;
    light.tan_x = tan_x;
    light.tan_y = tan_y;
    light.radiance = radiance;
    light.solid_angle_sr = point_solid_angle_sr;
    if (diameter_deg > 0) {
        // sin^2(a/2) in place of (1 - cos a) / 2, which loses all digits of a small a.
        const double half_sine = std::sin(rad_from_deg(diameter_deg) / 4);
        const double versine = 2 * half_sine * half_sine;  // 1 - cos a
        light.solid_angle_sr = 2 * kPi * versine;
        // Half the mean of tan^2 over the cap, a^2 / 4 for a small one.
        const Moments moments = moments_on_tangents(0.5 * versine / (1 - versine), tan_x, tan_y);
        light.moment_xx = moments.xx;
        light.moment_xy = moments.xy;
        light.moment_yy = moments.yy;
    }
    return light;
}

}  // namespace

PixelGeometry::PixelGeometry(const View& view)
    : perspective_(view.projection == Projection::kPerspective),
      pixel_(1 / view.focal_length_px()),
      axis_x_(view.axis_x),
      axis_y_(view.axis_y) {
    if (!(view.pitch_deg > 0) || (perspective_ && !(view.pitch_deg < 90)) ||
        !std::isfinite(view.pitch_deg)) {
        throw InvalidArgument("pitch of the view (deg)", fmt::format("{}", view.pitch_deg),
                              "must be positive, and below 90 in perspective");
    }
}

double luminous_energy(const Light& light) {
    return light.solid_angle_sr * (0.2126 * static_cast<double>(light.radiance[0]) +
                                   0.7152 * static_cast<double>(light.radiance[1]) +
                                   0.0722 * static_cast<double>(light.radiance[2]));
}

Light light_at(const View& view, double x, double y, std::array<float, 3> radiance,
               double diameter_deg) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
        throw InvalidArgument("position of the light", fmt::format("{},{}", x, y),
                              "must be finite");
    }
    const PixelGeometry geometry(view);
    PixelRay ray;
    if (!geometry.ray(x, y, ray)) {
        throw InvalidArgument(
            "position of the light",
            fmt::format("{},{} ({:.6g} deg off the axis)", x, y, view.angle_from_axis_deg(x, y)),
            kBehind);
    }
    const double pixel = geometry.pixel_tangent();
    return disc(ray.tan_x, ray.tan_y, radiance, diameter_deg, pixel * pixel);
}

Light light_in_direction(double right_deg, double up_deg, std::array<float, 3> radiance,
                         double diameter_deg, double pixel_solid_angle_sr) {
    if (!(std::abs(right_deg) < 90) || !(std::abs(up_deg) < 90)) {
        throw InvalidArgument("direction of the light (deg)",
                              fmt::format("{},{}", right_deg, up_deg), kBehind);
    }
    if (!(pixel_solid_angle_sr > 0) || !std::isfinite(pixel_solid_angle_sr)) {
        throw InvalidArgument("solid angle of a pixel (sr)",
                              fmt::format("{}", pixel_solid_angle_sr),
                              "must be positive and finite");
    }
    return disc(std::tan(rad_from_deg(right_deg)), std::tan(rad_from_deg(up_deg)), radiance,
                diameter_deg, pixel_solid_angle_sr);
}

PixelPosition position_in(const View& view, const Light& light) {
    const double f = view.focal_length_px();
    double scale = f;
    if (view.projection == Projection::kConstantPitch) {
        const double tangent = std::hypot(light.tan_x, light.tan_y);
        if (tangent > 0) scale = f * std::atan(tangent) / tangent;
    }
    return {view.axis_x + scale * light.tan_x, view.axis_y - scale * light.tan_y};
}

}  // namespace aureole::sources
