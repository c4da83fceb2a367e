#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/color/rgb.h"
#include "aureole/image/finite.h"
#include "aureole/io/field_of_view.h"
#include "aureole/io/picture.h"
#include "io/exr_bytes.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& path) {
    try {
        read_picture(path);
    } catch (const FileError& error) {
        EXPECT_EQ(error.file(), path);
        return error.what();
    }
    return "";
}

void write_with_oiio(const std::string& path, const OIIO::ImageSpec& spec,
                     const std::vector<float>& data) {
    const auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output && output->open(path, spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data())) << output->geterror();
    ASSERT_TRUE(output->close());
}

// All three sample types, windows that differ, negative coordinates, metadata: from bytes.
TEST(ReadPicture, UnderstandsExrFromItsBytes) {
    ExrBytes exr{
        {-3, -2, 8, 20},
        {0, 1, 5, 9},
        {{"A", ExrBytes::kHalf, [](int, int) { return std::string("\x00\x38", 2); }},
         {"B", ExrBytes::kFloat,
          [](int x, int y) { return little_endian(-100.5F * float(x) + float(y)); }},
         {"G", ExrBytes::kHalf, [](int, int) { return std::string("\x00\x7c", 2); }},
         {"R", ExrBytes::kHalf, [](int, int) { return std::string("\x01\x00", 2); }},
         {"id", ExrBytes::kUint,
          [](int x, int y) { return little_endian(4000000001U + static_cast<unsigned>(x + y)); }}},
        ExrBytes::attribute("aureole:fov_deg", "float", little_endian(25.0F)) +
            ExrBytes::attribute("shot", "string", "night 12")};
    const TemporaryFolder folder;
    const std::string path = folder.file("hand.exr");
    write_bytes(path, exr.bytes());

    const Picture picture = read_picture(path);
    EXPECT_EQ(picture.data_window(), (Window{-3, -2, 12, 23}));
    EXPECT_EQ(picture.display_window(), (Window{0, 1, 6, 9}));
    EXPECT_EQ(picture.pixel_aspect_ratio(), 2);
    EXPECT_EQ(picture.channel_names(), (std::vector<std::string>{"R", "G", "B", "A", "id"}));
    EXPECT_EQ(picture.float_attribute("aureole:fov_deg"), 25.0F);
    EXPECT_EQ(picture.float_attribute("screenWindowWidth"), 0.5F);
    EXPECT_EQ(picture.string_attribute("shot"), "night 12");
    EXPECT_EQ(field_of_view(picture)->deg, 25);
    for (int y = 0; y < 23; ++y) {
        for (int x = 0; x < 12; ++x) {
            ASSERT_EQ(picture.image().at(x, y, 0), std::ldexp(1.0F, -24));  // smallest half
            ASSERT_EQ(picture.image().at(x, y, 1), INFINITY);
            ASSERT_EQ(picture.image().at(x, y, 2),
                      -100.5F * static_cast<float>(x - 3) + static_cast<float>(y - 2));
            ASSERT_EQ(picture.image().at(x, y, 3), 0.5F);
            ASSERT_EQ(picture.image().at(x, y, 4), 4e9F);
        }
    }

    // Ids survive to the last bit although float cannot hold them; half stays half.
    const std::string copy = folder.file("copy.exr");
    write_picture(copy, picture);
    const auto input = OIIO::ImageInput::open(copy);
    ASSERT_TRUE(input);
    const int id = input->spec().channelindex("id");
    EXPECT_EQ(input->spec().channelformat(id), OIIO::TypeUInt32);
    EXPECT_EQ(input->spec().channelformat(input->spec().channelindex("A")), OIIO::TypeHalf);
    std::vector<std::uint32_t> ids(12 * 23);
    ASSERT_TRUE(input->read_image(0, 0, id, id + 1, OIIO::TypeUInt32, ids.data()));
    EXPECT_EQ(ids[0], 4000000001U - 5);
    EXPECT_EQ(ids[12 * 23 - 1], 4000000001U + 28);
}

