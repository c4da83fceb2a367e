// Linear convolution of pictures of one size with one kernel, as often as needed.
//
//   out(x) = (1 / w(x)) * sum over s inside the picture of  w(s) in(s) k(x - s)
//
// with optional pixel weights w > 0 (relative solid angles; 1 without). Nothing wraps around, and
// what leaves the picture is gone.
//
// Method: circular convolution by mixed-radix transforms of W + r columns and H + r rows, r the
// kernel's *radius* (its longest reach from the centre), not its diameter. Circularly, pixel x
// also receives x - s + N and x - s - N. For x and s inside the picture |x - s| <= W - 1, so these
// are at least N - W + 1 > r away as soon as N >= W + r: beyond the kernel's reach. What wraps
// around falls only into x >= W, which is cropped. A reach beyond W - 1 is never seen and is cut
// first.
// Columns go first, with RGB deinterleaved once; of the real columns' spectra only ky <= N/2 is
// kept; then, line by line while in cache, the pruned row is transformed, multiplied by the
// kernel's spectrum in the same (unordered) layout, transformed back and stored pruned; last the
// columns return. Zero rows and columns are never transformed.
#pragma once

#include <memory>

#include "aureole/image/image.h"

namespace aureole::fourier {

class Convolver {
  public:
    // Prepares for pictures of width x height x channels. `kernel` has 1 channel (used for all),
    // `channels`, or one for each pair: then it is a matrix, whose channel `channels` * j + c holds
    // where the light of channel j goes in channel c, and out(c) is the sum over j. Its centre is
    // pixel (kernel.width / 2, kernel.height / 2) (rounded down); it is not kept. Any sizes, the
    // kernel may be larger than the picture. Memory (full-screen kernel at 1920x1080, RGB): 38 MB
    // work, 19 MB per kernel channel. A matrix takes as many transforms as any other kernel, but
    // three times the products. Throws InvalidArgument for empty pictures or kernels and for sizes
    // whose padding exceeds kMaxTransformSize.
    Convolver(int width, int height, int channels, const ConstImageView& kernel);
    ~Convolver();
    Convolver(Convolver&&) noexcept;
    Convolver& operator=(Convolver&&) noexcept;

    int width() const noexcept;
    int height() const noexcept;
    int channels() const noexcept;
    int padded_width() const noexcept;
    int padded_height() const noexcept;

    // `in` and `out` have the size given at construction, any strides (planar and interleaved RGB
    // are fast), and may be the same memory. `weights` is null or points to width * height
    // positive row-major floats. Allocates nothing; not to be run from two threads at once.
    void run(const ConstImageView& in, const ImageView& out,
             const float* weights = nullptr) noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The definition above as a direct sum in double precision: O(picture x kernel), the oracle, and
// the faster way for kernels of a few pixels. `in` and `out` must not overlap. Throws
// InvalidArgument if sizes do not match.
void convolve_directly(const ConstImageView& in, const ConstImageView& kernel, const ImageView& out,
                       const float* weights = nullptr);

}  // namespace aureole::fourier
