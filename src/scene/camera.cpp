#include "scene/camera.h"

#include <cmath>

#include "aureole/base/units.h"

namespace aureole::scene {

Camera::Camera(const View& view, Vec3 position, double pitch_deg)
    : view_(view), position_(position), focal_px_(view.focal_length_px()) {
    const auto sine = static_cast<float>(std::sin(rad_from_deg(pitch_deg)));
    const auto cosine = static_cast<float>(std::cos(rad_from_deg(pitch_deg)));
    up_ = {0, cosine, -sine};
    ahead_ = {0, sine, cosine};
}

Ray Camera::ray(double x, double y) const {
    const auto u = static_cast<float>((x - view_.axis_x) / focal_px_);
    const auto v = static_cast<float>((view_.axis_y - y) / focal_px_);
    return {position_, Vec3{u, 0, 0} + up_ * v + ahead_};
}

std::optional<Pixel> Camera::project(Vec3 point) const {
    return project_direction(point - position_);
}

std::optional<Pixel> Camera::project_direction(Vec3 direction) const {
    const double depth = dot(direction, ahead_);
    if (depth < 1e-3 * length(direction)) return std::nullopt;
    return Pixel{view_.axis_x + focal_px_ * direction.x / depth,
                 view_.axis_y - focal_px_ * dot(direction, up_) / depth};
}

double Camera::horizon_y() const { return view_.axis_y + focal_px_ * ahead_.y / ahead_.z; }

std::array<double, 2> sample_offset(int index) {
    const double u = 0.25 + 0.7548776662466927 * index;
    const double v = 0.25 + 0.5698402909980532 * index;
    return {u - std::floor(u), v - std::floor(v)};
}

}  // namespace aureole::scene
