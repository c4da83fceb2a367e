// The diffraction pattern of an iris: its middle as a raster, all that lies beyond as a law.
#pragma once

#include <memory>
#include <vector>

#include "aureole/wave/spectral_psf.h"
#include "lens/starburst_aperture.h"

namespace aureole::lens {

// What an opening with edges does far from the axis: energy per sample p(phi) / rho^3 at rho
// samples from the axis in direction phi. p repeats after a half turn.
class AngularProfile {
  public:
    AngularProfile() = default;
    // Values of p at bins of pi / size radians, bin b around b pi / size.
    explicit AngularProfile(const std::vector<double>& values);

    double mean() const { return mean_; }
    // Mean of p over a square seen from the axis: one whose sides, projected across the line of
    // sight, subtend `side_a` and `side_b` radians (the projection is a trapezium, the convolution
    // of two boxes).
    double over(double phi, double side_a, double side_b) const;

  private:
    struct Bin {
        double value, first, second;  // p - mean, its integral and the integral of that
    };
    double second_integral(double bins) const;
    std::vector<Bin> bins_;
    double mean_ = 0;
};

// Share of the raster in the pattern at rho samples: 1 up to `full`, 0 from `end` on, smooth in
// log rho.
struct Crossover {
    double full = 0;
    double end = 0;
    double raster_share(double rho) const;
};

struct StarburstPattern {
    double extent_mm = 0;
    Crossover crossover;
    wave::PatternIntegral middle;  // energy per sample times raster_share
    AngularProfile beyond;         // for the rest, in the same units
};

// Unit energy over all directions. Consumes the aperture. `end_samples`: where the raster ends, at
// most half of half its width.
StarburstPattern starburst_pattern(StarburstAperture aperture, double end_samples);

}  // namespace aureole::lens
