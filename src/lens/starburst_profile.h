// How a diffraction pattern depends on direction far from the axis.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/base/buffer.h"

namespace aureole::lens {

// |F|^2 of a square of samples around the axis: sample (half, half) of 2 half x 2 half is the axis.
struct AxisSquare {
    int half = 0;
    Buffer power;
    std::size_t side() const { return 2 * static_cast<std::size_t>(half); }
    float* row(std::size_t j) { return power.data() + j * side(); }
    const float* row(std::size_t j) const { return power.data() + j * side(); }
};

// What an opening with edges does far from the axis: energy per sample p(phi) / rho^3 at rho
// samples from the axis in direction phi. p repeats after a half turn.
class AngularProfile {
  public:
    AngularProfile() = default;  // 0
    // Fitted to the pattern between half of `end` and `end`: the law holds the energy of that ring.
    static AngularProfile of(const AxisSquare& pattern, double end);

    bool empty() const { return bins_.empty(); }
    // Integral of p over the full turn.
    double turn() const;
    void multiply(double factor);
    // What is left of this one when as much of `other` is taken away as it holds in direction phi.
    // Both have been fitted to the same ring. `other` becomes what was taken.
    void take_out(AngularProfile& other, double phi);
    // Mean of p over a square seen from the axis: one whose sides, projected across the line of
    // sight, subtend `side_a` and `side_b` radians (the projection is a trapezium, the convolution
    // of two boxes).
    double over(double phi, double side_a, double side_b) const;

  private:
    explicit AngularProfile(const std::vector<double>& values);
    // p - mean over one bin, its integral and the integral of that. All repeat.
    struct Bin {
        double value, first, second;
    };
    double second_integral(double bins) const;
    std::vector<Bin> bins_;  // bin b is centred on b pi / size
    double mean_ = 0;
};

// The same for the spikes of straight blades, which keep their width instead of their angle.
class SpikeProfile {
  public:
    SpikeProfile() = default;  // 0
    // Spikes in the directions first_rad + k spacing_rad, `width_rad` wide where `profile` was
    // fitted.
    SpikeProfile(AngularProfile profile, double first_rad, double spacing_rad, double width_rad);

    bool empty() const { return profile_.empty(); }
    double turn() const { return profile_.turn(); }
    void multiply(double factor) { profile_.multiply(factor); }
    // As AngularProfile::over, `stretch` times as far out as where the profile was fitted.
    double over(double phi, double side_a, double side_b, double stretch) const;

  private:
    AngularProfile profile_;
    double first_rad_ = 0;
    double spacing_rad_ = 0;
    double width_rad_ = 0;
};

// Samples from the axis of the middle of the ring that a profile was fitted to.
double fitted_at(double end);

}  // namespace aureole::lens
