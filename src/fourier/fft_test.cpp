#include "aureole/fourier/fft.h"

#include <fftw3.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/sizes.h"

namespace aureole::fourier {
namespace {

struct SplitSignal {
    explicit SplitSignal(std::size_t count, std::uint64_t seed = 1) : re(count), im(count) {
        Random random(seed);
        for (std::size_t i = 0; i < count; ++i) {
            re[i] = static_cast<float>(random.normal());
            im[i] = static_cast<float>(random.normal());
        }
    }
    Buffer re;
    Buffer im;
};

// ||a - b|| / ||b|| of a split float signal against interleaved doubles.
double relative_rms(const float* re, const float* im, const fftw_complex* expected,
                    std::size_t count) {
    double error = 0;
    double total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        error += std::pow(re[i] - expected[i][0], 2) + std::pow(im[i] - expected[i][1], 2);
        total += std::pow(expected[i][0], 2) + std::pow(expected[i][1], 2);
    }
    return std::sqrt(error / total);
}

class FftwBuffer {
  public:
    explicit FftwBuffer(const SplitSignal& signal) : data_(fftw_alloc_complex(signal.re.size())) {
        for (std::size_t i = 0; i < signal.re.size(); ++i) {
            data_[i][0] = signal.re[i];
            data_[i][1] = signal.im[i];
        }
    }
    ~FftwBuffer() { fftw_free(data_); }
    FftwBuffer(const FftwBuffer&) = delete;
    FftwBuffer& operator=(const FftwBuffer&) = delete;
    fftw_complex* data() { return data_; }

    void transform(int height, int width) {
        const fftw_plan plan =
            height == 1
                ? fftw_plan_dft_1d(width, data_, data_, FFTW_FORWARD, FFTW_ESTIMATE)
                : fftw_plan_dft_2d(height, width, data_, data_, FFTW_FORWARD, FFTW_ESTIMATE);
        fftw_execute(plan);
        fftw_destroy_plan(plan);
    }

