#include "aureole/io/supersampling.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "io/exr_bytes.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

Picture picture_of(int width, int height) {
    Image image(width, height, 5);
    for (int c = 0; c < 5; ++c) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                image.at(x, y, c) = static_cast<float>(x + 10 * y + 1000 * c);
            }
        }
    }
    return Picture(std::move(image), {"R", "G", "B", "A", "Z"});
}

TEST(Supersampling, AveragesColourAndAlphaAndKeepsOneOfTheOthers) {
    Picture picture = picture_of(6, 9);
    picture.set_data_origin(-3, 6);
    picture.set_display_window({0, 3, 3, 6});
    picture.set_attribute("owner", "somebody");
    average_samples(picture, 3);
    EXPECT_EQ(picture.data_window(), (Window{-1, 2, 2, 3}));
    EXPECT_EQ(picture.display_window(), (Window{0, 1, 1, 2}));
    EXPECT_EQ(picture.string_attribute("owner"), "somebody");
    for (int c = 0; c < 5; ++c) {  // the mean of a plane and its middle sample are the same
        EXPECT_EQ(picture.image().at(1, 2, c), static_cast<float>(4 + 70 + 1000 * c)) << c;
    }
    Picture even = picture_of(4, 4);
    average_samples(even, 2);
    EXPECT_EQ(even.image().at(1, 0, 3), static_cast<float>(2.5 + 5 + 3000));
    EXPECT_EQ(even.image().at(1, 0, 4), static_cast<float>(3 + 10 + 4000));
}

// All of these ids are the same number as floats.
TEST(Supersampling, KeepsIdsToTheLastBit) {
    const ExrBytes exr{{0, 0, 3, 3},
                       {0, 0, 3, 3},
                       {{"Y", ExrBytes::kFloat, [](int, int) { return little_endian(1.0F); }},
                        {"id", ExrBytes::kUint,
                         [](int x, int y) {
                             return little_endian(4000000001U + static_cast<unsigned>(x + 4 * y));
                         }}},
                       ""};
    const TemporaryFolder folder;
    write_bytes(folder.file("in.exr"), exr.bytes());
    Picture picture = read_picture(folder.file("in.exr"));
    average_samples(picture, 2);
    write_picture(folder.file("out.exr"), picture);
    const auto input = OIIO::ImageInput::open(folder.file("out.exr"));
    ASSERT_TRUE(input);
    const int id = input->spec().channelindex("id");
    std::vector<std::uint32_t> ids(4);
    ASSERT_TRUE(input->read_image(0, 0, id, id + 1, OIIO::TypeUInt32, ids.data()));
    EXPECT_EQ(ids,
              (std::vector<std::uint32_t>{4000000006U, 4000000008U, 4000000014U, 4000000016U}));
}

TEST(Supersampling, ByOneChangesNothing) {
    Picture picture = picture_of(5, 3);
    average_samples(picture, 1);
    EXPECT_EQ(picture.data_window(), (Window{0, 0, 5, 3}));
}

TEST(Supersampling, RefusesWindowsThatDoNotDivide) {
    Picture odd = picture_of(5, 4);
    EXPECT_THROW(average_samples(odd, 2), InvalidArgument);
    EXPECT_THROW(average_samples(odd, 0), InvalidArgument);
    Picture shifted = picture_of(4, 4);
    shifted.set_data_origin(1, 0);
    EXPECT_THROW(average_samples(shifted, 2), InvalidArgument);
    Picture framed = picture_of(4, 4);
    framed.set_display_window({0, 0, 3, 4});
    EXPECT_THROW(average_samples(framed, 2), InvalidArgument);
    EXPECT_EQ(framed.image().width(), 4);
}

}  // namespace
}  // namespace aureole::io
