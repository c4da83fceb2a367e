// Transforms of kernels that are symmetric under a half turn, k(x, y) = k(-x, -y): their spectra
// are real and have the same symmetry, so that n x n samples have n (n / 2 + 1) numbers.
//
// A kernel is an odd square picture of at most n - 1 pixels, centred on its middle pixel; its
// spectrum is row-major, ky = 0 .. n - 1 and kx = 0 .. n / 2 (the fastest), in the natural order
// and the scale of fft.h.
#pragma once

#include <cstddef>
#include <memory>

#include "aureole/image/image.h"

namespace aureole::fourier {

// Numbers in the spectrum of n x n samples.
constexpr std::size_t symmetric_spectrum_size(int n) {
    return static_cast<std::size_t>(n) * (static_cast<std::size_t>(n) / 2 + 1);
}

class SymmetricFft {
  public:
    // Throws InvalidArgument unless n is even, 7-smooth and at most kMaxTransformSize.
    explicit SymmetricFft(int n);
    ~SymmetricFft();
    SymmetricFft(SymmetricFft&&) noexcept;
    SymmetricFft& operator=(SymmetricFft&&) noexcept;

    int size() const noexcept;

    // Of the first channel of `kernel`, which may have any odd size up to n - 1. What is not
    // symmetric in it is lost.
    void forward(const ConstImageView& kernel, float* spectrum) noexcept;
    // The pixels of two kernels at once, their first channels; odd sizes up to n - 1, both the
    // same. They may be smaller than what was transformed. `second` may be nullptr: then `b` is
    // not touched.
    void inverse(const float* first, const float* second, const ImageView& a,
                 const ImageView& b) noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::fourier