TEST(ReadPicture, ReadsTilesLikeScanLines) {
    const TemporaryFolder folder;
    const int width = 37;
    const int height = 531;
    std::vector<float> data(static_cast<std::size_t>(width * height * 4));
    for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<float>(i);
    OIIO::ImageSpec spec(width, height, 4, OIIO::TypeFloat);
    spec.x = -7;
    spec.y = 11;
    write_with_oiio(folder.file("lines.exr"), spec, data);
    spec.tile_width = 16;
    spec.tile_height = 24;
    write_with_oiio(folder.file("tiles.exr"), spec, data);
    const Picture lines = read_picture(folder.file("lines.exr"));
    const Picture tiles = read_picture(folder.file("tiles.exr"));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 4; ++c) {
                ASSERT_EQ(tiles.image().at(x, y, c), static_cast<float>((y * width + x) * 4 + c));
                ASSERT_EQ(lines.image().at(x, y, c), tiles.image().at(x, y, c));
            }
        }
    }
    write_picture(folder.file("again.exr"), tiles);  // tiles become scan lines
    EXPECT_EQ(read_picture(folder.file("again.exr")).image().at(36, 530, 3),
              tiles.image().at(36, 530, 3));
}

// 8 and 16 bit: through the sRGB curve. Floating point: untouched.
TEST(ReadPicture, DecodesIntegersFromSrgb) {
    const TemporaryFolder folder;
    const float encoded = 55.0F / 255.0F;  // exact in 8 and 16 bits
    for (const char* name : {"a8.png", "a16.png", "a8.tif", "a16.tif", "a32.tif"}) {
        const bool bytes = std::string(name).find('8') != std::string::npos;
        const bool floats = std::string(name).find("32") != std::string::npos;
        const OIIO::ImageSpec spec(4, 4, 3,
                                   floats  ? OIIO::TypeFloat
                                   : bytes ? OIIO::TypeUInt8
                                           : OIIO::TypeUInt16);
        write_with_oiio(folder.file(name), spec, std::vector<float>(48, encoded));
        const Picture picture = read_picture(folder.file(name));
        EXPECT_EQ(picture.color_channels(), 3);
        EXPECT_NEAR(picture.image().at(3, 3, 2), floats ? encoded : color::srgb_decode(encoded),
                    1e-7)
            << name;
    }
    OIIO::ImageSpec linear(4, 4, 1, OIIO::TypeUInt8);
    linear.attribute("oiio:ColorSpace", "Linear");
    write_with_oiio(folder.file("linear.png"), linear, std::vector<float>(16, encoded));
    EXPECT_NEAR(read_picture(folder.file("linear.png")).image().at(0, 0), encoded, 1e-7);
}

// What is transparent sends no light: colour stored unmultiplied is multiplied after decoding.
TEST(ReadPicture, MultipliesAlphaThatPngKeepsApart) {
    const TemporaryFolder folder;
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    write_with_oiio(folder.file("a.png"), spec, {1, 1, 0.2F, 0.6F, 1, 1, 1, 0});
    const Picture picture = read_picture(folder.file("a.png"));
    EXPECT_NEAR(picture.image().at(0, 0, 0), 0.6F, 1e-6);
    EXPECT_NEAR(picture.image().at(0, 0, 2), 0.6F * color::srgb_decode(0.2F), 1e-6);
    EXPECT_NEAR(picture.image().at(0, 0, 3), 0.6F, 1e-6);
    EXPECT_EQ(picture.image().at(1, 0, 0), 0.0F);
}

TEST(ReadPicture, GreyTwoAndFiveChannels) {
    const TemporaryFolder folder;
    for (const char* extension : {"exr", "tif"}) {
        for (const int channels : {1, 2, 4, 5}) {
            const std::string path = folder.file("c." + std::string(extension));
            std::vector<float> data;
            for (int i = 0; i < 6 * channels; ++i) data.push_back(static_cast<float>(i % channels));
            OIIO::ImageSpec spec(3, 2, channels, OIIO::TypeFloat);
            if (channels == 2) spec.channelnames = {"Y", "A"};
            if (channels == 2) spec.alpha_channel = 1;
            write_with_oiio(path, spec, data);
            const Picture picture = read_picture(path);
            EXPECT_EQ(picture.image().channels(), channels);
            EXPECT_EQ(picture.color_channels(), channels < 3 ? 1 : 3);
            for (int c = 0; c < channels; ++c) {
                EXPECT_EQ(picture.image().at(2, 1, c), static_cast<float>(c)) << path << channels;
            }
        }
    }
}

