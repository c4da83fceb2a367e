// Multi-part files. The OpenEXR library, which refuses any inconsistent container, is the judge of
// what is written here.
#include "io/exr_parts.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/io/picture.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

OIIO::ImageSpec spec_of(const std::string& name, int channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(40, 30, channels, type);
    spec.x = -4;
    spec.y = 3;
    spec.full_width = 32;
    spec.full_height = 32;
    spec.attribute("oiio:subimagename", name);
    spec.attribute("name", name);
    spec.attribute("DateTime", "2024:01:01 00:00:00");
    return spec;
}

std::vector<ExrPart> encode(const TemporaryFolder& folder, const OIIO::ImageSpec& spec) {
    const std::string path = folder.file("single.exr");
    const auto output = OIIO::ImageOutput::create(path);
    EXPECT_TRUE(output->open(path, spec)) << output->geterror();
    if (spec.deep) {
        OIIO::DeepData deep;
        deep.init(spec);
        for (int i = 0; i < 40 * 30; ++i) deep.set_samples(i, i % 3);
        for (int i = 0; i < 40 * 30; ++i) {
            for (int k = 0; k < i % 3; ++k) {
                deep.set_deep_value(i, 0, k, 0.5F * static_cast<float>(i + k));
            }
        }
        EXPECT_TRUE(output->write_deep_image(deep)) << output->geterror();
    } else {
        const Image image = noise(40 * spec.nchannels, 30, 1, 7);
        EXPECT_TRUE(output->write_image(OIIO::TypeFloat, image.plane(0))) << output->geterror();
    }
    EXPECT_TRUE(output->close());
    return split_exr(read_bytes(path), path);
}

