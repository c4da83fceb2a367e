#include "aureole/io/picture_rows.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/io/picture.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

using testing::HasSubstr;

// Writes noise of `spec`; samples in [0, 1] where the type holds no others.
void write_noise(const std::string& path, const OIIO::ImageSpec& spec) {
    const Image image = noise(spec.width, spec.height, spec.nchannels);
    std::vector<float> data;
    for (int y = 0; y < spec.height; ++y) {
        for (int x = 0; x < spec.width; ++x) {
            for (int c = 0; c < spec.nchannels; ++c) {
                const float value = image.at(x, y, c);
                data.push_back(spec.format.is_floating_point() ? value
                                                               : std::fmod(std::abs(value), 1.0F));
            }
        }
    }
    if (spec.format == OIIO::TypeFloat) data[data.size() / 2] = NAN;
    const auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output && output->open(path, spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeFloat, data.data())) << output->geterror();
    ASSERT_TRUE(output->close());
}

// Rows [first, first + count) have the bits of the picture's colour, grey spread to three.
void expect_rows(PictureRows& rows, const Picture& picture, int first, int count) {
    Image band(rows.width(), count, 3);
    rows.read(first, count, band);
    for (int y = 0; y < count; ++y) {
        for (int c = 0; c < 3; ++c) {
            const float* expected =
                picture.image().row(first + y, std::min(c, picture.color_channels() - 1));
            ASSERT_EQ(std::memcmp(band.row(y, c), expected,
                                  static_cast<std::size_t>(band.width()) * sizeof(float)),
                      0)
                << "row " << first + y << " channel " << c;
        }
    }
}

void expect_same(const std::string& path) {
    const Picture picture = read_picture(path);
    PictureRows rows(path);
    ASSERT_EQ(rows.width(), picture.image().width()) << path;
    ASSERT_EQ(rows.height(), picture.image().height()) << path;
    EXPECT_EQ(rows.data_window(), picture.data_window()) << path;
    EXPECT_EQ(rows.display_window(), picture.display_window()) << path;
    SCOPED_TRACE(path);
    for (int y = 0; y < rows.height(); y += 7) {
        expect_rows(rows, picture, y, std::min(7, rows.height() - y));
    }
    // Back, over the boundary of two bands, all at once.
    expect_rows(rows, picture, 0, 1);
    expect_rows(rows, picture, rows.height() / 2, rows.height() - rows.height() / 2);
    expect_rows(rows, picture, 0, rows.height());
}

TEST(PictureRows, AreThoseOfReadPicture) {
    const TemporaryFolder folder;
    const OIIO::ImageSpec rgb(37, 101, 3, OIIO::TypeFloat);
    for (const char* name : {"a.exr", "a.hdr", "a.tif"}) {
        write_noise(folder.file(name), rgb);
        expect_same(folder.file(name));
    }
    for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
        for (const int channels : {1, 2, 3, 4}) {
            for (const char* name : {"b.png", "b.tif", "b.jpg"}) {
                if (name[2] == 'j' && (channels % 2 == 0 || type != OIIO::TypeUInt8)) continue;
                OIIO::ImageSpec spec(37, 101, channels, type);
                spec.attribute("oiio:UnassociatedAlpha", 1);
                write_noise(folder.file(name), spec);
                expect_same(folder.file(name));
            }
        }
    }
    OIIO::ImageSpec linear(37, 101, 3, OIIO::TypeUInt8);
    linear.attribute("oiio:ColorSpace", "Linear");
    write_noise(folder.file("linear.png"), linear);
    expect_same(folder.file("linear.png"));
}

TEST(PictureRows, OfTiles) {
    const TemporaryFolder folder;
    for (const char* name : {"a.exr", "a.tif"}) {
        for (const int tile_height : {16, 48, 128}) {
            OIIO::ImageSpec spec(37, 203, 4, OIIO::TypeFloat);
            spec.tile_width = 16;
            spec.tile_height = tile_height;
            if (name[2] == 'e') spec.x = -7;
            if (name[2] == 'e') spec.y = 11;
            write_noise(folder.file(name), spec);
            expect_same(folder.file(name));
        }
    }
}

// Colour among other channels, in an order and types of its own; grey beside depth; windows.
TEST(PictureRows, TakeTheColourOnly) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    for (const int tile : {0, 32}) {
        OIIO::ImageSpec spec(21, 90, 7, OIIO::TypeFloat);
        spec.channelnames = {"id", "z.B", "z.G", "z.N", "z.R", "z.A", "Z"};
        spec.channelformats = {OIIO::TypeUInt32, OIIO::TypeHalf,  OIIO::TypeFloat, OIIO::TypeUInt32,
                               OIIO::TypeHalf,   OIIO::TypeFloat, OIIO::TypeFloat};
        spec.x = 5;
        spec.y = -3;
        spec.full_width = 30;
        spec.tile_width = spec.tile_height = tile;
        write_noise(path, spec);
        ASSERT_EQ(read_picture(path).channel_names()[0], "z.R");
        expect_same(path);
        OIIO::ImageSpec grey(21, 90, 3, OIIO::TypeHalf);
        grey.channelnames = {"A", "Y", "Z"};
        grey.tile_width = grey.tile_height = tile;
        write_noise(path, grey);
        expect_same(path);
    }
    for (const char* compression : {"none", "rle", "zips", "piz", "pxr24", "b44", "dwaa", "dwab"}) {
        OIIO::ImageSpec spec(40, 600, 3, OIIO::TypeHalf);
        spec.attribute("compression", compression);
        write_noise(path, spec);
        expect_same(path);
    }
}

