// Where ghosts are drawn: a pyramid of planes. Level l has pixels of 2^l x 2^l pixels of the
// picture; its pixel (i, j) covers [i 2^l, (i + 1) 2^l) and holds radiance, so that drawing a ghost
// costs the same wherever its detail fits. At the end the levels are added up, each interpolated
// by the quadratic B-spline, which keeps sums.
#pragma once

#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/image/image.h"

namespace aureole::lens {

// One level, seen from a drawing loop. Pixels run from -margin to width + margin - 1, and so do
// rows: interpolation at the picture's border needs neighbours beyond it.
struct CanvasLevel {
    float* planes[3] = {};      // each at pixel (0, 0)
    std::ptrdiff_t stride = 0;  // floats between rows
    int width = 0;              // pixels that lie at least partly inside the picture
    int height = 0;
    int margin = 0;
    int level = 0;
    float scale() const { return static_cast<float>(1 << level); }
};

class Canvas {
  public:
    static constexpr int kMargin = 2;

    // Throws std::bad_alloc.
    Canvas(int width, int height);

    int levels() const noexcept { return static_cast<int>(levels_.size()); }
    const CanvasLevel& level(int l) const noexcept { return levels_[static_cast<std::size_t>(l)]; }

    // Zeroes all levels. Only those marked as used since the last clear are touched.
    void clear() noexcept;
    // To be called before drawing on a level.
    void mark_used(int l) noexcept { used_[static_cast<std::size_t>(l)] = true; }
    // out += the sum of all levels. `out` has 3 channels. Uses several threads.
    void add_to(const ImageView& out) noexcept;

  private:
    std::vector<CanvasLevel> levels_;
    std::vector<Buffer> memory_;
    std::vector<char> used_;
};

}  // namespace aureole::lens
