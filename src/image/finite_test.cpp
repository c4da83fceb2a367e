#include "aureole/image/finite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace aureole {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(ReplaceNonfinite, CountsPixelsNotSamples) {
    Image image(5, 4, 3);
    for (int c = 0; c < 3; ++c) image.at(2, 1, c) = kNan;  // one pixel, three samples
    image.at(4, 3, 1) = kInf;
    image.at(0, 0, 2) = -kInf;
    EXPECT_EQ(replace_nonfinite(image), 3U);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(2, 1, c), 0.0F);
    EXPECT_EQ(image.at(4, 3, 1), 0.0F);
    EXPECT_EQ(image.at(0, 0, 2), 0.0F);
    EXPECT_EQ(replace_nonfinite(image), 0U);
}

TEST(ReplaceNonfinite, KeepsEveryFiniteValue) {
    const std::vector<float> values = {-1.5F,
                                       -0.0F,
                                       0.0F,
                                       std::numeric_limits<float>::max(),
                                       std::numeric_limits<float>::lowest(),
                                       std::numeric_limits<float>::denorm_min(),
                                       1.0F};
    std::vector<float> data = values;
    data.push_back(kNan);  // so that the row is not skipped
    EXPECT_EQ(replace_nonfinite(interleaved_view(data.data(), 8, 1, 1)), 1U);
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(data[i], values[i]);
        EXPECT_EQ(std::signbit(data[i]), std::signbit(values[i]));
    }
}

TEST(ReplaceNonfinite, SeesOnlyTheChannelsOfTheView) {
    std::vector<float> data = {1, kNan, kInf, 2, 3, 4, kNan, 5};  // two pixels of four channels
    const ImageView all = interleaved_view(data.data(), 2, 1, 4);
    EXPECT_EQ(replace_nonfinite(all.channel_range(0, 2)), 1U);
    EXPECT_EQ(data[1], 0.0F);
    EXPECT_EQ(data[2], kInf);
    EXPECT_TRUE(std::isnan(data[6]));
    EXPECT_EQ(replace_nonfinite(all), 2U);
}

}  // namespace
}  // namespace aureole