  private:
    fftw_complex* data_;
};

constexpr double kTolerance = 5e-7;

TEST(Sizes, NextSmoothIsTheSmallestSmoothNumber) {
    for (int n = 1; n < 3000; ++n) {
        const int smooth = next_smooth(n);
        EXPECT_TRUE(is_smooth(smooth));
        for (int k = n; k < smooth; ++k) EXPECT_FALSE(is_smooth(k)) << k;
    }
    EXPECT_FALSE(is_smooth(0));
    EXPECT_FALSE(is_smooth(11));
    EXPECT_THROW(next_smooth(0), InvalidArgument);
    EXPECT_THROW(next_smooth(kMaxTransformSize + 1), InvalidArgument);
}

TEST(LineFft, AgreesWithFftwForEverySmoothLengthUpTo8192) {
    int lengths = 0;
    for (int n = 1; n <= 8192; n = next_smooth(n + 1)) {
        SplitSignal signal(static_cast<std::size_t>(n), static_cast<std::uint64_t>(n));
        FftwBuffer expected(signal);
        expected.transform(1, n);
        LineFft fft(n);
        fft.forward(signal.re.data(), signal.im.data(), 1);
        EXPECT_LE(relative_rms(signal.re.data(), signal.im.data(), expected.data(),
                               static_cast<std::size_t>(n)),
                  kTolerance)
            << n;
        ++lengths;
    }
    EXPECT_EQ(lengths, 317);  // 7-smooth numbers up to 8192
}

TEST(LineFft, InverseUndoesForward) {
    constexpr int kLines = 37;  // whole batches and a rest, for any number of lanes
    for (const int n : {1, 2, 7, 48, 360, 1715, 2048}) {
        const std::size_t count = static_cast<std::size_t>(n) * kLines;
        SplitSignal signal(count);
        FftwBuffer original(signal);
        LineFft fft(n);
        fft.forward(signal.re.data(), signal.im.data(), kLines);
        fft.inverse(signal.re.data(), signal.im.data(), kLines);
        EXPECT_LE(relative_rms(signal.re.data(), signal.im.data(), original.data(), count),
                  kTolerance)
            << n;
    }
}

TEST(LineFft, RefusesOtherLengths) {
    EXPECT_THROW(LineFft(0), InvalidArgument);
    EXPECT_THROW(LineFft(11), InvalidArgument);
    EXPECT_THROW(LineFft(-8), InvalidArgument);
}

struct Size {
    int width;
    int height;
};

class Fft2dSize : public testing::TestWithParam<Size> {};

TEST_P(Fft2dSize, AgreesWithFftw) {
    const auto [width, height] = GetParam();
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    SplitSignal signal(count);
    FftwBuffer expected(signal);
    expected.transform(height, width);
    Fft2d fft(width, height);
    fft.forward(signal.re.data(), signal.im.data());
    EXPECT_LE(relative_rms(signal.re.data(), signal.im.data(), expected.data(), count), kTolerance);
    fft.inverse(signal.re.data(), signal.im.data());
    const SplitSignal original(count);
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
        worst = std::max<double>(worst, std::abs(signal.re[i] - original.re[i]));
    }
    EXPECT_LE(worst, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Fft2dSize,
                         testing::Values(Size{1, 1}, Size{1, 12}, Size{12, 1}, Size{5, 7},
                                         Size{30, 42}, Size{105, 64}, Size{343, 48},
                                         Size{1000, 729}, Size{2160, 1080}, Size{2401, 512},
                                         Size{4096, 4096}),
                         [](const auto& instance) {
                             return std::to_string(instance.param.width) + "x" +
                                    std::to_string(instance.param.height);
                         });

TEST(Fft2d, SkippingZeroColumnsChangesNothing) {
    constexpr int kSize = 210;
    constexpr int kFirst = 53;
    constexpr int kEnd = 131;
    SplitSignal all(kSize * kSize);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (x >= kFirst && x < kEnd) continue;
            all.re[static_cast<std::size_t>(y * kSize + x)] = 0;
            all.im[static_cast<std::size_t>(y * kSize + x)] = 0;
        }
    }
    FftwBuffer expected(all);
    expected.transform(kSize, kSize);
    Fft2d fft(kSize, kSize);
    fft.forward(all.re.data(), all.im.data(), kFirst, kEnd);
    EXPECT_LE(relative_rms(all.re.data(), all.im.data(), expected.data(), all.re.size()),
              kTolerance);
}

TEST(Fft2d, IsBitwiseIdenticalForAnyThreadCount) {
    constexpr int kSize = 360;
    SplitSignal one(kSize * kSize);
    SplitSignal many(kSize * kSize);
    Fft2d fft(kSize, kSize);
    {
        const ThreadLimit limit(1);
        fft.forward(one.re.data(), one.im.data());
    }
    fft.forward(many.re.data(), many.im.data());
    for (std::size_t i = 0; i < one.re.size(); ++i) {
        ASSERT_EQ(one.re[i], many.re[i]);
        ASSERT_EQ(one.im[i], many.im[i]);
    }
}

// Every instruction set that this machine can run, the slowest included.
TEST(Fft2d, EveryInstructionSetAgreesWithFftw) {
    constexpr int kWidth = 84;
    constexpr int kHeight = 250;
    const std::int64_t supported = hwy::SupportedTargets();
    int tried = 0;
    for (const std::int64_t target :
         {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_SSSE3},
          std::int64_t{HWY_NEON}, std::int64_t{HWY_SCALAR}}) {
        if ((supported & target) == 0 && target != HWY_SCALAR) continue;
        hwy::SetSupportedTargetsForTest(target);
        SplitSignal signal(kWidth * kHeight);
        FftwBuffer expected(signal);
        expected.transform(kHeight, kWidth);
        Fft2d fft(kWidth, kHeight);
        fft.forward(signal.re.data(), signal.im.data());
        EXPECT_LE(
            relative_rms(signal.re.data(), signal.im.data(), expected.data(), signal.re.size()),
            kTolerance)
            << hwy::TargetName(target);
        ++tried;
    }
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_GE(tried, 2);
}

}  // namespace
}  // namespace aureole::fourier