// A file whose first row is the right side of the picture, its first column the top (Exif 6: what
// cameras held upright write), and the other seven.
TEST(ReadPicture, TurnsPicturesUpright) {
    const TemporaryFolder folder;
    const std::string path = folder.file("o.tif");
    // For each orientation, the values of the upright picture, row by row; the file holds 1 2 / 3 4
    // / 5 6.
    const std::vector<std::vector<float>> upright = {
        {1, 2, 3, 4, 5, 6}, {2, 1, 4, 3, 6, 5}, {6, 5, 4, 3, 2, 1}, {5, 6, 3, 4, 1, 2},
        {1, 3, 5, 2, 4, 6}, {5, 3, 1, 6, 4, 2}, {6, 4, 2, 5, 3, 1}, {2, 4, 6, 1, 3, 5}};
    for (int orientation = 1; orientation <= 8; ++orientation) {
        OIIO::ImageSpec spec(2, 3, 1, OIIO::TypeFloat);
        spec.attribute("Orientation", orientation);
        write_with_oiio(path, spec, {1, 2, 3, 4, 5, 6});
        const Picture picture = read_picture(path);
        ASSERT_EQ(picture.image().width(), orientation >= 5 ? 3 : 2);
        ASSERT_EQ(picture.display_window(), picture.data_window());
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_EQ(picture.image().plane(0)[i],
                      upright[static_cast<std::size_t>(orientation - 1)][i])
                << orientation;
        }
    }
}

TEST(ReadPicture, RefusesWhatIsNotAPicture) {
    const TemporaryFolder folder;
    EXPECT_THAT(error_of(folder.file("missing.exr")), HasSubstr("no such file"));
    EXPECT_THAT(error_of(folder.file("")), HasSubstr("folder"));
    for (const char* name : {"zero.exr", "zero.png"}) {
        write_bytes(folder.file(name), "");
        EXPECT_THAT(error_of(folder.file(name)), HasSubstr("empty"));
    }
    for (const char* name :
         {"text.exr", "text.hdr", "text.tif", "text.png", "text.jpg", "text.txt"}) {
        write_bytes(folder.file(name), "this is not a picture\n");
        EXPECT_THAT(error_of(folder.file(name)), HasSubstr("cannot be read as a picture"));
    }
}

TEST(ReadPicture, RefusesZeroSize) {
    const TemporaryFolder folder;
    const ExrBytes exr{{0, 0, -1, -1},
                       {0, 0, -1, -1},
                       {{"Y", ExrBytes::kFloat, [](int, int) { return little_endian(1.0F); }}},
                       ""};
    write_bytes(folder.file("none.exr"), exr.bytes());
    EXPECT_NE(error_of(folder.file("none.exr")), "");
}

// Cut anywhere, a file is an error and never a half-black picture.
TEST(ReadPicture, RefusesTruncatedFiles) {
    const TemporaryFolder folder;
    Image image = noise(61, 83, 3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = std::abs(image.plane(c)[i]) / 1e3F;
        }
    }
    for (const char* name : {"a.exr", "a.hdr", "a.tif", "a.png", "a.jpg"}) {
        const std::string path = folder.file(name);
        write_picture(path, Picture(image));
        const std::string whole = read_bytes(path);
        for (const double part : {0.02, 0.3, 0.6, 0.95}) {
            const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
            write_bytes(path, whole.substr(0, size));
            EXPECT_NE(error_of(path), "") << name << ' ' << part;
        }
    }
}

std::string shared_image(const std::string& name) {
    const char* const folder = std::getenv("AUREOLE_TEST_IMAGES");
    return folder == nullptr ? "" : std::string(folder) + "/" + name;
}

TEST(ReadPicture, StillLife) {
    const std::string path = shared_image("still_life.exr");
    if (path.empty()) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    const Picture picture = read_picture(path);
    EXPECT_EQ(picture.data_window(), (Window{0, 0, 1240, 846}));
    EXPECT_EQ(picture.alpha_channel(), 3);
    EXPECT_EQ(field_of_view(picture)->source, "screenWindowWidth");
    EXPECT_NEAR(field_of_view(picture)->deg, 25.36, 0.01);
    EXPECT_EQ(picture.string_attribute("DateTime"), "2002:06:23 21:30:10");
}

TEST(ReadPicture, BrightRingsHaveTwelvePixelsThatAreNotFinite) {
    const std::string path = shared_image("bright_rings_nan_inf.exr");
    if (path.empty()) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    Picture picture = read_picture(path);
    EXPECT_EQ(replace_nonfinite(picture.color()), 12U);
    EXPECT_EQ(replace_nonfinite(picture.color()), 0U);
}

TEST(ReadPicture, VeniceSunset) {
    const std::string path = shared_image("venice_sunset_1k.hdr");
    if (path.empty()) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    const Picture picture = read_picture(path);
    EXPECT_EQ(picture.data_window(), (Window{0, 0, 1024, 512}));
    float largest = 0;
    for (std::size_t i = 0; i < 3 * picture.image().pixels(); ++i) {
        largest = std::max(largest, picture.image().plane(0)[i]);
    }
    EXPECT_NEAR(largest, 6496, 1);
}

}  // namespace
}  // namespace aureole::io
