#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "aureole/color/rgb.h"
#include "aureole/io/texture.h"
#include "io/exr_bytes.h"
#include "io/test_support.h"
#include "io/texture_bytes.h"
#include "io/texture_fixtures.h"

namespace aureole::io {
namespace {

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

}  // namespace
}  // namespace aureole::io
