#include "aureole/fourier/symmetric_fft.h"

#include <fmt/format.h>

#include <algorithm>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/fft.h"

namespace aureole::fourier {
namespace {

int checked(int n) {
    if (n >= 2 && n % 2 == 0) return n;
    throw InvalidArgument("size of a symmetric transform", fmt::format("{}", n),
                          "must be even and at least 2");
}

}  // namespace

struct SymmetricFft::Impl {
    explicit Impl(int size)
        : n(checked(size)),
          fft(n, n),
          re(static_cast<std::size_t>(n) * static_cast<std::size_t>(n)),
          im(re.size()) {}

    // Where a pixel of a kernel goes, counted from its centre.
    int wrapped(int offset) const noexcept { return offset < 0 ? offset + n : offset; }
    std::ptrdiff_t place(int x, int y) const noexcept {
        return std::ptrdiff_t{wrapped(y)} * n + wrapped(x);
    }

    int n;
    Fft2d fft;
    Buffer re;
    Buffer im;
};

SymmetricFft::SymmetricFft(int n) : impl_(std::make_unique<Impl>(n)) {}
SymmetricFft::~SymmetricFft() = default;
SymmetricFft::SymmetricFft(SymmetricFft&&) noexcept = default;
SymmetricFft& SymmetricFft::operator=(SymmetricFft&&) noexcept = default;
int SymmetricFft::size() const noexcept { return impl_->n; }

void SymmetricFft::forward(const ConstImageView& kernel, float* spectrum) noexcept {
    Impl& own = *impl_;
    std::fill_n(own.re.data(), own.re.size(), 0.0F);
    std::fill_n(own.im.data(), own.im.size(), 0.0F);
    for (int y = 0; y < kernel.height; ++y) {
        for (int x = 0; x < kernel.width; ++x) {
            own.re.data()[own.place(x - kernel.width / 2, y - kernel.height / 2)] =
                kernel.at(x, y, 0);
        }
    }
    own.fft.forward(own.re.data(), own.im.data());
    const auto columns = static_cast<std::ptrdiff_t>(own.n) / 2 + 1;
    for (std::ptrdiff_t row = 0; row < own.n; ++row) {
        std::copy_n(own.re.data() + row * own.n, columns, spectrum + row * columns);
    }
}

void SymmetricFft::inverse(const float* first, const float* second, const ImageView& a,
                           const ImageView& b) noexcept {
    Impl& own = *impl_;
    const int n = own.n;
    const int columns = n / 2 + 1;
    // Two real kernels as one complex one: their spectra are real, so it is a + i b in both worlds.
    const auto unfold = [n, columns](const float* half, float* whole) {
        parallel_for(static_cast<std::size_t>(n), [&](std::size_t row, int) {
            float* to = whole + row * static_cast<std::size_t>(n);
            const auto opposite = (static_cast<std::size_t>(n) - row) % static_cast<std::size_t>(n);
            std::copy_n(half + row * static_cast<std::size_t>(columns), columns, to);
            const float* mirror = half + opposite * static_cast<std::size_t>(columns);
            for (int x = columns; x < n; ++x) to[x] = mirror[n - x];
        });
    };
    unfold(first, own.re.data());
    if (second != nullptr) {
        unfold(second, own.im.data());
    } else {
        std::fill_n(own.im.data(), own.im.size(), 0.0F);
    }
    own.fft.inverse(own.re.data(), own.im.data());
    const auto crop = [&](const Buffer& plane, const ImageView& out) {
        const int half_width = out.width / 2;
        const int half_height = out.height / 2;
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                out.at(x, y, 0) = plane.data()[own.place(x - half_width, y - half_height)];
            }
        }
    };
    crop(own.re, a);
    if (second != nullptr) crop(own.im, b);
}

}  // namespace aureole::fourier