// Matte (uint), beauty (half), deep samples, tiles: what OpenImageIO itself cannot write into one
// file.
std::string mixed_file(const TemporaryFolder& folder) {
    OIIO::ImageSpec matte = spec_of("matte", 1, OIIO::TypeUInt32);
    matte.channelnames = {"id"};
    matte.attribute("compression", "rle");
    OIIO::ImageSpec beauty = spec_of("beauty", 4, OIIO::TypeHalf);
    beauty.attribute("aureole:fov_deg", 35.0F);
    OIIO::ImageSpec deep = spec_of("deep", 2, OIIO::TypeFloat);
    deep.channelnames = {"Z", "A"};
    deep.deep = true;
    deep.attribute("compression", "zips");
    OIIO::ImageSpec tiles = spec_of("tiles", 1, OIIO::TypeFloat);
    tiles.channelnames = {"a.name.of.more.than.thirty.one.letters"};
    tiles.tile_width = tiles.tile_height = 16;
    tiles.attribute("compression", "dwaa");

    std::vector<ExrPart> parts;
    for (const OIIO::ImageSpec& spec : {matte, beauty, deep, tiles}) {
        std::vector<ExrPart> one = encode(folder, spec);
        EXPECT_EQ(one.size(), 1U);
        if (spec.tile_width > 0) one[0].set("type", "string", "tiledimage");
        one[0].set("name", "string", spec.get_string_attribute("name"));
        parts.push_back(std::move(one[0]));
    }
    // Shared by all parts, or OpenEXR refuses the file.
    parts[1].set("chromaticities", "chromaticities", std::string(32, '?'));
    parts[1].set("timeCode", "timecode", std::string(8, '\x01'));
    std::string bytes;
    join_exr(parts, 1, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

void expect_same_attributes(const ExrPart& a, const ExrPart& b) {
    EXPECT_EQ(a.header.size(), b.header.size());
    for (const ExrAttribute& attribute : a.header) {
        const ExrAttribute* other = b.find(attribute.name);
        ASSERT_NE(other, nullptr) << attribute.name;
        EXPECT_EQ(other->type, attribute.type) << attribute.name;
        EXPECT_EQ(other->value, attribute.value) << attribute.name;
    }
}

TEST(ExrParts, EveryPartCanBeReadByOpenExr) {
    const TemporaryFolder folder;
    const std::string path = folder.file("mixed.exr");
    write_bytes(path, mixed_file(folder));
    const auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input) << OIIO::geterror();
    const char* const names[] = {"matte", "beauty", "deep", "tiles"};
    for (int p = 0; p < 4; ++p) {
        ASSERT_TRUE(input->seek_subimage(p, 0)) << p;
        const OIIO::ImageSpec spec = input->spec();
        EXPECT_EQ(spec.get_string_attribute("name"), names[p]);
        if (spec.deep) {
            OIIO::DeepData deep;
            ASSERT_TRUE(input->read_native_deep_image(p, 0, deep)) << input->geterror();
            EXPECT_EQ(deep.deep_value(5, spec.channelindex("Z"), 1), 3.0F);
        } else {
            std::vector<float> data(40UL * 30 * static_cast<std::size_t>(spec.nchannels));
            EXPECT_TRUE(input->read_image(p, 0, 0, spec.nchannels, OIIO::TypeFloat, data.data()))
                << input->geterror();
        }
    }
}

TEST(ExrParts, OtherPartsTravelUntouched) {
    const TemporaryFolder folder;
    const std::string path = folder.file("mixed.exr");
    const std::string before_bytes = mixed_file(folder);
    write_bytes(path, before_bytes);

    Picture picture = read_picture(path);
    EXPECT_EQ(picture.other_parts(), 3);
    EXPECT_EQ(picture.channel_names(), (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(picture.data_window(), (Window{-4, 3, 40, 30}));
    EXPECT_EQ(picture.float_attribute("aureole:fov_deg"), 35.0F);
    picture.image().at(3, 4, 0) = 12345.678F;
    picture.append_layer("glare", noise(40, 30, 3));
    picture.set_display_window({0, 0, 31, 31});  // which all parts have to share
    write_picture(path, picture);

    const std::vector<ExrPart> before = split_exr(before_bytes, "before");
    const std::vector<ExrPart> after = split_exr(read_bytes(path), path);
    ASSERT_EQ(after.size(), 4U);
    for (const std::size_t p : {0U, 2U, 3U}) {
        EXPECT_EQ(after[p].chunks, before[p].chunks);
        ExrPart expected = before[p];
        expected.set("displayWindow", "box2i", after[1].find("displayWindow")->value);
        expect_same_attributes(after[p], expected);
    }
    EXPECT_EQ(after[1].find("name")->value, "beauty");
    for (const char* name : {"chromaticities", "timeCode", "screenWindowWidth"}) {
        ASSERT_NE(after[1].find(name), nullptr) << name;
        EXPECT_EQ(after[1].find(name)->value, before[1].find(name)->value) << name;
    }

    const auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input) << OIIO::geterror();
    EXPECT_TRUE(input->seek_subimage(3, 0));
    const Picture again = read_picture(path);
    EXPECT_EQ(again.other_parts(), 3);
    EXPECT_EQ(again.image().channels(), 7);
    EXPECT_EQ(again.image().at(3, 4, 0), 12345.678F);
    EXPECT_EQ(again.image().at(39, 29, 3), picture.image().at(39, 29, 3));
    EXPECT_EQ(again.display_window(), (Window{0, 0, 31, 31}));

    // A single-part format keeps the picture only.
    write_picture(folder.file("a.tif"), picture);
    EXPECT_EQ(read_picture(folder.file("a.tif")).other_parts(), 0);
}

TEST(ExrParts, RefusesFilesThatAreCutAnywhere) {
    const TemporaryFolder folder;
    const std::string whole = mixed_file(folder);
    const std::string path = folder.file("cut.exr");
    EXPECT_EQ(split_exr(whole, path).size(), 4U);
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
        EXPECT_THROW(split_exr(whole.substr(0, size), path), FileError) << size;
    }
    EXPECT_THROW(split_exr(whole.substr(0, whole.size() - 1), path), FileError);
    write_bytes(path, whole.substr(0, whole.size() - 1));  // the cut is in a part not decoded
    EXPECT_THROW(read_picture(path), FileError);
}

TEST(ExrParts, DeepFilesAreRefused) {
    const TemporaryFolder folder;
    OIIO::ImageSpec deep = spec_of("deep", 2, OIIO::TypeFloat);
    deep.channelnames = {"Z", "A"};
    deep.deep = true;
    deep.attribute("compression", "zips");
    encode(folder, deep);
    try {
        read_picture(folder.file("single.exr"));
        FAIL();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("deep"));
    }
}

}  // namespace
}  // namespace aureole::io
