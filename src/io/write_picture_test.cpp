#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/color/rgb.h"
#include "aureole/io/picture.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const std::string& path, const Picture& picture) {
    try {
        write_picture(path, picture);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(WritePicture, FloatExrIsExact) {
    const TemporaryFolder folder;
    Picture picture(noise(67, 531, 5), {"R", "G", "B", "A", "Z"});
    picture.image().at(5, 5, 4) = INFINITY;
    picture.image().at(6, 5, 0) = 1e30F;
    picture.set_data_origin(-5, -9);
    picture.set_display_window({0, 0, 57, 513});
    picture.set_pixel_aspect_ratio(1.5);
    picture.set_attribute("aureole:fov_deg", 42.5F);
    picture.set_attribute("shot", "alley");
    const std::string path = folder.file("a.exr");
    EXPECT_EQ(write_picture(path, picture).clipped_samples, 0U);

    const Picture again = read_picture(path);
    EXPECT_EQ(again.channel_names(), picture.channel_names());
    EXPECT_EQ(again.data_window(), picture.data_window());
    EXPECT_EQ(again.display_window(), picture.display_window());
    EXPECT_EQ(again.pixel_aspect_ratio(), 1.5);
    EXPECT_EQ(again.float_attribute("aureole:fov_deg"), 42.5F);
    EXPECT_EQ(again.string_attribute("shot"), "alley");
    for (int c = 0; c < 5; ++c) {
        EXPECT_TRUE(std::equal(picture.image().plane(c),
                               picture.image().plane(c) + picture.image().pixels(),
                               again.image().plane(c)));
    }
    const auto input = OIIO::ImageInput::open(path);
    EXPECT_EQ(input->spec().format, OIIO::TypeFloat);
    EXPECT_EQ(input->spec().get_string_attribute("compression"), "zip");
}

TEST(WritePicture, HalfRoundsToNearestAndCountsWhatItClips) {
    const TemporaryFolder folder;
    Picture picture(noise(40, 30, 3));
    picture.image().at(0, 0, 0) = 1e6F;
    picture.image().at(1, 0, 1) = -70000;
    picture.image().at(2, 0, 2) = 65504;
    const std::string path = folder.file("h.exr");
    EXPECT_EQ(write_picture(path, picture, {Depth::kHalf}).clipped_samples, 2U);
    const Picture again = read_picture(path);
    EXPECT_EQ(OIIO::ImageInput::open(path)->spec().format, OIIO::TypeHalf);
    EXPECT_EQ(again.image().at(0, 0, 0), 65504);
    EXPECT_EQ(again.image().at(1, 0, 1), -65504);
    EXPECT_EQ(again.image().at(2, 0, 2), 65504);
    for (int x = 3; x < 40; ++x) {
        const float value = picture.image().at(x, 7, 1);
        EXPECT_NEAR(again.image().at(x, 7, 1), value, std::abs(value) * 0x1p-11F);
    }
}

// Channels that are not colour keep their type, and so their values, whatever the depth; those
// that were added follow the depth.
TEST(WritePicture, KeepsTypesOfOtherChannels) {
    const TemporaryFolder folder;
    {
        OIIO::ImageSpec spec(4, 3, 5, OIIO::TypeFloat);
        spec.channelnames = {"R", "G", "B", "A", "Z"};
        spec.channelformats = {OIIO::TypeHalf, OIIO::TypeHalf, OIIO::TypeHalf, OIIO::TypeHalf,
                               OIIO::TypeFloat};
        const auto output = OIIO::ImageOutput::create("in.exr");
        ASSERT_TRUE(output->open(folder.file("in.exr"), spec));
        std::vector<float> data;
        for (int i = 0; i < 60; ++i) data.push_back(1.0F / static_cast<float>(i + 3));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data()));
        ASSERT_TRUE(output->close());
    }
    Picture picture = read_picture(folder.file("in.exr"));
    picture.append_layer("glare", noise(4, 3, 3));
    for (const Depth depth : {Depth::kFloat, Depth::kHalf}) {
        const std::string path = folder.file("out.exr");
        write_picture(path, picture, {depth});
        const auto input = OIIO::ImageInput::open(path);
        const OIIO::ImageSpec& spec = input->spec();
        ASSERT_EQ(spec.nchannels, 8);
        const OIIO::TypeDesc wanted = depth == Depth::kHalf ? OIIO::TypeHalf : OIIO::TypeFloat;
        const auto type = [&](const char* name) {
            return spec.channelformat(spec.channelindex(name));
        };
        for (const char* name : {"R", "G", "B", "glare.R", "glare.G", "glare.B"}) {
            EXPECT_EQ(type(name), wanted) << name;
        }
        EXPECT_EQ(type("A"), OIIO::TypeHalf);
        EXPECT_EQ(type("Z"), OIIO::TypeFloat);
        const Picture again = read_picture(path);
        for (int c : {3, 4}) {  // alpha and depth: to the last bit
            for (int x = 0; x < 4; ++x) {
                EXPECT_EQ(again.image().at(x, 2, c), picture.image().at(x, 2, c));
            }
        }
    }
}

