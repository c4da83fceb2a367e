#include "aureole/sources/brightness_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/sources/bright_area.h"
#include "aureole/sources/brightness.h"

namespace aureole::sources {
namespace {

Image noise(int width, int height) {
    Image image(width, height, 3);
    Random random(11);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.log_uniform(1e-4, 1e3)) *
                                (random.uniform() < 0.1 ? -1.0F : 1.0F);
        }
    }
    return image;
}

struct Above {
    double pixels = 0;
    double energy_below = 0;
    double energy = 0;
};

Above counted(const Image& image, const float* weights, float limit) {
    Above sum;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        double amount = 0;
        float largest = 0;
        for (int c = 0; c < image.channels(); ++c) {
            const float value = std::abs(image.plane(c)[i]);
            amount += static_cast<double>(value);
            largest = std::max(largest, value);
        }
        if (weights != nullptr) amount *= static_cast<double>(weights[i]);
        sum.energy += amount;
        if (largest > limit) {
            sum.pixels += 1;
        } else {
            sum.energy_below += amount;
        }
    }
    return sum;
}

TEST(BrightnessHistogram, CountsWhatIsOnEitherSideOfALimit) {
    const Image image = noise(150, 200);
    std::vector<float> weights(image.pixels());
    Random random(2);
    for (float& w : weights) w = static_cast<float>(random.uniform(0.1, 1));
    BrightnessHistogram histogram;
    for (const float* w :
         {static_cast<const float*>(nullptr), static_cast<const float*>(weights.data())}) {
        histogram.measure(image, w);
        for (const double share : {0.0, 0.001, 0.1, 0.7}) {
            const float limit = histogram.dim_limit(share);
            const Above truth = counted(image, w, limit);
            EXPECT_NEAR(histogram.energy() / truth.energy, 1, 1e-6);
            EXPECT_EQ(histogram.pixels_above(limit), truth.pixels);
            EXPECT_LE(truth.energy_below, share * truth.energy * (1 + 1e-6));
            const Above more = counted(image, w, 1.05F * limit);
            if (share > 0) {
                EXPECT_GT(more.energy_below, share * truth.energy * (1 - 1e-6));
            }
        }
    }
}

TEST(BrightnessHistogram, OfDarknessHasNothingAboveItsLimit) {
    BrightnessHistogram histogram;
    histogram.measure(Image(20, 10, 3), nullptr);
    EXPECT_TRUE(std::isfinite(histogram.dim_limit(0.1)));
    EXPECT_EQ(histogram.pixels_above(histogram.dim_limit(0.1)), 0);
    EXPECT_EQ(histogram.energy(), 0);
}

TEST(BrightnessHistogram, KnowsWhereLightIs) {
    Image image(70, 50, 1);
    image.at(17, 33, 0) = -2;
    image.at(69, 49, 0) = 1;
    BrightnessHistogram histogram;
    histogram.look(image, nullptr);
    EXPECT_TRUE(histogram.may_be_above(1.5F, -5, -5, 18, 34));
    EXPECT_TRUE(histogram.may_be_above(1.5F, 31, 47, 32, 48));
    EXPECT_FALSE(histogram.may_be_above(1.5F, 0, 0, 16, 50));
    EXPECT_FALSE(histogram.may_be_above(1.5F, 32, 0, 200, 200));
    EXPECT_TRUE(histogram.may_be_above(0.5F, 32, 0, 200, 200));
}

// Lights over a ground that is dark in half of the blocks.
Image lights(int width, int height) {
    Image image = noise(width, height);
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                image.at(x, y, c) *= x < width / 2 ? 1e-9F : (y < height / 2 ? 1e-3F : 1.0F);
            }
        }
    }
    return image;
}

TEST(BrightnessHistogram, BoundsFromBlocksHoldForPixels) {
    const Image image = lights(203, 150);
    BrightnessHistogram histogram;
    for (const double share : {0.0, 1e-7, 1e-4, 0.01, 0.3}) {
        histogram.look(image, nullptr);
        const float most = histogram.dim_limit(share);
        const double least_pixels = histogram.pixels_above(most);
        histogram.count(image, nullptr, share);
        EXPECT_GE(most, histogram.dim_limit(share));
        EXPECT_LE(least_pixels, histogram.pixels_above(histogram.dim_limit(share)));
    }
}

