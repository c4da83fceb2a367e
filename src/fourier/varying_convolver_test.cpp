// Convolution with a kernel that changes over the picture, against sums with the kernel of each
// source pixel.
#include "aureole/fourier/varying_convolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/convolver.h"

namespace aureole::fourier {
namespace {

Image noise(int width, int height, int channels, std::uint64_t seed) {
    Image image(width, height, channels);
    Random random(seed);
    for (std::size_t i = 0; i < image.pixels() * static_cast<std::size_t>(channels); ++i) {
        image.plane(0)[i] = static_cast<float>(random.uniform());
    }
    return image;
}

KernelNodes nodes(int columns, int rows, int width, int height, int channels, std::uint64_t seed) {
    KernelNodes part{columns, rows, {}, {}};
    for (int n = 0; n < columns * rows; ++n) {
        part.halves.push_back(
            right_half(noise(width, height, channels, seed + static_cast<std::uint64_t>(n))));
    }
    return part;
}

// The sum of the definition, source by source with the kernel of its own pixel.
Image by_sources(const Image& in, const std::vector<KernelNodes>& parts, const float* weights) {
    std::vector<double> sums(in.pixels() * static_cast<std::size_t>(in.channels()));
    const auto index = [&](int x, int y, int c) {
        return (static_cast<std::size_t>(c) * static_cast<std::size_t>(in.height()) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(in.width()) +
               static_cast<std::size_t>(x);
    };
    const auto weight = [&](int x, int y) {
        return weights == nullptr ? 1.0 : static_cast<double>(weights[index(x, y, 0)]);
    };
    for (int sy = 0; sy < in.height(); ++sy) {
        for (int sx = 0; sx < in.width(); ++sx) {
            const Image kernel = kernel_at(parts, in.width(), in.height(), sx, sy);
            for (int c = 0; c < in.channels(); ++c) {
                for (int y = 0; y < in.height(); ++y) {
                    for (int x = 0; x < in.width(); ++x) {
                        const int kx = x - sx + kernel.width() / 2;
                        const int ky = y - sy + kernel.height() / 2;
                        if (kx < 0 || ky < 0 || kx >= kernel.width() || ky >= kernel.height()) {
                            continue;
                        }
                        sums[index(x, y, c)] += weight(sx, sy) *
                                                static_cast<double>(in.at(sx, sy, c)) *
                                                static_cast<double>(kernel.at(kx, ky, c));
                    }
                }
            }
        }
    }
    Image out(in.width(), in.height(), in.channels());
    for (int c = 0; c < in.channels(); ++c) {
        for (int y = 0; y < in.height(); ++y) {
            for (int x = 0; x < in.width(); ++x) {
                out.at(x, y, c) = static_cast<float>(sums[index(x, y, c)] / weight(x, y));
            }
        }
    }
    return out;
}

double worst_difference(const Image& a, const Image& b) {
    double worst = 0;
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels() * static_cast<std::size_t>(a.channels()); ++i) {
        const auto value = static_cast<double>(b.plane(0)[i]);
        worst = std::max(worst, std::abs(static_cast<double>(a.plane(0)[i]) - value));
        largest = std::max(largest, std::abs(value));
    }
    return worst / largest;
}

TEST(VaryingConvolver, EqualsTheSumWithTheKernelOfEachSource) {
    struct Case {
        int width, height, channels;
        std::vector<KernelNodes> parts;
    };
    std::vector<Case> cases;
    cases.push_back({37, 23, 3, {nodes(4, 3, 9, 5, 3, 1)}});
    cases.push_back({24, 31, 1, {nodes(5, 1, 7, 11, 1, 20), nodes(2, 2, 33, 21, 1, 50)}});
    cases.push_back({19, 17, 3, {nodes(1, 6, 91, 85, 3, 80)}});   // reaches beyond the picture
    cases.push_back({16, 16, 1, {nodes(16, 16, 3, 3, 1, 200)}});  // a node per pixel
    cases.push_back({40, 1, 1, {nodes(3, 1, 5, 1, 1, 500)}});
    cases.push_back({25, 30, 3, {principal_components(nodes(4, 5, 9, 7, 3, 600), 3)}});
    for (const Case& c : cases) {
        const Image in = noise(c.width, c.height, c.channels, 7);
        Image weights = noise(c.width, c.height, 1, 8);
        for (std::size_t i = 0; i < weights.pixels(); ++i) weights.plane(0)[i] += 0.5F;
        VaryingConvolver convolver(c.width, c.height, c.channels, c.parts);
        Image out(c.width, c.height, c.channels);
        for (const float* w :
             {static_cast<const float*>(nullptr), std::as_const(weights).plane(0)}) {
            convolver.run(in, out, w);
            EXPECT_LT(worst_difference(out, by_sources(in, c.parts, w)), 2e-6)
                << c.width << "x" << c.height << (w != nullptr ? " weighted" : "");
        }
    }
}

TEST(VaryingConvolver, WithEqualKernelsIsAConvolution) {
    const Image half = right_half(noise(15, 9, 3, 3));
    const KernelNodes part{3, 4, std::vector<Image>(12, half), {}};
    const Image in = noise(64, 50, 3, 4);
    Image varying(64, 50, 3);
    VaryingConvolver(64, 50, 3, {part}).run(in, varying);
    Image plain(64, 50, 3);
    Convolver(64, 50, 3, whole_kernel(half)).run(in, plain);
    EXPECT_LT(worst_difference(varying, plain), 2e-6);
}

TEST(VaryingConvolver, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Image in = noise(70, 45, 3, 1);
    VaryingConvolver convolver(70, 45, 3, {nodes(6, 4, 11, 11, 3, 9)});
    Image first(70, 45, 3);
    Image second(70, 45, 3);
    convolver.run(in, first);
    {
        const ThreadLimit one(1);
        convolver.run(in, second);
    }
    EXPECT_EQ(std::memcmp(first.plane(0), second.plane(0), 3 * first.pixels() * sizeof(float)), 0);
}

TEST(VaryingConvolver, HalvesAreTheMeanOfKernelAndHalfTurn) {
    const Image kernel = noise(7, 5, 2, 11);
    const Image even = whole_kernel(right_half(kernel));
    for (int c = 0; c < 2; ++c) {
        for (int y = 0; y < 5; ++y) {
            for (int x = 0; x < 7; ++x) {
                EXPECT_EQ(even.at(x, y, c),
                          0.5F * (kernel.at(x, y, c) + kernel.at(6 - x, 4 - y, c)));
            }
        }
    }
}

TEST(PrincipalComponents, HoldWhatLiesInAPlane) {
    // Five kernels that are mixtures of three: mean and two components hold them.
    const Image a = noise(9, 7, 3, 1);
    const Image b = noise(9, 7, 3, 2);
    const Image c = noise(9, 7, 3, 3);
    KernelNodes part{5, 1, {}, {}};
    for (int n = 0; n < 5; ++n) {
        Image kernel(9, 7, 3);
        for (std::size_t i = 0; i < 3 * kernel.pixels(); ++i) {
            kernel.plane(0)[i] = a.plane(0)[i] + static_cast<float>(n) * b.plane(0)[i] +
                                 static_cast<float>(n * n) * c.plane(0)[i];
        }
        part.halves.push_back(right_half(kernel));
    }
    const KernelNodes two = principal_components(part, 2);
    const KernelNodes one = principal_components(part, 1);
    ASSERT_EQ(two.halves.size(), 3U);
    double missing = 0;
    for (int n = 0; n < 5; ++n) {
        EXPECT_LT(worst_difference(two.half_of(n), part.half_of(n)), 1e-5) << n;
        missing = std::max(missing, worst_difference(one.half_of(n), part.half_of(n)));
    }
    EXPECT_GT(missing, 1e-3);
    // As many as there are nodes: as they were.
    EXPECT_TRUE(principal_components(part, 4).mixture.empty());
    EXPECT_THROW(principal_components(part, 0), InvalidArgument);
}

TEST(VaryingConvolver, BlendsSumToOneAndAreExactAtNodes) {
    for (const int count : {1, 2, 5, 33}) {
        for (int x = 0; x < 33; ++x) {
            const NodeBlend blend = node_blend(x, 33, count);
            EXPECT_GE(blend.first, 0);
            EXPECT_LT(blend.first, count);
            EXPECT_TRUE(blend.second_share == 0 || blend.first + 1 < count);
        }
    }
    EXPECT_EQ(node_blend(32, 33, 5).first, 4);
    EXPECT_EQ(node_blend(16, 33, 5).first, 2);
    EXPECT_EQ(node_blend(16, 33, 5).second_share, 0);
    EXPECT_EQ(node_blend(12, 33, 5).second_share, 0.5F);
}

TEST(VaryingConvolver, RefusesWhatItCannotHold) {
    const auto make = [](KernelNodes part) { VaryingConvolver(20, 10, 1, {std::move(part)}); };
    EXPECT_THROW(make(nodes(21, 1, 3, 3, 1, 1)), InvalidArgument);
    EXPECT_THROW(right_half(noise(4, 3, 1, 1)), InvalidArgument);
    EXPECT_THROW(make({1, 1, {noise(3, 4, 1, 1)}, {}}), InvalidArgument);
    EXPECT_THROW(make(nodes(2, 2, 3, 3, 3, 1)), InvalidArgument);
    KernelNodes missing = nodes(2, 2, 3, 3, 1, 1);
    missing.halves.pop_back();
    EXPECT_THROW(make(missing), InvalidArgument);
    EXPECT_THROW(VaryingConvolver(0, 10, 1, {}), InvalidArgument);
}

}  // namespace
}  // namespace aureole::fourier
