#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/color/rgb.h"
#include "aureole/io/texture.h"
#include "io/exr_bytes.h"
#include "io/test_support.h"
#include "io/texture_bytes.h"

namespace aureole::io {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& path) {
    try {
        read_texture(path);
    } catch (const FileError& error) {
        EXPECT_EQ(error.file(), path);
        return error.what();
    }
    return "";
}

std::string words(const std::vector<std::uint32_t>& values) {
    std::string bytes;
    for (const std::uint32_t value : values) bytes += little_endian(value);
    return bytes;
}

// A DDS file without DX10 header: `pixels` is flags, characters, bits, and the four masks.
std::string legacy_dds(std::uint32_t width, std::uint32_t height, std::uint32_t levels,
                       const std::vector<std::uint32_t>& pixels, std::uint32_t caps2,
                       const std::string& texels) {
    std::string bytes = "DDS " + words({124, 0x1007, height, width, 0, 0, levels});
    bytes += std::string(44, '\0') + words({32}) + words(pixels);
    return bytes + words({0x1000, caps2, 0, 0, 0}) + texels;
}

std::string dx10_dds(std::uint32_t dxgi, std::uint32_t dimension, std::uint32_t misc,
                     std::uint32_t array, std::uint32_t side, std::uint32_t levels,
                     const std::string& texels) {
    return legacy_dds(side, side, levels, {4, 0x30315844, 0, 0, 0, 0, 0}, 0, "") +
           words({dxgi, dimension, misc, array, 0}) + texels;
}

Texture sample_texture(int faces, int width, int height, int channels, int levels) {
    Texture texture;
    texture.faces = faces;
    for (int k = 0; k < levels; ++k) {
        texture.levels.push_back(noise(std::max(1, width >> k), std::max(1, height >> k) * faces,
                                       channels, static_cast<std::uint64_t>(k + 1)));
    }
    return texture;
}

void expect_equal(const Image& a, const Image& b) {
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    ASSERT_EQ(a.channels(), b.channels());
    const std::size_t bytes = a.pixels() * static_cast<std::size_t>(a.channels()) * sizeof(float);
    EXPECT_EQ(std::memcmp(a.plane(0), b.plane(0), bytes), 0);
}