// Colour is never divided by or multiplied with alpha.
TEST(WritePicture, LeavesColorAndAlphaAlone) {
    const TemporaryFolder folder;
    Image image(3, 1, 4);
    const float alphas[] = {0, 0.25F, 2};
    for (int x = 0; x < 3; ++x) {
        for (int c = 0; c < 3; ++c) image.at(x, 0, c) = 0.5F;
        image.at(x, 0, 3) = alphas[x];
    }
    for (const char* name : {"a.exr", "a.tif"}) {
        write_picture(folder.file(name), Picture(image));
        const Picture again = read_picture(folder.file(name));
        ASSERT_EQ(again.alpha_channel(), 3) << name;
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(again.image().at(x, 0, 1), 0.5F) << name;
            EXPECT_EQ(again.image().at(x, 0, 3), alphas[x]) << name;
        }
    }
}

// Shared exponents have 8 bits: half a step of the largest component, without bias.
TEST(WritePicture, HdrRoundsWithoutBias) {
    const TemporaryFolder folder;
    Image image(300, 200, 3);
    Random random(3);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            image.plane(c)[i] = static_cast<float>(random.uniform(10, 1000));
        }
    }
    image.at(0, 0, 0) = 255.9F;  // mantissa rounds up to the next exponent
    image.at(0, 0, 1) = 100.5F;
    image.at(0, 0, 2) = 0;
    const std::string path = folder.file("a.hdr");
    EXPECT_EQ(write_picture(path, Picture(image)).clipped_samples, 0U);
    const Picture again = read_picture(path);
    double bias = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float largest = std::max({image.plane(0)[i], image.plane(1)[i], image.plane(2)[i]});
        for (int c = 0; c < 3; ++c) {
            const float difference = again.image().plane(c)[i] - image.plane(c)[i];
            ASSERT_LE(std::abs(difference), largest * (1 / 256.0F) * 1.0001F);
            bias += double{difference / largest};
        }
    }
    EXPECT_NEAR(bias / (3.0 * static_cast<double>(image.pixels())), 0, 3e-5);
    EXPECT_EQ(again.image().at(0, 0, 0), 256);

    image.at(4, 4, 1) = -1;
    EXPECT_EQ(write_picture(path, Picture(image)).clipped_samples, 1U);
    EXPECT_EQ(read_picture(path).image().at(4, 4, 1), 0);
}

TEST(WritePicture, TiffIsExactFloat) {
    const TemporaryFolder folder;
    const Picture picture(noise(33, 300, 5));
    write_picture(folder.file("a.tiff"), picture);
    const Picture again = read_picture(folder.file("a.tiff"));
    ASSERT_EQ(again.image().channels(), 5);
    for (int c = 0; c < 5; ++c) {
        EXPECT_EQ(again.image().at(32, 299, c), picture.image().at(32, 299, c));
    }
}

TEST(WritePicture, PngHoldsWhatItIsGiven) {
    const TemporaryFolder folder;
    Image image(260, 2, 4);
    for (int x = 0; x < 256; ++x) image.at(x, 0, 0) = static_cast<float>(x) / 255.0F;
    image.at(256, 0, 0) = 0.4999F / 255.0F;
    image.at(257, 0, 0) = 7.0F;
    image.at(258, 0, 0) = -1.0F;
    image.at(259, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    for (int x = 0; x < 260; ++x) image.at(x, 0, 3) = 0.2F;  // must not divide the colour
    const std::string path = folder.file("a.png");
    write_picture(path, Picture(image));

    OIIO::ImageSpec raw;
    raw.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &raw);
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
    std::vector<std::uint8_t> bytes(260 * 2 * 4);
    ASSERT_TRUE(input->read_image(0, 0, 0, 4, OIIO::TypeUInt8, bytes.data()));
    for (std::size_t x = 0; x < 256; ++x) EXPECT_EQ(bytes[4 * x], x);
    EXPECT_EQ(bytes[4 * 256], 0);
    EXPECT_EQ(bytes[4 * 257], 255);
    EXPECT_EQ(bytes[4 * 258], 0);
    EXPECT_EQ(bytes[4 * 259], 0);
    EXPECT_EQ(bytes[3], 51);
}

TEST(WritePicture, JpegIsClose) {
    const TemporaryFolder folder;
    Image image(64, 48, 3);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) image.at(x, y, 1) = static_cast<float>(x) / 64;
    }
    write_picture(folder.file("a.jpg"), Picture(image));
    const Picture again = read_picture(folder.file("a.jpg"));
    EXPECT_NEAR(color::srgb_encode(again.image().at(40, 20, 1)), 40 / 64.0, 0.02);
}

