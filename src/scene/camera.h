// The camera of a scene: a View placed in the world.
#pragma once

#include <array>
#include <optional>

#include "aureole/image/view.h"
#include "scene/vec.h"

namespace aureole::scene {

struct Pixel {
    double x = 0;  // continuous pixel coordinates: pixel i covers [i, i + 1)
    double y = 0;
};

class Camera {
  public:
    // At `position`, looking along +z, turned up by pitch_deg.
    Camera(const View& view, Vec3 position, double pitch_deg);

    // Through a continuous pixel position; the component of the direction along the optical axis
    // is 1, so that t is the depth along it.
    Ray ray(double x, double y) const;
    // Where a point in front of the camera appears, in or out of the picture.
    std::optional<Pixel> project(Vec3 point) const;
    // Where a direction appears, if it is in front of the camera.
    std::optional<Pixel> project_direction(Vec3 direction) const;
    // Depth of a point along the optical axis.
    float depth(Vec3 point) const { return dot(point - position_, ahead_); }
    // Continuous pixel row of the horizon (its direction is level).
    double horizon_y() const;

    const View& view() const { return view_; }
    Vec3 position() const { return position_; }
    // Size of a pixel at depth 1 along the optical axis.
    float pixel_size() const { return static_cast<float>(1 / focal_px_); }

  private:
    View view_;
    Vec3 position_;
    Vec3 up_;
    Vec3 ahead_;
    double focal_px_;
};

// Evenly spread positions within a pixel, [0, 1) each way, the same in every pixel: the R2 sequence
// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"). Index from 0.
std::array<double, 2> sample_offset(int index);

}  // namespace aureole::scene
