// Sprites of one kernel on one raster: the picture's own, or a coarser one.
#pragma once

#include <map>
#include <vector>

#include "aureole/sources/clusters.h"
#include "glare/sprite_drawing.h"
#include "glare/sprite_kernel.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {

// What it costs to draw sprites: pixels with one tap of the kernel and with four, of one channel,
// and rows of sprites within tiles.
struct SpriteWork {
    double one_tap_pixels = 0;
    double four_tap_pixels = 0;
    double rows = 0;
    double pixels() const { return one_tap_pixels + four_tap_pixels; }
};

class SpriteLayer {
  public:
    // `kernel` in pixels of the layer, each of which is `scale` pixels of the picture wide. The
    // raster has `margin` pixels more than the picture needs on each side. Kernels of cells for all
    // sides up to max_cell_side (1: none).
    SpriteLayer(int width, int height, int channels, int scale, int margin,
                const ConstImageView& kernel, int max_cell_side);

    const KernelProfile& profile() const { return profile_; }
    const SpriteTiles& tiles() const { return tiles_; }
    int width() const { return width_; }  // of the raster
    int height() const { return height_; }
    int margin() const { return margin_; }
    int scale() const { return scale_; }

    // Replaces the sprites. `level`: of SpriteEnds.
    struct Made {
        double energy_cut = 0;
        SpriteWork work;
    };
    Made make(const std::vector<sources::Cluster>& clusters, double level);

    // Adds what lies in tile `index`, whose planes are those of `tile`.
    void draw(std::size_t index, const SpriteTile& tile) const;

  private:
    Sprite sprite_of(const sources::Cluster& cluster, int radius) const;

    int width_;
    int height_;
    int channels_;
    int scale_;
    int margin_;
    int kernel_channels_;
    int centre_x_;
    int centre_y_;
    KernelProfile profile_;
    std::map<int, PaddedKernel> kernels_;  // by side of the cell; 1: of points
    SpriteTiles tiles_;
    std::vector<Sprite> sprites_;
};

}  // namespace aureole::glare
