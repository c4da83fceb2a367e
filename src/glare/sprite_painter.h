// What Sprites does, in two steps: planning, after which the cost is known, and drawing.
#pragma once

#include <optional>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/glare/sprites.h"
#include "aureole/sources/brightness_histogram.h"
#include "glare/far_layer.h"
#include "glare/sprite_crop.h"
#include "glare/sprite_kernel.h"
#include "glare/sprite_layer.h"

namespace aureole::glare {

// How the error asked for is shared out. Light that stays where it is counts twice: where it should
// have gone, and where it still is.
struct ErrorShares {
    double clusters = 0.5;
    double crop = 0.25;
    double dim_light = 0.125;
};
// Of the error asked for, what the raster of a far layer may take of the clusters' share.
inline constexpr double kShareOfFarRaster = 0.125;

class SpritePainter {
  public:
    // `split`: of the kernel; null for none.
    SpritePainter(int width, int height, int channels, const ConstImageView& kernel,
                  const SpriteOptions& options, const FarKernel* split);

    // Of the energy, what may stay where it is: to be given to BrightnessHistogram::count().
    double dim_share() const;
    // Pixels up to here are not drawn at all.
    float dim_limit(const sources::BrightnessHistogram& histogram) const;

    struct Plan {
        SpriteReport report;
        SpriteWork near;
        SpriteWork far;
        double core_pixels = 0;
        double lit_pixels = 0;
    };
    // `measured`: all of the light.
    Plan plan(const ConstImageView& light, const float* weights,
              const sources::BrightnessHistogram& measured);
    // What was planned for the same light.
    void draw(const ConstImageView& light, const ImageView& out, const float* weights,
              const sources::BrightnessHistogram& measured);

    // Pixels of tiles with something above the limit in them, or so near that its core reaches in.
    double lit_pixels(const sources::BrightnessHistogram& measured, float limit) const;

    bool has_far() const { return far_.has_value(); }
    SpriteLayer& near() { return *near_; }
    FarLayer* far() { return far_ ? &*far_ : nullptr; }
    int core_radius() const { return core_radius_; }
    // What a sprite of the near kernel covers if all have the same energy.
    double typical_area() const { return typical_area_; }
    const SpriteOptions& options() const { return options_; }

  private:
    void draw_tile(const ConstImageView& light, const ImageView& out, const float* weights,
                   const sources::BrightnessHistogram& measured, std::size_t index,
                   float* planes) const;
    void finish_row(const ConstImageView& light, const ImageView& out, const float* weights,
                    const SpriteTile& tile, int y, bool bright) const;
    void draw_cores(const ConstImageView& light, const float* weights,
                    const SpriteTile& tile) const;
    bool light_near(const SpriteTile& tile, const sources::BrightnessHistogram& measured,
                    float limit) const;
    Sprite core_sprite(const ConstImageView& light, int x, int y, float weight) const;
    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    int channels_;
    int kernel_channels_;
    SpriteOptions options_;
    int core_radius_ = 0;
    PaddedKernel core_;
    sources::KernelRoughness roughness_;
    sources::ClusterFinder finder_;
    SpriteEnds ends_;
    std::optional<SpriteLayer> near_;
    std::optional<FarLayer> far_;
    double typical_area_ = 0;
    float dim_limit_ = 0;  // of the last plan
    float full_limit_ = 0;
    std::vector<Buffer> scratch_;
};

}  // namespace aureole::glare
