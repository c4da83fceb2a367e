// Where ghosts are drawn: a pyramid of planes. Level l has pixels of 2^l x 2^l pixels of the
// picture; its pixel (i, j) covers [i 2^l, (i + 1) 2^l) and holds radiance, so that drawing a ghost
// costs the same wherever its detail fits. At the end the levels are added up, each interpolated
// by the quadratic B-spline, which keeps sums: a level is subdivided with the weights 3/4, 1/4
// (Chaikin 1974) into the next finer one, and so on down to the picture.
//
// Rows remember which of their pixels were drawn on, so that the cost is that of the used parts.
#pragma once

#include <algorithm>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/image/image.h"

namespace aureole::lens {

// Pixels [begin, end) of a row.
struct RowSpan {
    int begin = 0;
    int end = 0;
    bool empty() const { return begin >= end; }
    void include(int first, int last) {
        *this =
            empty() ? RowSpan{first, last} : RowSpan{std::min(begin, first), std::max(end, last)};
    }
};

// One level, seen from a drawing loop. Pixels run from -margin to width + margin - 1, and so do
// rows: interpolation at the picture's border needs neighbours beyond it. Behind the last pixel of
// a row there is room for kPadding floats, which must stay 0.
struct CanvasLevel {
    static constexpr int kPadding = 48;

    float* planes[3] = {};      // each at pixel (0, 0)
    std::ptrdiff_t stride = 0;  // floats between rows
    int width = 0;              // pixels that lie at least partly inside the picture
    int height = 0;
    int margin = 0;
    int level = 0;
    RowSpan* used = nullptr;  // of row 0

    float scale() const { return static_cast<float>(1 << level); }
    // To be called before drawing on pixels [begin, end) of a row, unless all of the level is
    // marked; several threads may do so for different rows.
    void mark_used(int row, int begin, int end) const { used[row].include(begin, end); }
};

class Canvas {
  public:
    static constexpr int kMargin = 2;

    // As many levels as leave 8 pixels across the shorter side, 8 at most. Throws std::bad_alloc.
    Canvas(int width, int height);

    int levels() const noexcept { return static_cast<int>(levels_.size()); }
    const CanvasLevel& level(int l) const noexcept { return levels_[static_cast<std::size_t>(l)]; }

    // Forgets what was drawn. Uses several threads.
    void clear() noexcept;
    // Marks all of a level as used.
    void mark_used(int l) noexcept;
    // out += the sum of all levels, and clears them. `out` has 3 channels and the canvas's size.
    // Uses several threads.
    void add_to(const ImageView& out) noexcept;

  private:
    void clear_from(std::size_t first_level) noexcept;

    std::vector<CanvasLevel> levels_;
    std::vector<Buffer> memory_;
    std::vector<std::vector<RowSpan>> used_;
};

}  // namespace aureole::lens
