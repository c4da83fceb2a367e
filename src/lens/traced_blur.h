// The shape of a light in a ghost: lights of finite size blur it.
#pragma once

#include <vector>

#include "aureole/lens/lens.h"
#include "aureole/lens/trace.h"
#include "aureole/sources/light.h"

namespace aureole::lens {

// Second central moments in mm^2 on the sensor.
struct BlurMoments {
    double xx = 0, xy = 0, yy = 0;
};

// How the size of a light widens a ghost.
class BlurProbe {
  public:
    BlurProbe(const Lens& lens, double wavelength_nm);

    // How the ghost moves on the sensor as its light moves, differentiated by the light's tangents
    // at a ray that crosses z = 0 at (x, y), and the light's moments carried along. It moves as the
    // light does that passes through one point of the aperture that limits it. Zero if the ray does
    // not arrive.
    BlurMoments moments(const Bounces& ghost, const sources::Light& light, double x_mm,
                        double y_mm);

  private:
    Tracer tracer_;
    std::vector<Face> faces_;
    std::vector<Vector> paths_[5];
};

// An evenly bright ellipse with given second moments as weights of pixels; they sum to 1.
class BlurKernel {
  public:
    static constexpr int kMaxRadius = 12;  // pixels
    static constexpr int kSide = 2 * kMaxRadius + 1;

    // Longer semi-axis of the ellipse, in the unit of the moments.
    static double reach(const BlurMoments& moments);

    // Moments in pixels squared, with a reach of at most kMaxRadius - 1 pixels.
    void set(const BlurMoments& moments);

    int radius() const noexcept { return radius_; }
    // Weights of row dy, from -radius() on.
    const float* row(int dy) const noexcept {
        return weights_ + (dy + kMaxRadius) * kSide + kMaxRadius - radius_;
    }
    // Nonzero weights of row dy: [-half_width, half_width], or -1.
    int half_width(int dy) const noexcept { return half_widths_[dy + kMaxRadius]; }

  private:
    int radius_ = 0;
    float weights_[kSide * kSide] = {};
    int half_widths_[kSide] = {};
};

}  // namespace aureole::lens
