// The lobe about +Z of a GGX surface seen along its normal, and samples of it.
#pragma once

#include <vector>

#include "aureole/ibl/cube_map.h"
#include "ibl/sample_points.h"

namespace aureole::ibl {

// Alphas below are taken as this: a lobe far narrower than any texel.
inline constexpr double kLeastAlpha = 1e-4;

enum class LobeDensity {
    // Half vectors by D (N.H), as Karis 2013 has them: samples weigh N.L, which may be 0.
    kHalfVector,
    // Light by D (N.L): all samples weigh the same.
    kLight,
};

class Lobe {
  public:
    // alpha in [0, 1].
    Lobe(double alpha, LobeDensity density);

    struct Sample {
        Direction light;  // unit
        double weight = 0;
        double density_per_sr = 0;
    };
    Sample sample(const SquarePoint& point) const noexcept;

  private:
    // y of a half vector with the light above the horizon, from y uniform in [0, 1).
    double light_y(double y) const noexcept;

    double alpha2_ = 1;
    LobeDensity density_ = LobeDensity::kHalfVector;
    // For kLight, at rising y: the integral of N.L from 0 to y.
    std::vector<double> y_;
    std::vector<double> cosine_;
    std::vector<double> integral_;
};

}  // namespace aureole::ibl
