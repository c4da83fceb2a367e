// Pictures on a coarser raster, and back: light is gathered to the raster with the weights by which
// values are interpolated from it, B and its transpose,
//
//     raster = B^T picture,   picture += B raster,   B(x, j) = hat((x + 0.5) / scale - 0.5 - j).
//
// Node j is the middle of fine pixels [scale j, scale (j + 1)). Every pixel's weights sum to 1, and
// so do those that every node gives, over scale^2; both have their middle where pixel and node are.
// So neither energy nor centroid of a light depends on where it lies between the nodes, and what
// it becomes moves continuously with it.
#pragma once

#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/image/image.h"
#include "glare/sprite_drawing.h"

namespace aureole::glare {

inline constexpr int kLargestScale = 8;
// Nodes beyond each edge of the picture: pixels of half a node at the border lie between them.
inline constexpr int kRasterMargin = 1;

// Nodes along an axis of so many pixels, margins included.
int raster_size(int pixels, int scale);

// Weights of the nodes at and right of floor(t), t = (x + 0.5) / scale - 0.5.
struct Between {
    int node = 0;
    float right = 0;  // weight of node + 1
};
Between raster_place(int x, int scale);

// Adds `raster`, margins included, between its nodes to a tile of the picture; as many channels as
// the tile has. `scale` 2, 4 or 8.
void add_between(const Image& raster, int scale, const SpriteTile& tile);
// To a whole picture, over its weights (null, or width * height factors).
void add_between(const Image& raster, int scale, const float* weights,
                 const ImageView& out) noexcept;

class RasterGatherer {
  public:
    // For pictures of this width; `scale` even.
    RasterGatherer(int width, int scale);

    // Replaces `raster`, of raster_size() nodes; `weights`: null, or width * height factors by
    // which pixels are multiplied first. Allocates nothing; not to be run from two threads at once.
    void run(const ConstImageView& in, const float* weights, Image& raster) noexcept;

  private:
    int scale_;
    std::vector<float> hat_;       // of the 2 scale pixels about a node
    std::vector<Buffer> scratch_;  // a row of the picture, gathered down the columns
};

}  // namespace aureole::glare
