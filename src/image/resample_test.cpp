#include "aureole/image/resample.h"

#include <gtest/gtest.h>

#include <vector>

#include "aureole/base/error.h"

namespace aureole {
namespace {

// In planar and interleaved memory.
TEST(AreaAverage, IsTheMeanOfEachBlock) {
    Image picture(6, 4, 2);
    std::vector<float> interleaved;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 6; ++x) {
            for (int c = 0; c < 2; ++c) {
                picture.at(x, y, c) = static_cast<float>((c == 0 ? 1 : -2) * (x + 10 * y));
                interleaved.push_back(picture.at(x, y, c));
            }
        }
    }
    for (const ConstImageView& view :
         {ConstImageView(picture), ConstImageView(interleaved_view(interleaved.data(), 6, 4, 2))}) {
        const Image mean = area_average(view, 2);
        ASSERT_EQ(mean.width(), 3);
        ASSERT_EQ(mean.height(), 2);
        // Blocks begin at (2 x, 2 y); the mean of a plane is its value in their middle.
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) {
                const auto middle = static_cast<float>((2 * x + 0.5) + 10 * (2 * y + 0.5));
                EXPECT_EQ(mean.at(x, y, 0), middle);
                EXPECT_EQ(mean.at(x, y, 1), -2 * middle);
            }
        }
    }
}

TEST(AreaAverage, RefusesPicturesThatDoNotDivide) {
    const Image picture(6, 4, 1);
    EXPECT_EQ(area_average(picture, 1).width(), 6);
    EXPECT_THROW(area_average(picture, 3), InvalidArgument);
    EXPECT_THROW(area_average(picture, 4), InvalidArgument);
    EXPECT_THROW(area_average(picture, 0), InvalidArgument);
}

}  // namespace
}  // namespace aureole
