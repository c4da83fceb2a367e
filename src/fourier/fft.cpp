#include "aureole/fourier/fft.h"

#include <algorithm>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/sizes.h"
#include "fourier/fft_kernels.h"
#include "fourier/line_plan.h"
#include "fourier/scratch.h"

namespace aureole::fourier {
namespace {

int checked_size(const char* name, int n) {
    if (!is_smooth(n) || n > kMaxTransformSize) {
        throw InvalidArgument(
            name, std::to_string(n),
            "must be a product of 2, 3, 5 and 7, at most " + std::to_string(kMaxTransformSize));
    }
    return n;
}

std::size_t batches(std::size_t lines, int lanes) {
    return (lines + static_cast<std::size_t>(lanes) - 1) / static_cast<std::size_t>(lanes);
}

std::size_t scratch_size(const FftKernels& kernels, int n) {
    return 2 * static_cast<std::size_t>(kernels.lanes) * static_cast<std::size_t>(n);
}

}  // namespace

struct LineFft::Impl {
    explicit Impl(int n)
        : kernels(fft_kernels()),
          plan(checked_size("transform length", n)),
          scratch(scratch_size(kernels, n)) {}

    void run(bool inverse, float* re, float* im, std::size_t lines) noexcept {
        const auto length = static_cast<std::size_t>(plan.length);
        const auto lanes = static_cast<std::size_t>(kernels.lanes);
        const float scale = inverse ? 1.0F / static_cast<float>(plan.length) : 1.0F;
        parallel_for(batches(lines, kernels.lanes), [&](std::size_t batch, int worker) {
            const std::size_t line = batch * lanes;
            const int count = static_cast<int>(std::min(lanes, lines - line));
            kernels.rows(plan, inverse, re + line * length, im + line * length, plan.length, count,
                         0, plan.length, scale, scratch.of(worker));
        });
    }

    FftKernels kernels;
    LinePlan plan;
    Scratch scratch;
};

LineFft::LineFft(int n) : impl_(std::make_unique<Impl>(n)) {}
LineFft::~LineFft() = default;
LineFft::LineFft(LineFft&&) noexcept = default;
LineFft& LineFft::operator=(LineFft&&) noexcept = default;
int LineFft::size() const noexcept { return impl_->plan.length; }
void LineFft::forward(float* re, float* im, std::size_t lines) noexcept {
    impl_->run(false, re, im, lines);
}
void LineFft::inverse(float* re, float* im, std::size_t lines) noexcept {
    impl_->run(true, re, im, lines);
}

struct Fft2d::Impl {
    Impl(int width, int height)
        : kernels(fft_kernels()),
          across(checked_size("transform width", width)),
          down(checked_size("transform height", height)),
          scratch(scratch_size(kernels, std::max(width, height))) {}

    void columns(bool inverse, float* re, float* im, int first, int end, float scale) noexcept {
        const int count = end - first;
        parallel_for(batches(static_cast<std::size_t>(count), kernels.lanes), [&](std::size_t batch,
                                                                                  int worker) {
            const int x = first + static_cast<int>(batch) * kernels.lanes;
            kernels.columns(down, inverse, re, im, across.length, x,
                            std::min(kernels.lanes, end - x), scale, scratch.of(worker));
        });
    }

    void rows(bool inverse, float* re, float* im, int first, int end) noexcept {
        parallel_for(batches(static_cast<std::size_t>(down.length), kernels.lanes),
                     [&](std::size_t batch, int worker) {
                         const int y = static_cast<int>(batch) * kernels.lanes;
                         const std::ptrdiff_t offset = std::ptrdiff_t{y} * across.length;
                         kernels.rows(across, inverse, re + offset, im + offset, across.length,
                                      std::min(kernels.lanes, down.length - y), first, end, 1.0F,
                                      scratch.of(worker));
                     });
    }

    FftKernels kernels;
    LinePlan across;
    LinePlan down;
    Scratch scratch;
};

Fft2d::Fft2d(int width, int height) : impl_(std::make_unique<Impl>(width, height)) {}
Fft2d::~Fft2d() = default;
Fft2d::Fft2d(Fft2d&&) noexcept = default;
Fft2d& Fft2d::operator=(Fft2d&&) noexcept = default;
int Fft2d::width() const noexcept { return impl_->across.length; }
int Fft2d::height() const noexcept { return impl_->down.length; }

void Fft2d::forward(float* re, float* im) noexcept { forward(re, im, 0, width()); }

void Fft2d::forward(float* re, float* im, int first_column, int end_column) noexcept {
    const int first = std::clamp(first_column, 0, width());
    const int end = std::clamp(end_column, first, width());
    impl_->columns(false, re, im, first, end, 1.0F);
    impl_->rows(false, re, im, first, end);
}

void Fft2d::inverse(float* re, float* im) noexcept {
    impl_->rows(true, re, im, 0, width());
    const double count = static_cast<double>(width()) * static_cast<double>(height());
    impl_->columns(true, re, im, 0, width(), static_cast<float>(1.0 / count));
}

}  // namespace aureole::fourier