// What the independent parser finds in a file is what read_texture() returns.
TEST(ReadTexture, ComesBackAsTheOtherParserSeesIt) {
    const TemporaryFolder folder;
    for (const char* name : {"a.dds", "a.ktx2"}) {
        const std::string path = folder.file(name);
        for (const TexelFormat format : {TexelFormat::kHalf, TexelFormat::kFloat,
                                         TexelFormat::kR11G11B10, TexelFormat::kRgb9e5}) {
            const bool packed = format == TexelFormat::kR11G11B10 || format == TexelFormat::kRgb9e5;
            for (const int channels : {2, 3, 4}) {
                if (packed && channels != 3) continue;
                for (const int faces : {1, 6}) {
                    write_texture(path, sample_texture(faces, 9, faces == 1 ? 5 : 9, channels, 3),
                                  {format});
                    const std::string bytes = read_bytes(path);
                    const TextureBytes file =
                        name[2] == 'd' ? TextureBytes::dds(bytes) : TextureBytes::ktx2(bytes);
                    EXPECT_TRUE(is_texture_file(path));
                    const Texture texture = read_texture(path);
                    ASSERT_EQ(texture.faces, faces);
                    ASSERT_EQ(texture.levels.size(), 3U);
                    ASSERT_EQ(texture.width(), 9);
                    for (unsigned level = 0; level < 3; ++level) {
                        const Image& image = texture.levels[level];
                        ASSERT_EQ(image.channels(), channels);
                        const int height = image.height() / faces;
                        for (int y = 0; y < image.height(); ++y) {
                            for (int x = 0; x < image.width(); ++x) {
                                const std::vector<double> texel = file.texel(
                                    level, static_cast<unsigned>(y / height),
                                    static_cast<unsigned>(x), static_cast<unsigned>(y % height));
                                for (int c = 0; c < channels; ++c) {
                                    ASSERT_EQ(image.at(x, y, c),
                                              texel[static_cast<std::size_t>(c)]);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

// All 65536 codes of half precision, infinities and NaN among them, and subnormals of the others.
TEST(ReadTexture, EveryCode) {
    const TemporaryFolder folder;
    std::string texels;
    for (unsigned code = 0; code < 65536; ++code) {
        texels += little_endian(static_cast<std::uint16_t>(code));
        texels += little_endian(static_cast<std::uint16_t>(65535 - code));
    }
    write_bytes(folder.file("h.dds"), dx10_dds(34, 3, 0, 1, 256, 1, texels));
    const Image halves = read_texture(folder.file("h.dds")).levels[0];
    for (unsigned code = 0; code < 65536; ++code) {
        const double value = TextureBytes::real(code, 16, true);
        const float read = halves.plane(0)[code];
        ASSERT_TRUE(read == value || (std::isnan(read) && std::isnan(value))) << code;
        ASSERT_EQ(std::signbit(read), code >= 32768) << code;
    }

    texels.clear();
    for (std::uint32_t code = 0; code < 4096; ++code) {
        texels += little_endian((code & 2047) | (2047 - (code & 2047)) << 11 | (code & 1023) << 22);
    }
    write_bytes(folder.file("p.dds"), dx10_dds(26, 3, 0, 1, 64, 1, texels));
    const Image packed = read_texture(folder.file("p.dds")).levels[0];
    for (unsigned code = 0; code < 4096; ++code) {
        const double expected[] = {TextureBytes::real(code & 2047, 11, false),
                                   TextureBytes::real(2047 - (code & 2047), 11, false),
                                   TextureBytes::real(code & 1023, 10, false)};
        for (int c = 0; c < 3; ++c) {
            const float read = packed.plane(c)[code];
            ASSERT_TRUE(read == expected[c] || (std::isnan(read) && std::isnan(expected[c])));
        }
    }
}

TEST(ReadTexture, FloatsOfDirect3d9) {
    const TemporaryFolder folder;
    std::string face;
    for (int i = 0; i < 5; ++i) face += std::string("\x00\x3c\x00\x40\x00\xc0\x00\x3c", 8);
    std::string cube;
    for (int i = 0; i < 6; ++i) cube += face;
    write_bytes(folder.file("h.dds"), legacy_dds(2, 2, 2, {4, 113, 0, 0, 0, 0, 0}, 0xfe00, cube));
    const Texture halves = read_texture(folder.file("h.dds"));
    EXPECT_EQ(halves.faces, 6);
    ASSERT_EQ(halves.levels.size(), 2U);
    EXPECT_EQ(halves.levels[0].channels(), 3);  // alpha is 1
    EXPECT_EQ(halves.levels[1].height(), 6);
    EXPECT_EQ(halves.levels[1].at(0, 5, 0), 1);
    EXPECT_EQ(halves.levels[1].at(0, 5, 1), 2);
    EXPECT_EQ(halves.levels[0].at(1, 11, 2), -2);

    std::string floats;
    for (int i = 0; i < 6; ++i)
        floats += little_endian(float(i)) + little_endian(-1e9F) + little_endian(NAN) +
                  little_endian(0.5F);
    write_bytes(folder.file("f.dds"), legacy_dds(3, 2, 0, {4, 116, 0, 0, 0, 0, 0}, 0, floats));
    const Texture texture = read_texture(folder.file("f.dds"));
    ASSERT_EQ(texture.levels.size(), 1U);
    EXPECT_EQ(texture.levels[0].channels(), 4);
    EXPECT_EQ(texture.levels[0].at(2, 1, 0), 5);
    EXPECT_EQ(texture.levels[0].at(2, 1, 1), -1e9F);
    EXPECT_TRUE(std::isnan(texture.levels[0].at(2, 1, 2)));
    EXPECT_EQ(texture.levels[0].at(2, 1, 3), 0.5F);
}

// The same colour in each order of bytes, encoded and not.
TEST(ReadTexture, EightBits) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.dds");
    const std::string rgba("\x33\x66\x99\x80", 4);
    const std::string bgra("\x99\x66\x33\x80", 4);
    const std::uint32_t low = 0xff;
    const std::uint32_t high = 0xff0000;
    struct Case {
        std::string bytes;
        bool srgb;
        bool alpha;
    };
    const Case cases[] = {
        {dx10_dds(28, 3, 0, 1, 1, 1, rgba), false, true},
        {dx10_dds(29, 3, 0, 1, 1, 1, rgba), true, true},
        {dx10_dds(87, 3, 0, 1, 1, 1, bgra), false, true},
        {dx10_dds(91, 3, 0, 1, 1, 1, bgra), true, true},
        {dx10_dds(88, 3, 0, 0, 1, 1, bgra), false, false},
        {dx10_dds(93, 3, 0, 0, 1, 1, bgra), true, false},
        {legacy_dds(1, 1, 1, {0x41, 0, 32, low, 0xff00, high, 0xff000000}, 0, rgba), true, true},
        {legacy_dds(1, 1, 1, {0x41, 0, 32, high, 0xff00, low, 0xff000000}, 0, bgra), true, true},
        {legacy_dds(1, 1, 1, {0x40, 0, 32, high, 0xff00, low, 0}, 0, bgra), true, false},
        {legacy_dds(1, 1, 1, {0x40, 0, 24, high, 0xff00, low, 0}, 0, bgra), true, false},
    };
    for (const Case& c : cases) {
        write_bytes(path, c.bytes);
        const Image image = read_texture(path).levels.at(0);
        const float encoded[] = {0.2F, 0.4F, 0.6F};
        ASSERT_EQ(image.channels(), c.alpha ? 4 : 3);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(image.at(0, 0, i), c.srgb ? color::srgb_decode(encoded[i]) : encoded[i],
                        1e-6);
        }
        if (c.alpha) {
            EXPECT_NEAR(image.at(0, 0, 3), 128.0 / 255, 1e-6);
        }
    }
}

// KTX 1 in the byte order of either kind of machine, made from its specification.
struct Ktx1 {
    bool swap = false;
    std::uint32_t type = 0x140b;  // half
    std::uint32_t format = 0x1907;
    std::uint32_t internal = 0x881b;
    unsigned word = 2;  // bytes of what is swapped
    std::uint32_t width = 3;
    std::uint32_t height = 2;
    std::uint32_t faces = 1;
    std::string orientation;

    std::string turned(std::string bytes, unsigned size) const {
        for (std::size_t i = 0; swap && i + size <= bytes.size(); i += size) {
            std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                         bytes.begin() + static_cast<std::ptrdiff_t>(i + size));
        }
        return bytes;
    }
    // Levels of faces of rows; `total`: whether the length told is of all faces.
    std::string bytes(const std::vector<std::vector<std::string>>& levels, std::size_t rows,
                      bool total = false) const {
        std::string pairs;
        if (!orientation.empty()) {
            const std::string pair = std::string("KTXorientation") + '\0' + orientation + '\0';
            pairs = turned(words({static_cast<std::uint32_t>(pair.size())}), 4) + pair;
            pairs.resize((pairs.size() + 3) / 4 * 4);
        }
        std::string file = "\xABKTX 11\xBB\r\n\x1A\n";
        file += turned(words({0x04030201, type, word, format, internal, format, width, height, 0, 0,
                              faces, static_cast<std::uint32_t>(levels.size()),
                              static_cast<std::uint32_t>(pairs.size())}),
                       4) +
                pairs;
        for (std::size_t k = 0; k < levels.size(); ++k) {
            std::string body;
            const std::size_t height_here = std::max<std::size_t>(1, rows >> k);
            for (const std::string& face : levels[k]) {
                const std::size_t row = face.size() / height_here;
                for (std::size_t y = 0; y < height_here; ++y) {
                    body += turned(face.substr(y * row, row), word);
                    body.resize((body.size() + 3) / 4 * 4);
                }
            }
            const std::size_t told = total ? body.size() : body.size() / levels[k].size();
            file += turned(words({static_cast<std::uint32_t>(told)}), 4) + body;
        }
        return file;
    }
};

std::string halves(const std::vector<int>& values) {  // small whole numbers
    std::string bytes;
    for (const int value : values) {
        const int exponent = value == 0 ? 0 : static_cast<int>(std::log2(value));
        const int code = value == 0 ? 0 : ((exponent + 14) << 10) + ((value << 10) >> exponent);
        bytes += little_endian(static_cast<std::uint16_t>(code));
    }
    return bytes;
}

TEST(ReadTexture, Ktx1OfEitherByteOrder) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.ktx");
    for (const bool swap : {false, true}) {
        Ktx1 ktx;
        ktx.swap = swap;
        std::vector<int> values;
        for (int i = 0; i < 18; ++i) values.push_back(i);
        write_bytes(path, ktx.bytes({{halves(values)}, {halves({7, 8, 9})}}, 2));
        EXPECT_TRUE(is_texture_file(path));
        for (const char* orientation : {"", "S=r,T=d", "S=r,T=u"}) {
            ktx.orientation = orientation;
            write_bytes(path, ktx.bytes({{halves(values)}, {halves({7, 8, 9})}}, 2));
            const bool up = ktx.orientation == "S=r,T=u";
            const Texture texture = read_texture(path);
            ASSERT_EQ(texture.levels.size(), 2U);
            for (int y = 0; y < 2; ++y) {
                for (int x = 0; x < 3; ++x) {
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_EQ(texture.levels[0].at(x, up ? 1 - y : y, c), 9 * y + 3 * x + c);
                    }
                }
            }
            EXPECT_EQ(texture.levels[1].at(0, 0, 2), 9);
        }

        // A cube of R11G11B10, 1 and 2 and 4; faces are never turned.
        Ktx1 cube = {swap, 0x8c3b, 0x1907, 0x8c3a, 4, 2, 2, 6, "S=r,T=u"};
        const std::string one = words({15U << 6 | 16U << 17 | 17U << 27});
        const std::string zero = words({0});
        std::vector<std::string> faces(6, one + zero + zero + zero);
        for (const bool total : {false, true}) {
            write_bytes(path, cube.bytes({faces, {one, one, one, one, one, one}}, 2, total));
            const Texture texture = read_texture(path);
            EXPECT_EQ(texture.faces, 6);
            for (int face = 0; face < 6; ++face) {
                for (int c = 0; c < 3; ++c) {
                    EXPECT_EQ(texture.levels[0].at(0, 2 * face, c), 1 << c);
                    EXPECT_EQ(texture.levels[0].at(1, 2 * face + 1, c), 0);
                    EXPECT_EQ(texture.levels[1].at(0, face, c), 1 << c);
                }
            }
        }

        Ktx1 shared = {swap, 0x8c3e, 0x1907, 0x8c3d, 4, 1, 1, 1, ""};
        write_bytes(path, shared.bytes({{words({25U << 27 | 3U | 5U << 9 | 7U << 18})}}, 1));
        EXPECT_EQ(read_texture(path).levels[0].at(0, 0, 2), 14);

        Ktx1 floats = {swap, 0x1406, 0x1908, 0x8814, 4, 1, 1, 1, ""};
        write_bytes(path, floats.bytes({{little_endian(1e9F) + little_endian(-2.0F) +
                                         little_endian(3.0F) + little_endian(1.0F)}},
                                       1));
        EXPECT_EQ(read_texture(path).levels[0].channels(), 3);
        EXPECT_EQ(read_texture(path).levels[0].at(0, 0, 1), -2);

        Ktx1 bytes = {swap, 0x1401, 0x80e1, 0x8c43, 1, 1, 1, 1, ""};
        write_bytes(path, bytes.bytes({{std::string("\x99\x66\x33\xff", 4)}}, 1));
        EXPECT_NEAR(read_texture(path).levels[0].at(0, 0, 0), color::srgb_decode(0.2F), 1e-6);
        bytes.internal = 0x8058;  // RGBA8
        write_bytes(path, bytes.bytes({{std::string("\x99\x66\x33\xff", 4)}}, 1));
        EXPECT_NEAR(read_texture(path).levels[0].at(0, 0, 0), 0.2F, 1e-6);
    }
}

TEST(ReadTexture, Ktx2WithItsFirstRowLowestIsTurned) {
    const TemporaryFolder folder;
    const Texture texture = sample_texture(1, 3, 4, 3, 2);
    write_texture(folder.file("a.ktx2"), texture, {TexelFormat::kFloat});
    std::string bytes = read_bytes(folder.file("a.ktx2"));
    const std::size_t at = bytes.find("KTXorientation") + 15;
    ASSERT_EQ(bytes.substr(at, 2), "rd");
    bytes[at + 1] = 'u';
    write_bytes(folder.file("b.ktx2"), bytes);
    const Texture turned = read_texture(folder.file("b.ktx2"));
    for (int y = 0; y < 4; ++y)
        EXPECT_EQ(turned.levels[0].at(2, y, 1), texture.levels[0].at(2, 3 - y, 1));
    expect_equal(read_texture(folder.file("a.ktx2")).levels[0], texture.levels[0]);
}

TEST(ReadTexture, WhatCannotBeReadIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder.file("none.dds")), HasSubstr("no such file"));
    EXPECT_THAT(refusal(folder.file("")), HasSubstr("folder"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("not a regular file"));
    EXPECT_FALSE(is_texture_file(folder.file("none.dds")));
    const std::string path = folder.file("a");
    const auto of = [&](const std::string& bytes) {
        write_bytes(path, bytes);
        return refusal(path);
    };
    EXPECT_THAT(of(""), HasSubstr("empty"));
    EXPECT_THAT(of("x"), HasSubstr("neither a DDS nor a KTX"));
    EXPECT_FALSE(is_texture_file(path));
    EXPECT_THAT(of("DDS "), HasSubstr("needs 128 bytes"));
    const std::string texels(64, '\0');
    EXPECT_THAT(of(dx10_dds(95, 3, 4, 1, 4, 1, texels)), HasSubstr("95 (BC6H"));
    EXPECT_THAT(of(dx10_dds(71, 3, 4, 1, 4, 1, texels)), HasSubstr("71 (block compressed)"));
    EXPECT_THAT(of(dx10_dds(2, 4, 0, 1, 4, 1, texels)), HasSubstr("dimension 4"));
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 3, 1, 1, texels)), HasSubstr("array of 3"));
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 1, 0, 1, texels)), HasSubstr("0x0 texels"));
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 1, 0x80000000, 1, texels)),
                HasSubstr("2147483648x2147483648 texels, sides must be in [1, 32768]"));
    EXPECT_THAT(of(dx10_dds(2, 3, 4, 1, 32768, 16, texels)), HasSubstr("truncated"));
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 1, 2, 3, texels)), HasSubstr("at most 2"));
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 1, 2, 0xffffffff, texels)), HasSubstr("4294967295 levels"));
    EXPECT_EQ(of(dx10_dds(2, 3, 0, 1, 2, 1, texels)), "");
    EXPECT_THAT(of(dx10_dds(2, 3, 0, 1, 2, 1, texels.substr(1))), HasSubstr("truncated"));
    const std::vector<std::uint32_t> half = {4, 113, 0, 0, 0, 0, 0};
    EXPECT_THAT(of(legacy_dds(1, 1, 1, half, 0x600, texels)),
                HasSubstr("without all of its faces"));
    EXPECT_THAT(of(legacy_dds(2, 1, 1, half, 0xfe00, texels)), HasSubstr("2x1"));
    EXPECT_THAT(of(legacy_dds(1, 1, 1, half, 0x200000, texels)), HasSubstr("volume"));
    EXPECT_THAT(of(legacy_dds(4, 4, 1, {4, 0x31545844, 0, 0, 0, 0, 0}, 0, texels)),
                HasSubstr("\"DXT1\""));
    EXPECT_THAT(of(legacy_dds(1, 1, 1, {0x40, 0, 16, 0xf800, 0x7e0, 0x1f, 0}, 0, texels)),
                HasSubstr("16 bits with red mask 0xf800"));

    write_texture(folder.file("good.ktx2"), sample_texture(6, 4, 4, 3, 3));
    const std::string good = read_bytes(folder.file("good.ktx2"));
    const auto changed = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = good;
        bytes.replace(at, 4, words({value}));
        return of(bytes);
    };
    EXPECT_EQ(changed(12, 97), "");
    EXPECT_THAT(changed(12, 131), HasSubstr("VkFormat 131 (BC6H"));
    EXPECT_THAT(changed(12, 0), HasSubstr("VkFormat 0"));
    EXPECT_THAT(changed(44, 2), HasSubstr("Zstandard"));
    EXPECT_THAT(changed(44, 3), HasSubstr("ZLIB"));
    EXPECT_THAT(changed(28, 4), HasSubstr("volume"));
    EXPECT_THAT(changed(32, 2), HasSubstr("array of 2"));
    EXPECT_THAT(changed(36, 3), HasSubstr("3 faces"));
    EXPECT_THAT(changed(24, 8), HasSubstr("4x8"));
    EXPECT_THAT(changed(40, 4), HasSubstr("4 levels"));
    EXPECT_THAT(changed(60, 0xffffffff), HasSubstr("metadata"));
    EXPECT_THAT(changed(84, 0x7fffffff), HasSubstr("level 0 needs 768 bytes from 92233720"));
    EXPECT_THAT(changed(112, 191), HasSubstr("level 1 has 191 bytes, must have 192"));

    const Ktx1 ktx;
    const std::string old = ktx.bytes({{std::string(36, '\0')}}, 2);
    const auto altered = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = old;
        bytes.replace(at, 4, words({value}));
        return of(bytes);
    };
    EXPECT_EQ(altered(12, 0x04030201), "");
    EXPECT_THAT(altered(12, 7), HasSubstr("byte order 0x00000007"));
    EXPECT_THAT(altered(16, 0), HasSubstr("OpenGL type 0x0"));
    EXPECT_THAT(altered(44, 2), HasSubstr("volume"));
    EXPECT_THAT(altered(48, 2), HasSubstr("array of 2"));
    EXPECT_THAT(altered(52, 0), HasSubstr("0 faces"));
    EXPECT_THAT(altered(60, 0xfffffff0), HasSubstr("metadata"));
    EXPECT_THAT(altered(64, 36), HasSubstr("36 bytes a face, must have 40"));
}

