// Glare drawn as sprites: the kernel of each bright pixel, or of each cluster of them, added to the
// picture (Kakimoto et al. 2004, "Glare Generation Based on Wave Optics"; Sikachev et al. 2008,
// whose clusters are those of sources/clusters.h). The cost goes with the number of lights and the
// area that each of them reaches, not with the size of the picture.
//
// The result is that of the convolution out(x) = sum over s of w(s) light(s) k(x - s) / w(x) to
// within `error`: the sum over pixels and channels of w |difference|, over the sum of w |light|.
// The error is shared out: half to clusters, a quarter to light that is too dim to be drawn and
// stays where it is, a quarter to the ends of sprites. docs/sprites.md derives the bounds.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "aureole/image/image.h"
#include "aureole/sources/clusters.h"

namespace aureole::glare {

struct SpriteOptions {
    // In (0, 1). With Criterion::kSimilarColor it bounds what is left out and cut off, while the
    // error of clusters has no bound.
    double error = 0.01;
    // Criterion and sides; its `error` and, unless it is above 0, its `dim_limit` come from the
    // error above.
    sources::ClusterOptions clusters;
};

struct SpriteReport {
    std::size_t bright_pixels = 0;
    std::size_t sprites = 0;      // clusters and single pixels
    std::size_t far_sprites = 0;  // the same for the far part of a large kernel
    double energy = 0;            // sum of w |light|
    double energy_left = 0;       // of pixels that are too dim: they keep their light
    double error_bound = 0;       // of the result, in the same unit; without that of kSimilarColor
    double pixels_drawn = 0;      // area of all sprites, clipped to the picture
    // Light that ended with the sprites: inside and outside the picture together.
    double energy_cut = 0;
};

class Sprites {
  public:
    // `kernel`: 1 channel (used for all) or `channels`, its centre at (width / 2, height / 2); not
    // kept. Of a large one, the smooth part beyond 256 pixels or more is drawn on a coarser raster,
    // in clusters of its own, if that is within the error. Memory: the kernel, and up to 1025 x
    // 1025 pixels of it once more for each size of cell up to clusters.max_side; kernels that are
    // larger and not smooth far out are used for clusters of Shape::kPoint only.
    // Throws InvalidArgument for empty pictures or kernels, options out of range, and
    // Criterion::kSimilarColor with a larger kernel.
    Sprites(int width, int height, int channels, const ConstImageView& kernel,
            const SpriteOptions& options = {});
    ~Sprites();
    Sprites(Sprites&&) noexcept;
    Sprites& operator=(Sprites&&) noexcept;

    // `light` and `out` have the size given at construction and must not overlap; finite.
    // `weights`: null, or width * height positive factors. Memory grows to what the picture with
    // the most clusters needs. Not to be run from two threads at once.
    SpriteReport apply(const ConstImageView& light, const ImageView& out,
                       const float* weights = nullptr);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::glare
