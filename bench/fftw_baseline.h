// The baseline of the convolution benchmarks: how a textbook does it. Pad to picture + kernel - 1
// (rounded up to a 7-smooth size), FFTW r2c in two dimensions planned with ESTIMATE on two threads,
// multiply by the cached spectrum, c2r.
#pragma once

#include <fftw3.h>

#include <complex>
#include <vector>

#include "aureole/fourier/sizes.h"
#include "aureole/image/image.h"

namespace aureole::bench {

class TextbookConvolver {
  public:
    TextbookConvolver(int width, int height, const ConstImageView& kernel)
        : width_(width),
          height_(height),
          padded_width_(fourier::next_smooth(width + kernel.width - 1)),
          padded_height_(fourier::next_smooth(height + kernel.height - 1)),
          spectrum_width_(static_cast<std::size_t>(padded_width_) / 2 + 1),
          real_(fftwf_alloc_real(samples())),
          complex_(fftwf_alloc_complex(spectrum_width_ * rows())),
          kernel_(spectrum_width_ * rows()) {
        fftwf_init_threads();
        fftwf_plan_with_nthreads(2);
        forward_ =
            fftwf_plan_dft_r2c_2d(padded_height_, padded_width_, real_, complex_, FFTW_ESTIMATE);
        inverse_ =
            fftwf_plan_dft_c2r_2d(padded_height_, padded_width_, complex_, real_, FFTW_ESTIMATE);
        std::fill(real_, real_ + samples(), 0.0F);
        for (int y = 0; y < kernel.height; ++y) {
            const int row = (y - kernel.height / 2 + padded_height_) % padded_height_;
            for (int x = 0; x < kernel.width; ++x) {
                const int column = (x - kernel.width / 2 + padded_width_) % padded_width_;
                row_of(row)[column] = kernel.at(x, y, 0);
            }
        }
        fftwf_execute(forward_);
        const float scale = 1.0F / static_cast<float>(samples());
        for (std::size_t i = 0; i < kernel_.size(); ++i) {
            kernel_[i] = {complex_[i][0] * scale, complex_[i][1] * scale};
        }
    }
    ~TextbookConvolver() {
        fftwf_destroy_plan(forward_);
        fftwf_destroy_plan(inverse_);
        fftwf_free(real_);
        fftwf_free(complex_);
    }
    TextbookConvolver(const TextbookConvolver&) = delete;
    TextbookConvolver& operator=(const TextbookConvolver&) = delete;

    // Interleaved RGB.
    void run(const float* in, float* out) {
        auto* spectrum = reinterpret_cast<std::complex<float>*>(complex_);
        for (int c = 0; c < 3; ++c) {
            std::fill(real_, real_ + samples(), 0.0F);
            for (int y = 0; y < height_; ++y) {
                const float* from = in + static_cast<std::ptrdiff_t>(y) * width_ * 3 + c;
                for (int x = 0; x < width_; ++x) row_of(y)[x] = from[x * 3];
            }
            fftwf_execute(forward_);
            for (std::size_t i = 0; i < kernel_.size(); ++i) {
                const std::complex<float> a = spectrum[i];
                const std::complex<float> b = kernel_[i];
                spectrum[i] = {a.real() * b.real() - a.imag() * b.imag(),
                               a.real() * b.imag() + a.imag() * b.real()};
            }
            fftwf_execute(inverse_);
            for (int y = 0; y < height_; ++y) {
                float* to = out + static_cast<std::ptrdiff_t>(y) * width_ * 3 + c;
                for (int x = 0; x < width_; ++x) to[x * 3] = row_of(y)[x];
            }
        }
    }

  private:
    std::size_t rows() const { return static_cast<std::size_t>(padded_height_); }
    std::size_t samples() const { return static_cast<std::size_t>(padded_width_) * rows(); }
    float* row_of(int y) { return real_ + static_cast<std::ptrdiff_t>(y) * padded_width_; }

    int width_;
    int height_;
    int padded_width_;
    int padded_height_;
    std::size_t spectrum_width_;
    float* real_;
    fftwf_complex* complex_;
    std::vector<std::complex<float>> kernel_;
    fftwf_plan forward_;
    fftwf_plan inverse_;
};

// One in-place complex transform of n x n, ESTIMATE, two threads.
class FftwSquare {
  public:
    explicit FftwSquare(int n) : data_(fftwf_alloc_complex(size(n))) {
        fftwf_init_threads();
        fftwf_plan_with_nthreads(2);
        plan_ = fftwf_plan_dft_2d(n, n, data_, data_, FFTW_FORWARD, FFTW_ESTIMATE);
        for (std::size_t i = 0; i < size(n); ++i) data_[i][0] = data_[i][1] = 0;
    }
    ~FftwSquare() {
        fftwf_destroy_plan(plan_);
        fftwf_free(data_);
    }
    FftwSquare(const FftwSquare&) = delete;
    FftwSquare& operator=(const FftwSquare&) = delete;
    void run() { fftwf_execute(plan_); }

  private:
    static std::size_t size(int n) {
        return static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    }
    fftwf_complex* data_;
    fftwf_plan plan_;
};

}  // namespace aureole::bench
