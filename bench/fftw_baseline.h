// The baseline of the convolution benchmarks: how a textbook does it. Pad to picture + kernel - 1
// (rounded up to a 7-smooth size), FFTW r2c in two dimensions planned with ESTIMATE on two threads,
// multiply by the cached spectrum, c2r.
#pragma once

#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <vector>

#include "aureole/base/parallel.h"
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

    // Interleaved RGB. What FFTW does not do is spread over the threads as well.
    void run(const float* in, float* out) {
        const auto* kernel = reinterpret_cast<const float*>(kernel_.data());
        for (int c = 0; c < 3; ++c) {
            parallel_for(rows(), [&](std::size_t row, int) {
                const int y = static_cast<int>(row);
                float* to = row_of(y);
                const int filled = y < height_ ? width_ : 0;
                const float* from = in + static_cast<std::ptrdiff_t>(y) * width_ * 3 + c;
                for (int x = 0; x < filled; ++x) to[x] = from[x * 3];
                std::fill(to + filled, to + padded_width_, 0.0F);
            });
            fftwf_execute(forward_);
            parallel_for(rows(), [&](std::size_t row, int) {
                auto* a = reinterpret_cast<float*>(complex_ + row * spectrum_width_);
                const float* b = kernel + 2 * row * spectrum_width_;
                for (std::size_t i = 0; i < 2 * spectrum_width_; i += 2) {
                    const float re = a[i] * b[i] - a[i + 1] * b[i + 1];
                    a[i + 1] = a[i] * b[i + 1] + a[i + 1] * b[i];
                    a[i] = re;
                }
            });
            fftwf_execute(inverse_);
            parallel_for(static_cast<std::size_t>(height_), [&](std::size_t row, int) {
                const int y = static_cast<int>(row);
                const float* from = row_of(y);
                float* to = out + static_cast<std::ptrdiff_t>(y) * width_ * 3 + c;
                for (int x = 0; x < width_; ++x) to[x * 3] = from[x];
            });
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
