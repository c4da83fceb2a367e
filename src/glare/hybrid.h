// Glare in two parts, k = near + far: the near part by transforms that need little padding, for all
// light; the far part by sprites on its coarse raster, for the light that matters there. What the
// far part of dim light would have been is left out, within the error asked for.
#pragma once

#include <cstddef>

#include "aureole/fourier/convolver.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/far_layer.h"

namespace aureole::glare {

class Hybrid {
  public:
    Hybrid(int width, int height, int channels, double error, const FarKernel& split);

    // Of the energy, what may go without its far part: for BrightnessHistogram::count().
    double dim_share() const;
    // Pixels above it get their far part, of which a share from half of the limit of the histogram
    // up to it.
    float dim_limit(const sources::BrightnessHistogram& histogram) const;

    struct Plan {
        std::size_t sprites = 0;
        double energy = 0;       // sum of w |light|
        double error_bound = 0;  // in the same unit
        double energy_cut = 0;   // light that ends within the picture or beyond it
        SpriteWork work;
    };
    Plan plan(const ConstImageView& light, const float* weights,
              const sources::BrightnessHistogram& histogram);
    // What was planned for the same light. `out` may be the same memory as `light`.
    void draw(const ConstImageView& light, const ImageView& out, const float* weights) noexcept;

    const fourier::Convolver& convolver() const { return convolver_; }
    fourier::Convolver& convolver() { return convolver_; }
    FarLayer& far() { return far_; }

  private:
    double error_;
    FarLayer far_;
    fourier::Convolver convolver_;
    std::size_t planned_ = 0;  // sprites
};

}  // namespace aureole::glare