// Damaged anyhow, a file is read or refused, and never asks for more memory than it has bytes for.
TEST(ReadTexture, DamagedFilesNeverCrash) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a");
    std::vector<std::string> files;
    for (const char* name : {"a.dds", "a.ktx2"}) {
        write_texture(folder.file(name), sample_texture(6, 4, 4, 3, 3));
        files.push_back(read_bytes(folder.file(name)));
    }
    files.push_back(legacy_dds(2, 2, 2, {4, 116, 0, 0, 0, 0, 0}, 0, std::string(80, '\1')));
    Ktx1 ktx;
    ktx.orientation = "S=r,T=d";
    files.push_back(ktx.bytes({{std::string(36, '\1')}, {std::string(6, '\1')}}, 2));
    ktx.swap = true;
    files.push_back(ktx.bytes({{std::string(36, '\1')}, {std::string(6, '\1')}}, 2));

    std::size_t accepted = 0;
    const auto attempt = [&](const std::string& bytes) {
        std::filesystem::remove(path);  // some file systems wait for the disk when files shrink
        write_bytes(path, bytes);
        try {
            const Texture texture = read_texture(path);
            std::size_t samples = 0;
            for (const Image& level : texture.levels) {
                samples += level.pixels() * static_cast<std::size_t>(level.channels());
            }
            EXPECT_LE(samples, bytes.size());
            ++accepted;
            return true;
        } catch (const FileError& error) {
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("memory")));
            return false;
        }
    };
    Random random(3);
    for (const std::string& whole : files) {
        ASSERT_TRUE(attempt(whole));
        for (std::size_t size = 0; size < whole.size(); size += 1 + size / 16) {
            EXPECT_FALSE(attempt(whole.substr(0, size))) << size;
        }
        for (std::size_t at = 0; at < std::min<std::size_t>(whole.size(), 240); ++at) {
            for (const int value : {0, 1, 0xff}) {
                std::string bytes = whole;
                bytes[at] = static_cast<char>(value);
                attempt(bytes);
            }
        }
        for (int i = 0; i < 200; ++i) {  // several bytes of the header at once
            std::string bytes = whole;
            for (int k = 0; k < 4; ++k) {
                const auto at = static_cast<std::size_t>(140 * random.uniform());
                bytes[at] = static_cast<char>(256 * random.uniform() - 128);
            }
            attempt(bytes);
        }
    }
    EXPECT_GT(accepted, 100U);
}

}  // namespace
}  // namespace aureole::io
