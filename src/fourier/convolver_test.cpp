#include "aureole/fourier/convolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "fourier/line_plan.h"

namespace aureole::fourier {
namespace {

Image noise(int width, int height, int channels, std::uint64_t seed) {
    Image image(width, height, channels);
    Random random(seed);
    for (int c = 0; c < channels; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.normal());
        }
    }
    return image;
}

double relative_rms(const ConstImageView& actual, const ConstImageView& expected) {
    double error = 0;
    double total = 0;
    for (int c = 0; c < expected.channels; ++c) {
        for (int y = 0; y < expected.height; ++y) {
            for (int x = 0; x < expected.width; ++x) {
                error += std::pow(actual.at(x, y, c) - expected.at(x, y, c), 2);
                total += std::pow(expected.at(x, y, c), 2);
            }
        }
    }
    return std::sqrt(error / total);
}

struct Case {
    int width;
    int height;
    int channels;
    int kernel_width;
    int kernel_height;
    int kernel_channels;
};

class ConvolverCase : public testing::TestWithParam<Case> {};

TEST_P(ConvolverCase, AgreesWithDirectSum) {
    const Case& p = GetParam();
    const Image in = noise(p.width, p.height, p.channels, 1);
    const Image kernel = noise(p.kernel_width, p.kernel_height, p.kernel_channels, 2);
    std::vector<float> weights(in.pixels());
    Random random(3);
    for (float& weight : weights) weight = static_cast<float>(random.uniform(0.5, 1.5));

    Convolver convolver(p.width, p.height, p.channels, kernel);
    for (const bool weighted : {false, true}) {
        const float* w = weighted ? weights.data() : nullptr;
        Image out(p.width, p.height, p.channels);
        Image expected(p.width, p.height, p.channels);
        convolver.run(in, out, w);
        convolve_directly(in, kernel, expected, w);
        EXPECT_LE(relative_rms(out, expected), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ConvolverCase,
                         testing::Values(Case{1, 1, 1, 1, 1, 1}, Case{1, 1, 3, 9, 9, 3},
                                         Case{5, 7, 3, 3, 3, 1}, Case{31, 17, 3, 9, 33, 3},
                                         Case{64, 48, 1, 7, 5, 1}, Case{33, 40, 3, 101, 99, 3},
                                         Case{127, 1, 3, 4, 6, 3}, Case{1, 127, 2, 3, 255, 2},
                                         Case{65, 67, 5, 129, 3, 1}, Case{130, 50, 3, 2, 2, 3},
                                         Case{97, 89, 3, 193, 177, 3}, Case{1, 12, 20, 1, 1, 1},
                                         Case{33, 40, 3, 101, 99, 9}, Case{64, 48, 2, 7, 5, 4}),
                         [](const auto& instance) {
                             const Case& p = instance.param;
                             return std::to_string(p.width) + "x" + std::to_string(p.height) + "x" +
                                    std::to_string(p.channels) + "_kernel_" +
                                    std::to_string(p.kernel_width) + "x" +
                                    std::to_string(p.kernel_height) + "x" +
                                    std::to_string(p.kernel_channels);
                         });

// A matrix moves the light of channel 1 into channel 2, three pixels to the right.
TEST(Convolver, MatrixLeadsFromChannelToChannel) {
    Image in(20, 10, 3);
    in.at(5, 4, 1) = 1;
    Image kernel(9, 9, 9);
    kernel.at(7, 4, 3 * 1 + 2) = 0.25F;
    Image out(20, 10, 3);
    Convolver(20, 10, 3, kernel).run(in, out);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 10; ++y) {
            for (int x = 0; x < 20; ++x) {
                EXPECT_NEAR(out.at(x, y, c), x == 8 && y == 4 && c == 2 ? 0.25F : 0.0F, 1e-7F);
            }
        }
    }
}

TEST(Convolver, SeesInterleavedPlanarAndOddStridesAlike) {
    constexpr int kWidth = 75;
    constexpr int kHeight = 21;
    const Image kernel = noise(11, 13, 3, 2);
    const Image planar = noise(kWidth, kHeight, 3, 1);
    Convolver convolver(kWidth, kHeight, 3, kernel);
    Image expected(kWidth, kHeight, 3);
    convolver.run(planar, expected);
    for (const int pixel_stride : {3, 4}) {
        std::vector<float> in(planar.pixels() * static_cast<std::size_t>(pixel_stride));
        std::vector<float> out(in.size(), -1);
        const ConstImageView in_view = interleaved_view(in.data(), kWidth, kHeight, pixel_stride);
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    in[static_cast<std::size_t>(in_view.offset(x, y, c))] = planar.at(x, y, c);
                }
            }
        }
        const ImageView out_view = interleaved_view(out.data(), kWidth, kHeight, pixel_stride);
        convolver.run(in_view.channel_range(0, 3), out_view.channel_range(0, 3));
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    ASSERT_EQ(out_view.at(x, y, c), expected.at(x, y, c));
                }
            }
        }
        if (pixel_stride == 4) {
            EXPECT_EQ(out_view.at(7, 7, 3), -1);  // alpha is not touched
        }
    }
}

TEST(Convolver, WorksInPlace) {
    const Image kernel = noise(15, 9, 1, 2);
    Image image = noise(50, 40, 3, 1);
    Image expected(50, 40, 3);
    Convolver convolver(50, 40, 3, kernel);
    convolver.run(image, expected);
    convolver.run(image, image);
    EXPECT_EQ(relative_rms(image, expected), 0);
}

// A light in a corner with a kernel that reaches exactly across: the opposite border receives the
// kernel's last pixel and nothing that came around.
TEST(Convolver, NothingWrapsAround) {
    constexpr int kSize = 40;
    for (int reach = 1; reach < kSize; ++reach) {
        const int size = 2 * reach + 1;
        Image kernel(size, size, 1);
        for (int i = 0; i < size; ++i) kernel.at(i, reach) = kernel.at(reach, i) = 1;
        Image in(kSize, kSize, 1);
        in.at(0, 0) = 1;
        in.at(kSize - 1, kSize - 1) = 1;
        Image out(kSize, kSize, 1);
        Convolver convolver(kSize, kSize, 1, kernel);
        EXPECT_EQ(convolver.padded_width(), best_length(kSize + reach));
        convolver.run(in, out);
        for (int x = 1; x < kSize - 1; ++x) {
            EXPECT_NEAR(out.at(x, 0), x <= reach ? 1 : 0, 1e-5) << reach << " " << x;
            EXPECT_NEAR(out.at(x, kSize - 1), kSize - 1 - x <= reach ? 1 : 0, 1e-5);
        }
    }
}

TEST(Convolver, IsBitwiseIdenticalForAnyThreadCount) {
    const Image kernel = noise(61, 31, 3, 2);
    const Image in = noise(200, 111, 3, 1);
    Convolver convolver(200, 111, 3, kernel);
    Image one(200, 111, 3);
    Image many(200, 111, 3);
    {
        const ThreadLimit limit(1);
        convolver.run(in, one);
    }
    convolver.run(in, many);
    EXPECT_EQ(relative_rms(one, many), 0);
}

TEST(Convolver, RefusesMismatchedKernels) {
    EXPECT_THROW(Convolver(8, 8, 3, noise(3, 3, 2, 1)), InvalidArgument);
    EXPECT_THROW(Convolver(0, 8, 3, noise(3, 3, 1, 1)), InvalidArgument);
    EXPECT_THROW(Convolver(8, 8, 1, ConstImageView{}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::fourier
