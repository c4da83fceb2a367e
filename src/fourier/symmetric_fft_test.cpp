#include "aureole/fourier/symmetric_fft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/fourier/half_spectrum.h"

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

TEST(HalfSpectrum, NumbersKeepElevenBitsOverNineDecadesAndAddUp) {
    std::vector<float> values;
    Random random(1);
    for (int i = 0; i < 1003; ++i) {
        values.push_back(static_cast<float>(random.log_uniform(1e-3, 1e5)));
        if (i % 2 == 0) values.back() = -values.back();
    }
    std::vector<std::uint16_t> halves(values.size());
    const float scale = encode_spectrum(values, halves.data());
    std::vector<float> sum(values.size());
    add_spectrum(halves, scale, sum.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(sum[i], values[i], std::abs(values[i]) * 0x1p-11F) << i;
    }
    const std::vector<float> once = sum;
    add_spectrum(halves, -0.5F * scale, sum.data());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(sum[i], 0.5F * once[i]);
}

TEST(HalfSpectrum, ZerosHaveTheScaleZero) {
    const std::vector<float> values(5);
    std::vector<std::uint16_t> halves(5, 1);
    EXPECT_EQ(encode_spectrum(values, halves.data()), 0.0F);
    EXPECT_EQ(halves, std::vector<std::uint16_t>(5));
}

// Values that differ by any power of two have the same halves.
TEST(HalfSpectrum, DoesNotDependOnTheLevel) {
    const std::vector<float> values = {1.0F, -0.3F, 0.001F};
    std::vector<float> faint = values;
    for (float& value : faint) value *= 0x1p-60F;
    std::vector<std::uint16_t> halves(3);
    std::vector<std::uint16_t> faint_halves(3);
    const float scale = encode_spectrum(values, halves.data());
    EXPECT_EQ(encode_spectrum(faint, faint_halves.data()), scale * 0x1p-60F);
    EXPECT_EQ(halves, faint_halves);
}

}  // namespace
}  // namespace aureole::fourier