TEST(PictureRows, OfPicturesThatAreTurned) {
    const TemporaryFolder folder;
    for (const int orientation : {2, 3, 6}) {
        OIIO::ImageSpec spec(37, 101, 3, OIIO::TypeUInt8);
        spec.attribute("Orientation", orientation);
        write_noise(folder.file("a.tif"), spec);
        expect_same(folder.file("a.tif"));
    }
}

TEST(PictureRows, DamagedFilesAreFileErrors) {
    const TemporaryFolder folder;
    EXPECT_THROW(PictureRows(folder.file("none.exr")), FileError);
    Image image = noise(61, 183, 3);
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
            const auto read_all = [&] {
                PictureRows rows(path);
                Image band(rows.width(), 1, 3);
                for (int y = 0; y < rows.height(); ++y) rows.read(y, 1, band);
            };
            EXPECT_THROW(read_all(), FileError) << name << ' ' << part;
        }
    }
}

TEST(PictureRows, RefuseWhatDoesNotFit) {
    const TemporaryFolder folder;
    write_picture(folder.file("a.exr"), Picture(noise(4, 5, 3)));
    PictureRows rows(folder.file("a.exr"));
    Image band(4, 2, 3);
    const auto refusal = [&](int first, int count, const ImageView& out) -> std::string {
        try {
            rows.read(first, count, out);
        } catch (const InvalidArgument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(3, 2, band), "");
    EXPECT_THAT(refusal(4, 2, band), HasSubstr("the picture has 5"));
    EXPECT_THAT(refusal(-1, 2, band), HasSubstr("2 from -1 on"));
    EXPECT_THAT(refusal(0, -1, band), HasSubstr("-1 from 0 on"));
    EXPECT_THAT(refusal(2147483647, 2, band), HasSubstr("the picture has 5"));
    EXPECT_THAT(refusal(0, 1, band), HasSubstr("must be 4x1, 3 channels"));
    EXPECT_THAT(refusal(0, 2, band.view().channel_range(0, 2)), HasSubstr("2 channels"));
}

// From /proc/self/status: memory in use, or the most since the mark was set back.
double mebibytes(const std::string& what) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.compare(0, what.size(), what) == 0)
            return std::stod(line.substr(what.size())) / 1024;
    }
    return NAN;
}

TEST(PictureRowsSlow, MemoryIsThatOfTheRowsNotOfThePicture) {
    constexpr int kWidth = 8192;
    constexpr int kHeight = 4096;
    constexpr int kTile = 64;
    const TemporaryFolder folder;
    const double before = mebibytes("VmRSS:");
    for (const int tile : {0, kTile}) {
        const std::string path = folder.file("big.exr");
        OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeHalf);
        spec.tile_width = spec.tile_height = tile;
        spec.attribute("compression", "rle");
        {
            std::vector<float> band(std::size_t{kWidth} * kTile * 3);
            const auto output = OIIO::ImageOutput::create(path);
            ASSERT_TRUE(output && output->open(path, spec));
            for (int y = 0; y < kHeight; y += kTile) {
                std::fill(band.begin(), band.end(), static_cast<float>(y));
                ASSERT_TRUE(tile > 0 ? output->write_tiles(0, kWidth, y, y + kTile, 0, 1,
                                                           OIIO::TypeFloat, band.data())
                                     : output->write_scanlines(y, y + kTile, 0, OIIO::TypeFloat,
                                                               band.data()));
            }
            ASSERT_TRUE(output->close());
        }
        ::malloc_trim(0);
        std::ofstream mark("/proc/self/clear_refs");
        if (!(mark << "5" << std::flush)) GTEST_SKIP() << "the peak of memory cannot be set back";

        PictureRows rows(path);
        Image band(kWidth, 16, 3);
        for (int y = 0; y < kHeight; y += 16) {
            rows.read(y, 16, band);
            ASSERT_EQ(band.at(kWidth - 1, 15, 2), static_cast<float>(y / kTile * kTile));
        }
        // As floats the picture has 384 MiB; the rows and decoders need some 12.
        EXPECT_LT(mebibytes("VmHWM:") - before, 60) << "tile " << tile;
    }
}

}  // namespace
}  // namespace aureole::io
