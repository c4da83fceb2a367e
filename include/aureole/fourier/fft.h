// Complex Fourier transforms of 7-smooth sizes, float, split real and imaginary parts.
//
// Convention: forward X[k] = sum_n x[n] exp(-2 pi i n k / N), inverse with the opposite sign and
// the factor 1/N (1/(width*height) in 2-D), so that inverse(forward(x)) = x. Results are bit-wise
// identical for any number of threads.
#pragma once

#include <cstddef>
#include <memory>

namespace aureole::fourier {

// Many transforms of one length. Line l occupies re[l * n .. l * n + n - 1] and the same of im.
class LineFft {
  public:
    // Throws InvalidArgument unless n is 7-smooth and at most kMaxTransformSize.
    explicit LineFft(int n);
    ~LineFft();
    LineFft(LineFft&&) noexcept;
    LineFft& operator=(LineFft&&) noexcept;

    int size() const noexcept;
    // In place, natural order in and out.
    void forward(float* re, float* im, std::size_t lines) noexcept;
    void inverse(float* re, float* im, std::size_t lines) noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// A two-dimensional transform of row-major planes of width * height floats.
class Fft2d {
  public:
    // Throws InvalidArgument unless both sizes are 7-smooth and at most kMaxTransformSize.
    Fft2d(int width, int height);
    ~Fft2d();
    Fft2d(Fft2d&&) noexcept;
    Fft2d& operator=(Fft2d&&) noexcept;

    int width() const noexcept;
    int height() const noexcept;

    // In place, natural order in and out. The scratch memory is the object's own (about
    // 16 lines per thread): do not run one object from two threads at once.
    void forward(float* re, float* im) noexcept;
    // The same for input whose columns outside [first_column, end_column) are all zero (an
    // aperture surrounded by nothing): they are not transformed. They must hold zeros.
    void forward(float* re, float* im, int first_column, int end_column) noexcept;
    void inverse(float* re, float* im) noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::fourier
