// The SIMD part of drawing ghosts, compiled per instruction set.
//
// Ghosts are drawn row by row, all of a level together. Rims are evaluated pixel by pixel; insides
// are constant, so a row only notes where each begins and ends, and then adds their running sum:
// the cost of an inside does not depend on its size, nor on how many overlap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lens/canvas.h"
#include "lens/matrix_outline.h"

namespace aureole::lens {

// Where insides begin and end on one row: for each pixel what is added to the running sum there,
// and a bit that something is. Between rows all is 0. The sum is kept in double precision, so that
// nothing of a bright ghost is left in the dark behind its end.
class InsideChanges {
  public:
    InsideChanges(int first, int width)
        : first_(first),
          change_(static_cast<std::size_t>(width) * 4),
          changed_(static_cast<std::size_t>(width) / 64 + 1) {}

    // Pixels [span.begin, span.end), which may end behind the last pixel by one.
    void add(const RowSpan& span, const float* rgb) {
        add(span.begin, rgb, 1);
        add(span.end, rgb, -1);
    }
    // Calls inside(begin, end, sum of RGB) for pieces of constant sum, and forgets all.
    template <class Inside>
    void take(const Inside& inside) {
        double sum[3] = {};
        int begin = first_;
        for (std::size_t word = 0; word < changed_.size(); ++word) {
            for (std::uint64_t bits = changed_[word]; bits != 0; bits &= bits - 1) {
                const std::size_t index =
                    64 * word + static_cast<std::size_t>(__builtin_ctzll(bits));
                const int x = first_ + static_cast<int>(index);
                if (open_ > 0) inside(begin, x, sum);
                double* change = &change_[4 * index];
                for (int c = 0; c < 3; ++c) sum[c] += change[c];
                open_ += static_cast<int>(change[3]);
                if (open_ == 0) std::fill(sum, sum + 3, 0.0);
                std::fill(change, change + 4, 0.0);
                begin = x;
            }
            changed_[word] = 0;
        }
    }

  private:
    void add(int x, const float* rgb, int sign) {
        const auto index = static_cast<std::size_t>(x - first_);
        for (std::size_t c = 0; c < 3; ++c) {
            change_[4 * index + c] += sign * static_cast<double>(rgb[c]);
        }
        change_[4 * index + 3] += sign;  // counts those that are open
        changed_[index / 64] |= std::uint64_t{1} << (index % 64);
    }

    int first_;
    int open_ = 0;
    std::vector<double> change_;
    std::vector<std::uint64_t> changed_;
};

struct MatrixKernels {
    // Adds rows [begin, end) of ghosts without pictures to a level, and marks them as used.
    void (*draw_rows)(std::span<const MatrixDrawing* const> drawings, const CanvasLevel& level,
                      int begin, int end, InsideChanges& changes);
    // Coverage of pixels [x, x + count) of row y, pictures not included. Writes up to 15 floats
    // too many.
    void (*coverage_row)(const MatrixDrawing& drawing, int y, int x, int count, float* coverage);
};

MatrixKernels matrix_kernels();

}  // namespace aureole::lens
