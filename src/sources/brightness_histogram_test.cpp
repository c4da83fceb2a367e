#include "aureole/sources/brightness_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"

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
    histogram.measure(image, nullptr);
    EXPECT_EQ(histogram.blocks_above(1.5F), 1);
    EXPECT_EQ(histogram.blocks_above(0.5F), 2);
    EXPECT_TRUE(histogram.may_be_above(1.5F, -5, -5, 18, 34));
    EXPECT_TRUE(histogram.may_be_above(1.5F, 31, 47, 32, 48));
    EXPECT_FALSE(histogram.may_be_above(1.5F, 0, 0, 16, 50));
    EXPECT_FALSE(histogram.may_be_above(1.5F, 32, 0, 200, 200));
    EXPECT_TRUE(histogram.may_be_above(0.5F, 32, 0, 200, 200));
    histogram.measure(image, nullptr, 2);
    EXPECT_TRUE(histogram.may_be_above(5, 0, 0, 1, 1));
}

TEST(BrightnessHistogram, OfSomeRowsEstimatesAll) {
    const Image image = noise(400, 301);
    BrightnessHistogram all;
    all.measure(image, nullptr);
    BrightnessHistogram some;
    some.measure(image, nullptr, 8);
    EXPECT_NEAR(some.energy() / all.energy(), 1, 0.1);
    EXPECT_NEAR(some.pixels_above(some.dim_limit(0.2)) / all.pixels_above(all.dim_limit(0.2)), 1,
                0.1);
    EXPECT_THROW(some.measure(image, nullptr, 0), InvalidArgument);
    EXPECT_THROW(static_cast<void>(some.dim_limit(1.5)), InvalidArgument);
}

}  // namespace
}  // namespace aureole::sources
