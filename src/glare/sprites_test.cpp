#include "aureole/glare/sprites.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/fourier/convolver.h"

namespace aureole::glare {
namespace {

using Criterion = sources::ClusterOptions::Criterion;

// A peak with wings of r^-2.4 and needles one pixel wide, of sum 1 per channel.
Image needle_kernel(int size, unsigned seed, double needles) {
    Image kernel(size, size, 3);
    Random random(seed);
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double r2 = std::pow(x - size / 2, 2) + std::pow(y - size / 2, 2);
                kernel.at(x, y, c) = static_cast<float>((1 + needles * (random.uniform() - 0.5)) /
                                                        std::pow(0.3 + r2 / (1 + 0.2 * c), 1.2));
                sum += static_cast<double>(kernel.at(x, y, c));
            }
        }
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) kernel.at(x, y, c) /= static_cast<float>(sum);
        }
    }
    return kernel;
}

// Lights of all sizes over a dim ground.
Image lights_over_ground(int width, int height, unsigned seed) {
    Image image(width, height, 3);
    Random random(seed);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(0.001 * random.uniform());
        }
    }
    for (int light = 0; light < 6; ++light) {
        const double cx = random.uniform(0, width);
        const double cy = random.uniform(0, height);
        const double radius = random.log_uniform(0.5, 12);
        const double color[3] = {random.uniform(), random.uniform(), random.uniform()};
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double r = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
                const double value = 10 / (1 + std::pow(r / radius, 16));
                for (int c = 0; c < 3; ++c) {
                    image.at(x, y, c) += static_cast<float>(value * color[c]);
                }
            }
        }
    }
    return image;
}

Image some_weights(int width, int height) {
    Image weights(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            weights.at(x, y) = 1 / (1 + 1e-4F * static_cast<float>(x * x + y));
        }
    }
    return weights;
}

// Sum of w |a - b| over the sum of w |light|.
double relative_error(const Image& a, const Image& b, const Image& light, const float* weights) {
    double difference = 0;
    double energy = 0;
    for (int c = 0; c < a.channels(); ++c) {
        for (std::size_t i = 0; i < a.pixels(); ++i) {
            const double w = weights == nullptr ? 1.0 : static_cast<double>(weights[i]);
            difference += w * std::abs(static_cast<double>(a.plane(c)[i]) - b.plane(c)[i]);
            energy += w * std::abs(static_cast<double>(light.plane(c)[i]));
        }
    }
    return difference / energy;
}

Image convolved(const Image& light, const Image& kernel, const float* weights) {
    Image out(light.width(), light.height(), light.channels());
    fourier::Convolver(light.width(), light.height(), light.channels(), kernel)
        .run(light, out, weights);
    return out;
}

TEST(Sprites, StayWithinTheErrorAskedFor) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Image light = lights_over_ground(150, 110, seed);
        const Image weights = some_weights(150, 110);
        const Image kernel = needle_kernel(seed % 2 == 0 ? 65 : 181, seed, seed < 3 ? 0.0 : 0.5);
        for (const float* w : {static_cast<const float*>(nullptr), weights.plane(0)}) {
            const Image truth = convolved(light, kernel, w);
            for (const double error : {0.1, 0.01, 0.001}) {
                SpriteOptions options;
                options.error = error;
                Sprites sprites(150, 110, 3, kernel, options);
                Image out(150, 110, 3);
                const SpriteReport report = sprites.apply(light, out, w);
                EXPECT_LE(report.error_bound, error * report.energy);
                const double measured = relative_error(out, truth, light, w);
                EXPECT_LE(measured, report.error_bound / report.energy + 2e-6)
                    << seed << " " << error;
                EXPECT_LE(report.sprites, report.bright_pixels);
            }
        }
    }
}