// Formats without windows hold what is meant to be seen.
TEST(WritePicture, OtherFormatsHoldTheDisplayWindow) {
    const TemporaryFolder folder;
    Picture picture(noise(20, 10, 3));
    picture.set_data_origin(-4, -2);
    picture.set_display_window({0, 0, 12, 10});  // two rows below the data
    for (const char* name : {"a.tif", "a.hdr", "a.png", "a.jpg"}) {
        write_picture(folder.file(name), picture);
        const Picture again = read_picture(folder.file(name));
        EXPECT_EQ(again.data_window(), (Window{0, 0, 12, 10})) << name;
    }
    const Picture tiff = read_picture(folder.file("a.tif"));
    EXPECT_EQ(tiff.image().at(0, 0, 1), picture.image().at(4, 2, 1));
    EXPECT_EQ(tiff.image().at(11, 7, 1), picture.image().at(15, 9, 1));
    EXPECT_EQ(tiff.image().at(3, 8, 1), 0);
}

TEST(WritePicture, GreyStaysGrey) {
    const TemporaryFolder folder;
    for (const int channels : {1, 2}) {
        const Picture picture(noise(9, 7, channels));
        for (const char* name : {"g.exr", "g.tif", "g.png"}) {
            write_picture(folder.file(name), picture);
            const Picture again = read_picture(folder.file(name));
            EXPECT_EQ(again.image().channels(), channels) << name;
            EXPECT_EQ(again.color_channels(), 1) << name;
        }
        write_picture(folder.file("g.jpg"), picture);
        EXPECT_EQ(read_picture(folder.file("g.jpg")).image().channels(), 1);
        write_picture(folder.file("g.hdr"), picture);  // which has no grey
        EXPECT_EQ(read_picture(folder.file("g.hdr")).image().channels(), 3);
    }
}

TEST(WritePicture, DoesNotDependOnThreads) {
    const TemporaryFolder folder;
    Picture picture(noise(300, 300, 3));
    picture.set_attribute("DateTime", "2024:01:01 00:00:00");  // else the encoder adds the time
    write_picture(folder.file("a.exr"), picture);
    const ThreadLimit one(1);
    write_picture(folder.file("b.exr"), picture);
    EXPECT_EQ(read_bytes(folder.file("a.exr")), read_bytes(folder.file("b.exr")));
}

TEST(WritePicture, RefusesUnknownExtensions) {
    const TemporaryFolder folder;
    for (const char* name : {"a.bmp", "a", "a.", "exr", "a.exr.bak", ".d/exr"}) {
        EXPECT_THROW(write_picture(folder.file(name), Picture(Image(1, 1, 1))), InvalidArgument)
            << name;
        EXPECT_THROW(check_picture_extension(name), InvalidArgument);
        EXPECT_FALSE(has_picture_extension(name)) << name;
    }
    check_picture_extension("A.EXR");
    EXPECT_TRUE(has_picture_extension("A.EXR"));
    EXPECT_THAT(folder.names(), ElementsAre());
}

TEST(WritePicture, SaysWhyAFileCannotBeWritten) {
    const TemporaryFolder folder;
    const Picture picture(Image(2, 2, 1));
    EXPECT_THAT(error_of(folder.file("none/a.exr"), picture), HasSubstr("there is no folder"));
    std::filesystem::create_directory(folder.file("d.exr"));
    EXPECT_THAT(error_of(folder.file("d.exr"), picture), HasSubstr("is a folder"));
    EXPECT_THAT(error_of("/proc/a.exr", picture), HasSubstr("in folder /proc"));
    const std::string long_name(300, 'x');
    EXPECT_THAT(error_of(folder.file(long_name + ".exr"), picture), HasSubstr("too long"));
    EXPECT_THAT(folder.names(), ElementsAre("d.exr"));
}

// The largest size of a file stands for a full disk: writes fail in the middle the same way.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    sighandler_t handler_;
};

TEST(WritePicture, LeavesNothingBehindOnAFullDisk) {
    const TemporaryFolder folder;
    Image image = noise(400, 600, 3);
    for (const char* name : {"a.exr", "a.hdr", "a.tif", "a.png", "a.jpg"}) {
        const std::string path = folder.file(name);
        write_bytes(path, "what was there before");
        for (const rlim_t limit : {1UL, 5000UL, 60000UL}) {
            std::string message;
            {
                const FileSizeLimit full(limit);
                message = error_of(path, Picture(image));
            }
            EXPECT_THAT(message, HasSubstr("cannot be written: File too large")) << name << limit;
            EXPECT_EQ(read_bytes(path), "what was there before");
            EXPECT_THAT(folder.names(), ElementsAre(name));
        }
        std::filesystem::remove(path);
    }
}

TEST(WritePicture, ReplacesFilesAndFollowsLinks) {
    const TemporaryFolder folder;
    const std::string target = folder.file("target.exr");
    const std::string link = folder.file("link.exr");
    write_bytes(target, "old");
    std::filesystem::create_symlink("target.exr", link);
    write_picture(link, Picture(noise(5, 5, 3)));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(read_picture(target).image().width(), 5);
    EXPECT_THAT(folder.names(), testing::UnorderedElementsAre("target.exr", "link.exr"));
}

}  // namespace
}  // namespace aureole::io
