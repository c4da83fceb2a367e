#include "aureole/fourier/symmetric_fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::fourier {
namespace {

Image symmetric_noise(int width, int height, std::uint64_t seed = 1) {
    Image image(width, height, 1);
    Random random(seed);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = static_cast<float>(random.normal());
            image.at(width - 1 - x, height - 1 - y) = image.at(x, y);
        }
    }
    return image;
}

// The definition: the sum of k(x, y) cos(2 pi (kx x + ky y) / n).
double plain_transform(const Image& kernel, int n, int kx, int ky) {
    double sum = 0;
    for (int y = 0; y < kernel.height(); ++y) {
        for (int x = 0; x < kernel.width(); ++x) {
            const int phase = kx * (x - kernel.width() / 2) + ky * (y - kernel.height() / 2);
            sum += static_cast<double>(kernel.at(x, y)) * std::cos(2 * kPi * phase / n);
        }
    }
    return sum;
}

TEST(SymmetricFft, IsTheCosineSum) {
    constexpr int kSize = 14;
    const Image kernel = symmetric_noise(13, 11);
    SymmetricFft fft(kSize);
    std::vector<float> spectrum(symmetric_spectrum_size(kSize));
    ASSERT_EQ(spectrum.size(), 14U * 8U);
    fft.forward(kernel, spectrum.data());
    for (int ky = 0; ky < kSize; ++ky) {
        for (int kx = 0; kx <= kSize / 2; ++kx) {
            EXPECT_NEAR(static_cast<double>(spectrum[static_cast<std::size_t>(ky * 8 + kx)]),
                        plain_transform(kernel, kSize, kx, ky), 2e-5);
        }
    }
}

TEST(SymmetricFft, BringsTwoKernelsBackWholeOrCropped) {
    constexpr int kSize = 60;
    SymmetricFft fft(kSize);
    const Image first = symmetric_noise(59, 59, 1);
    const Image second = symmetric_noise(59, 59, 2);
    std::vector<float> a(symmetric_spectrum_size(kSize));
    std::vector<float> b(a.size());
    fft.forward(first, a.data());
    fft.forward(second, b.data());
    for (const int size : {59, 21}) {
        Image one(size, size, 1);
        Image two(size, size, 1);
        fft.inverse(a.data(), b.data(), one, two);
        Image alone(size, size, 1);
        fft.inverse(a.data(), nullptr, alone, {});
        const int margin = (59 - size) / 2;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                EXPECT_NEAR(one.at(x, y), first.at(x + margin, y + margin), 3e-6F);
                EXPECT_NEAR(two.at(x, y), second.at(x + margin, y + margin), 3e-6F);
                EXPECT_NEAR(alone.at(x, y), one.at(x, y), 3e-6F);
            }
        }
    }
}

TEST(SymmetricFft, SizesAreChecked) {
    EXPECT_THROW(SymmetricFft(15), InvalidArgument);
    EXPECT_THROW(SymmetricFft(0), InvalidArgument);
    EXPECT_THROW(SymmetricFft(22), InvalidArgument);
}

}  // namespace
}  // namespace aureole::fourier