// Kernels that reach across the picture: their far part is drawn on a coarse raster.
TEST(Sprites, LargeKernelsStayWithinTheErrorToo) {
    constexpr int kWidth = 560;
    constexpr int kHeight = 530;
    Image kernel(2 * kWidth - 1, 2 * kHeight - 1, 1);
    double sum = 0;
    for (int y = 0; y < kernel.height(); ++y) {
        for (int x = 0; x < kernel.width(); ++x) {
            const double dx = x - kernel.width() / 2;
            const double dy = y - kernel.height() / 2;
            const double r2 = dx * dx + dy * dy;
            // Streaks across all of it: they are what a coarse raster gets wrong first.
            const double streak = std::exp(-std::pow(dy + 0.1 * dx, 2) / (2 + 1e-3 * r2));
            kernel.at(x, y) = static_cast<float>((1 + 2 * streak) / std::pow(1 + r2, 1.1));
            sum += static_cast<double>(kernel.at(x, y));
        }
    }
    for (std::size_t i = 0; i < kernel.pixels(); ++i) {
        kernel.plane(0)[i] /= static_cast<float>(sum);
    }
    const Image light = lights_over_ground(kWidth, kHeight, 12);
    const Image weights = some_weights(kWidth, kHeight);
    const Image truth = convolved(light, kernel, weights.plane(0));
    for (const double error : {0.1, 0.02}) {
        SpriteOptions options;
        options.error = error;
        Sprites sprites(kWidth, kHeight, 3, kernel, options);
        Image out(kWidth, kHeight, 3);
        const SpriteReport report = sprites.apply(light, out, weights.plane(0));
        EXPECT_LE(report.error_bound, error * report.energy);
        EXPECT_LE(relative_error(out, truth, light, weights.plane(0)),
                  report.error_bound / report.energy + 2e-6);
        EXPECT_GT(report.far_sprites, 0U);
        EXPECT_LT(report.far_sprites * 4, report.bright_pixels);
    }
}

// One pixel at a time there is no clustering, and what is cut is below the error asked for.
TEST(Sprites, SinglePixelsAreTheKernel) {
    const Image kernel = needle_kernel(31, 5, 1);
    Image light(64, 48, 3);
    light.at(20, 17, 0) = 3;
    light.at(20, 17, 1) = 2;
    light.at(63, 0, 2) = 7;
    SpriteOptions options;
    options.error = 1e-9;
    Sprites sprites(64, 48, 3, kernel, options);
    Image out(64, 48, 3);
    const SpriteReport report = sprites.apply(light, out);
    EXPECT_EQ(report.sprites, 2U);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                double sum = 0;
                for (const auto& [sx, sy] : {std::pair{20, 17}, {63, 0}}) {
                    const int u = x - sx + 15;
                    const int v = y - sy + 15;
                    if (u < 0 || v < 0 || u > 30 || v > 30) continue;
                    sum += static_cast<double>(light.at(sx, sy, c)) * kernel.at(u, v, c);
                }
                EXPECT_NEAR(out.at(x, y, c), sum, 1e-6 * std::abs(sum) + 1e-9);
            }
        }
    }
}

// A sprite that ended at once would draw its outline.
TEST(Sprites, FadeOutWhereTheyEnd) {
    const Image kernel = needle_kernel(301, 3, 0);
    Image light(301, 301, 3);
    for (int c = 0; c < 3; ++c) light.at(150, 150, c) = 1000;
    SpriteOptions options;
    options.error = 0.2;
    Sprites sprites(301, 301, 3, kernel, options);
    Image out(301, 301, 3);
    sprites.apply(light, out);
    const auto share = [&](int x) {
        return static_cast<double>(out.at(x, 150, 1)) / (1000 * kernel.at(x, 150, 1));
    };
    int end = 151;
    while (out.at(end, 150, 1) > 0) ++end;
    ASSERT_LT(end, 290);
    EXPECT_NEAR(share(150 + (end - 150) / 2), 1, 1e-4);
    EXPECT_LT(share(end - 1), 0.01);
    for (int x = 151; x < end; ++x) {
        EXPECT_LT(std::abs(share(x) - share(x - 1)), 8.0 / (end - 150)) << x;
    }
}

