// Glare in two parts, k = near + far: the near part by transforms that need little padding, for all
// light; the far part by sprites on its coarse raster, for the light that matters there. What the
// far part of dim light would have been is left out, within the error asked for.
#pragma once

#include <cstddef>
#include <optional>

#include "aureole/fourier/convolver.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/far_layer.h"

namespace aureole::glare {

// The radius of the square around a kernel's centre to which it may be cut so that at most `share`
// of its sum of |k| is lost; and how much is.
struct Crop {
    int radius = 0;
    double lost = 0;
};
Crop crop_of(const ConstImageView& kernel, double share);

// The middle (2 radius + 1) square of a kernel, or what there is of it.
ConstImageView cropped(const ConstImageView& kernel, int radius);

class Hybrid {
  public:
    // `split`: of the kernel, null where it has no far part on a raster. Of the two ways to save
    // padding, the far layer and a kernel that just ends within the error asked for, the one with
    // the smaller transforms is taken; if neither has smaller ones than the whole kernel, then
    // that.
    Hybrid(int width, int height, int channels, const ConstImageView& kernel, double error,
           const FarKernel* split);

    // Of the energy, what may go without its far part: for BrightnessHistogram::count().
    double dim_share() const;
    // Pixels above it get their far part.
    float dim_limit(const sources::BrightnessHistogram& histogram) const;

    struct Plan {
        std::size_t sprites = 0;
        double energy = 0;       // sum of w |light|
        double error_bound = 0;  // in the same unit
        double energy_cut = 0;   // light that ends within the picture or beyond it
        SpriteWork work;
    };
    // With a far layer only.
    Plan plan(const ConstImageView& light, const float* weights,
              const sources::BrightnessHistogram& histogram);
    // What was planned for the same light. `out` may be the same memory as `light`.
    void draw(const ConstImageView& light, const ImageView& out, const float* weights) noexcept;

    const fourier::Convolver& convolver() const { return *convolver_; }
    fourier::Convolver& convolver() { return *convolver_; }
    // Whether there is something to plan: else the result has the same cost for all pictures.
    bool has_far() const { return far_.has_value(); }
    FarLayer* far() { return far_ ? &*far_ : nullptr; }
    // Of the kernel's sum of |k|, what is cut off without a far layer.
    double lost() const { return lost_; }

  private:
    double error_;
    double lost_ = 0;
    std::optional<FarLayer> far_;
    std::optional<fourier::Convolver> convolver_;
    std::size_t planned_ = 0;  // sprites
};

}  // namespace aureole::glare
