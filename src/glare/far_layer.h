// The far part of a large kernel, drawn on its coarse raster and added to the picture between the
// raster's nodes.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/image/image.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/far_kernel.h"
#include "glare/sprite_crop.h"
#include "glare/sprite_layer.h"

namespace aureole::glare {

class FarLayer {
  public:
    // For pictures of width x height x channels; the kernel is not kept.
    FarLayer(int width, int height, int channels, const FarKernel& kernel);

    // Of the raster: sum of |difference| per energy.
    double error() const { return error_; }
    // Of the energy, how much the far part holds at most: sum of |far|.
    double share() const { return roughness_.sum; }

    struct Plan {
        std::size_t sprites = 0;
        double bright_energy = 0;
        double energy_left = 0;  // of pixels that are too dim
        double error_bound = 0;  // without that of light left
        double energy_cut = 0;
        SpriteWork work;
    };
    // What is bright: ClusterOptions::dim_limit and full_limit.
    struct Limits {
        float dim = 0;
        float full = 0;
    };
    // Finds the clusters of what is bright, with an error of `cluster_error` of their energy, and
    // ends their sprites where `most_lost` is lost in all.
    Plan plan(const ConstImageView& light, const float* weights,
              const sources::BrightnessHistogram& measured, const Limits& limits,
              double cluster_error, double most_lost);

    SpriteLayer& layer() { return layer_; }

    // What was planned, on the raster.
    void draw();
    // And from the raster added to a tile of the picture.
    void add_to(const SpriteTile& tile) const;
    // Or to all of it, over its weights (null: 1).
    void add_to(const ImageView& out, const float* weights) const noexcept;

  private:
    int channels_;
    int scale_;
    double error_;
    sources::KernelRoughness roughness_;
    sources::ClusterFinder finder_;
    SpriteEnds ends_;
    SpriteLayer layer_;
    Image canvas_;
    std::vector<Buffer> scratch_;
};

}  // namespace aureole::glare