// The paper's own: even cells are exact, in any size of cell.
TEST(Sprites, ClustersOfThePaperAreExactForEvenLight) {
    const Image kernel = needle_kernel(33, 6, 1);
    Image light(80, 70, 3);
    for (int y = 13; y < 60; ++y) {
        for (int x = 9; x < 71; ++x) {
            for (int c = 0; c < 3; ++c) light.at(x, y, c) = 4;
        }
    }
    const Image truth = convolved(light, kernel, nullptr);
    for (const int side : {1, 2, 4, 16}) {
        for (const bool tree : {true, false}) {
            SpriteOptions options;
            options.error = 1e-7;
            options.clusters.criterion = Criterion::kSimilarColor;
            options.clusters.max_side = side;
            options.clusters.tree = tree;
            Sprites sprites(80, 70, 3, kernel, options);
            Image out(80, 70, 3);
            const SpriteReport report = sprites.apply(light, out);
            EXPECT_LT(relative_error(out, truth, light, nullptr), 2e-6) << side;
            EXPECT_LE(report.sprites * (side > 1 ? 2 : 1), report.bright_pixels);
        }
    }
}

// Where light ends with its sprites, and where it leaves the picture, is all that is missing.
TEST(Sprites, AccountForWhatIsCut) {
    const Image kernel = needle_kernel(201, 7, 0.2);
    Image light(400, 400, 3);
    for (int c = 0; c < 3; ++c) light.at(200, 200, c) = 1000;
    SpriteOptions options;
    options.error = 0.2;
    Sprites sprites(400, 400, 3, kernel, options);
    Image out(400, 400, 3);
    const SpriteReport report = sprites.apply(light, out);
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < out.pixels(); ++i) {
            sum += static_cast<double>(out.plane(c)[i]);
        }
    }
    EXPECT_GT(report.energy_cut, 0.02 * report.energy);
    EXPECT_LE(report.energy_cut, 0.05 * report.energy);
    EXPECT_NEAR(3000 - sum, report.energy_cut, 0.2 * report.energy_cut);
    EXPECT_LE(3000 - sum, report.energy_cut);
    EXPECT_LT(report.pixels_drawn, 150 * 150);
}

TEST(Sprites, AreTheSameForAnyNumberOfThreads) {
    const Image light = lights_over_ground(600, 100, 3);
    const Image kernel = needle_kernel(65, 3, 0.2);
    const auto drawn = [&] {
        Sprites sprites(600, 100, 3, kernel);
        Image out(600, 100, 3);
        sprites.apply(light, out);
        return out;
    };
    const Image all = drawn();
    const ThreadLimit one(1);
    const Image single = drawn();
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < all.pixels(); ++i) {
            ASSERT_EQ(all.plane(c)[i], single.plane(c)[i]);
        }
    }
}

TEST(Sprites, RefuseWhatMakesNoSense) {
    const Image kernel = needle_kernel(5, 1, 0);
    EXPECT_THROW(Sprites(0, 4, 3, kernel), InvalidArgument);
    EXPECT_THROW(Sprites(4, 4, 2, kernel), InvalidArgument);
    EXPECT_THROW(Sprites(4, 4, 1, kernel), InvalidArgument);
    EXPECT_THROW(Sprites(4, 4, 3, {}), InvalidArgument);
    SpriteOptions options;
    options.error = 0;
    EXPECT_THROW(Sprites(4, 4, 3, kernel, options), InvalidArgument);
    options = {};
    options.clusters.criterion = Criterion::kSimilarColor;
    EXPECT_THROW(Sprites(4, 4, 3, Image(1027, 3, 3), options), InvalidArgument);
}

}  // namespace
}  // namespace aureole::glare