// Blocks that are left out because no limit is within them change nothing.
TEST(BrightnessHistogram, OfSomeSharesIsThatOfAll) {
    const Image image = lights(203, 150);
    BrightnessHistogram all;
    all.measure(image, nullptr);
    for (const double least : {1e-6, 1e-3, 0.05}) {
        BrightnessHistogram some;
        some.measure(image, nullptr, least);
        EXPECT_LT(some.blocks_to_count(least), all.blocks_to_count(0));
        for (const double share : {least, 2 * least, 0.5}) {
            EXPECT_EQ(some.dim_limit(share), all.dim_limit(share)) << least << " " << share;
            EXPECT_EQ(some.pixels_above(some.dim_limit(share)),
                      all.pixels_above(all.dim_limit(share)));
        }
    }
}

TEST(BrightnessHistogram, OfSomeBlocksEstimatesAll) {
    const Image image = noise(400, 301);
    BrightnessHistogram all;
    all.measure(image, nullptr);
    BrightnessHistogram some;
    some.look(image, nullptr);
    some.count(image, nullptr, 0, 8);
    EXPECT_NEAR(some.pixels_above(some.dim_limit(0.2)) / all.pixels_above(all.dim_limit(0.2)), 1,
                0.1);
    EXPECT_THROW(some.count(image, nullptr, 0, 0), InvalidArgument);
    EXPECT_THROW(some.count(image, nullptr, -0.1), InvalidArgument);
    EXPECT_THROW(static_cast<void>(some.dim_limit(1.5)), InvalidArgument);
}

// The planes of a picture, or pixel by pixel: the same.
TEST(BrightnessHistogram, DoesNotDependOnTheOrderInMemory) {
    const Image planar = noise(67, 33);
    std::vector<float> pixels(3 * planar.pixels());
    for (std::size_t i = 0; i < planar.pixels(); ++i) {
        for (int c = 0; c < 3; ++c) {
            pixels[3 * i + static_cast<std::size_t>(c)] = planar.plane(c)[i];
        }
    }
    ConstImageView interleaved = planar;
    interleaved.data = pixels.data();
    interleaved.pixel_stride = 3;
    interleaved.row_stride = 3 * planar.width();
    interleaved.channel_stride = 1;
    BrightnessHistogram a;
    BrightnessHistogram b;
    a.measure(planar, nullptr);
    b.measure(interleaved, nullptr);
    EXPECT_NEAR(b.energy() / a.energy(), 1, 1e-6);
    for (const double share : {0.001, 0.3}) EXPECT_EQ(a.dim_limit(share), b.dim_limit(share));
}

TEST(BrightShare, RisesSmoothlyFromNothingToAll) {
    EXPECT_EQ(bright_share(1, 1, 2), 0);
    EXPECT_EQ(bright_share(2, 1, 2), 1);
    EXPECT_EQ(bright_share(1.5F, 1, 2), 0.5F);
    constexpr int kSteps = 1000;
    float before = 0;
    for (int i = 0; i <= 3 * kSteps; ++i) {
        const float share = bright_share(static_cast<float>(i) / kSteps, 1, 2);
        EXPECT_GE(share, before);
        EXPECT_LE(share - before, 1.6F / kSteps);
        before = share;
    }
    // Without a range it is a step above the limit.
    EXPECT_EQ(bright_share(1, 1, 0), 0);
    EXPECT_EQ(bright_share(1.001F, 1, 0), 1);
}

TEST(BrightArea, CountsBlocksPixelsAndEdges) {
    Image image(100, 80, 3);
    // 6 x 5 pixels in one block; a single one.
    for (int y = 18; y < 23; ++y) {
        for (int x = 34; x < 40; ++x) image.at(x, y, 1) = 3;
    }
    image.at(99, 79, 2) = -3;
    BrightnessHistogram histogram;
    histogram.look(image, nullptr);
    const BrightArea area = bright_area(image, histogram, 1);
    EXPECT_EQ(area.blocks, 2);
    EXPECT_EQ(area.pixels, 31);
    EXPECT_EQ(area.edge_pixels, 30 - 4 * 3 + 1);
    EXPECT_EQ(bright_area(image, histogram, 4).blocks, 0);
}

TEST(BrightArea, OfSomeBlocksEstimatesAll) {
    const Image image = noise(640, 480);
    BrightnessHistogram histogram;
    histogram.look(image, nullptr);
    const BrightArea all = bright_area(image, histogram, 1);
    const BrightArea some = bright_area(image, histogram, 1, 8);
    EXPECT_NEAR(some.blocks / all.blocks, 1, 0.05);
    EXPECT_NEAR(some.pixels / all.pixels, 1, 0.05);
    EXPECT_NEAR(some.edge_pixels / all.edge_pixels, 1, 0.05);
}

}  // namespace
}  // namespace aureole::sources
