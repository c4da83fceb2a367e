#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/io/texture.h"
#include "io/test_support.h"
#include "io/texture_bytes.h"

namespace aureole::io {
namespace {

using testing::HasSubstr;

// Every float format of at most 16 bits is tried by its codes: those of positive values are in
// order. The nearest value, the one of even code of two that are equally near.
double nearest(double value, unsigned count, bool is_signed) {
    const double magnitude = std::abs(value);
    const unsigned positive = is_signed ? count - 1 : count;
    std::uint64_t low = 0;
    std::uint64_t high = (31ULL << (positive - 5)) - 1;  // the last finite one
    while (high - low > 1) {
        const std::uint64_t middle = (low + high) / 2;
        (TextureBytes::real(middle, count, is_signed) <= magnitude ? low : high) = middle;
    }
    const double below = magnitude - TextureBytes::real(low, count, is_signed);
    const double above = TextureBytes::real(high, count, is_signed) - magnitude;
    const bool down = below < above || (below == above && low % 2 == 0);
    return std::copysign(TextureBytes::real(down ? low : high, count, is_signed), value);
}

// The finest step at which the largest of three still has a mantissa of 9 bits.
std::array<double, 3> nearest_shared(const std::array<double, 3>& rgb) {
    const double largest = std::max({rgb[0], rgb[1], rgb[2]});
    for (int exponent = 0;; ++exponent) {
        const double step = std::ldexp(1.0, exponent - 24);
        const auto round = [&](double value) {
            const double down = std::floor(value / step);
            const double rest = value / step - down;
            const bool up = rest > 0.5 || (rest == 0.5 && std::fmod(down, 2) == 1);
            return up ? down + 1 : down;
        };
        if (round(largest) > 511) continue;
        return {round(rgb[0]) * step, round(rgb[1]) * step, round(rgb[2]) * step};
    }
}

std::vector<double> expected(TexelFormat format, const Image& image, int x, int y) {
    const bool filled = format == TexelFormat::kHalf || format == TexelFormat::kFloat;
    const auto channels = static_cast<std::size_t>(image.channels());
    std::vector<double> values(filled && channels == 3 ? 4 : channels, 1.0);
    for (std::size_t c = 0; c < channels; ++c) {
        values[c] = double{image.at(x, y, static_cast<int>(c))};
        if (format == TexelFormat::kHalf) values[c] = nearest(values[c], 16, true);
        if (format == TexelFormat::kR11G11B10) {
            values[c] = nearest(values[c], c == 2 ? 10 : 11, false);
        }
    }
    if (format == TexelFormat::kRgb9e5) {
        const auto shared = nearest_shared({values[0], values[1], values[2]});
        std::copy(shared.begin(), shared.end(), values.begin());
    }
    return values;
}

Texture made(int faces, int width, int height, int channels, int levels, bool positive) {
    Texture texture;
    texture.faces = faces;
    for (int k = 0; k < levels; ++k) {
        Image image = noise(std::max(1, width >> k), std::max(1, height >> k) * faces, channels,
                            static_cast<std::uint64_t>(k + 1));
        float* values = image.plane(0);
        for (std::size_t i = 0; positive && i < image.pixels() * static_cast<std::size_t>(channels);
             ++i) {
            values[i] = std::abs(values[i]);
        }
        texture.levels.push_back(std::move(image));
    }
    return texture;
}

TextureBytes parsed(const std::string& path) {
    const std::string bytes = read_bytes(path);
    return path.ends_with(".dds") ? TextureBytes::dds(bytes) : TextureBytes::ktx2(bytes);
}

constexpr std::array kFormats = {TexelFormat::kHalf, TexelFormat::kFloat, TexelFormat::kR11G11B10,
                                 TexelFormat::kRgb9e5};

void expect_texels(const std::string& path, const Texture& texture, TexelFormat format) {
    const TextureBytes file = parsed(path);
    ASSERT_EQ(file.width, static_cast<unsigned>(texture.width()));
    ASSERT_EQ(file.height, static_cast<unsigned>(texture.height()));
    ASSERT_EQ(file.faces, static_cast<unsigned>(texture.faces));
    ASSERT_EQ(file.levels, texture.levels.size());
    for (unsigned level = 0; level < file.levels; ++level) {
        const Image& image = texture.levels[level];
        const int height = image.height() / texture.faces;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                ASSERT_EQ(file.texel(level, static_cast<unsigned>(y / height),
                                     static_cast<unsigned>(x), static_cast<unsigned>(y % height)),
                          expected(format, image, x, y))
                    << path << " level " << level << " at " << x << ", " << y;
            }
        }
    }
}

TEST(WriteTexture, EveryFormatIsWhatTheSpecificationsSay) {
    const TemporaryFolder folder;
    for (const char* name : {"a.dds", "a.ktx2", "B.KTX2"}) {
        const std::string path = folder.file(name);
        if (std::string(name) == "B.KTX2") {
            EXPECT_NO_THROW(check_texture_extension(path));
            continue;
        }
        for (const TexelFormat format : kFormats) {
            const bool packed = format == TexelFormat::kR11G11B10 || format == TexelFormat::kRgb9e5;
            for (const int channels : {2, 3, 4}) {
                if (packed && channels != 3) continue;
                for (const Texture& texture :
                     {made(6, 16, 16, channels, 5, packed), made(6, 5, 5, channels, 2, packed),
                      made(1, 7, 3, channels, 3, packed), made(1, 1, 1, channels, 1, packed)}) {
                    const TextureReport report = write_texture(path, texture, {format});
                    EXPECT_EQ(report.clamped(), 0U);
                    expect_texels(path, texture, format);
                }
            }
        }
    }
}

// Halfway between any two neighbours, and just beside: half and the two of R11G11B10 exhaustively.
TEST(WriteTexture, RoundsToNearestAndTiesToEven) {
    const TemporaryFolder folder;
    for (const bool half : {true, false}) {
        const unsigned last = half ? (31U << 10) - 1 : (31U << 6) - 1;
        Texture texture;
        texture.levels.emplace_back(static_cast<int>(last / 64 + 1), 3 * 64, 3);
        Image& image = texture.levels[0];
        for (unsigned code = 0; code < last; ++code) {
            for (int c = 0; c < 3; ++c) {
                const unsigned count = half ? 16 : c == 2 ? 10 : 11;
                const unsigned here = count == 10 ? code / 2 : code;
                const auto middle = static_cast<float>((TextureBytes::real(here, count, half) +
                                                        TextureBytes::real(here + 1, count, half)) /
                                                       2);
                const float sign = half && code % 3 == 0 ? -1 : 1;
                const int x = static_cast<int>(code / 64);
                const int y = static_cast<int>(code % 64) * 3;
                if (middle > (count == 10 ? 64512.0F : 65504.0F)) continue;
                image.at(x, y, c) = sign * middle;
                image.at(x, y + 1, c) = sign * std::nextafter(middle, 0.0F);
                image.at(x, y + 2, c) = sign * std::nextafter(middle, INFINITY);
            }
        }
        const TexelFormat format = half ? TexelFormat::kHalf : TexelFormat::kR11G11B10;
        EXPECT_EQ(write_texture(folder.file("a.dds"), texture, {format}).clamped(), 0U);
        expect_texels(folder.file("a.dds"), texture, format);
    }
}

// Every exponent, mantissas that round up into the next one, and values far below the largest.
TEST(WriteTexture, SharedExponentIsTheFinestThatFits) {
    const TemporaryFolder folder;
    Texture texture;
    texture.levels.emplace_back(160, 12, 3);
    Image& image = texture.levels[0];
    Random random(7);
    for (int x = 0; x < image.width(); ++x) {
        const double scale = std::ldexp(1.0, x / 3 - 37);
        for (int y = 0; y < image.height(); ++y) {
            const double mantissa = y < 6 ? 511.0 + 0.25 * y : 512 * random.uniform();
            const double values[] = {mantissa, 512 * random.uniform(), y + 0.5};
            for (int c = 0; c < 3; ++c) {
                image.at(x, y, (c + x) % 3) =
                    static_cast<float>(std::min(values[c] / 512 * scale, 65408.0));
            }
        }
    }
    EXPECT_EQ(write_texture(folder.file("a.ktx2"), texture, {TexelFormat::kRgb9e5}).clamped(), 0U);
    expect_texels(folder.file("a.ktx2"), texture, TexelFormat::kRgb9e5);
}

TEST(WriteTexture, WhatTheFormatCannotHoldIsClampedAndCounted) {
    struct Case {
        TexelFormat format;
        std::array<double, 3> largest;
        std::size_t too_large;
        std::size_t negative;
    };
    const double most = double{std::numeric_limits<float>::max()};
    const Case cases[] = {
        {TexelFormat::kHalf, {65504, 65504, 65504}, 4, 0},
        {TexelFormat::kFloat, {most, most, most}, 2, 0},
        {TexelFormat::kR11G11B10, {65024, 65024, 64512}, 2, 3},
        {TexelFormat::kRgb9e5, {65408, 65408, 65408}, 2, 3},
    };
    Texture texture;
    texture.levels.emplace_back(2, 2, 3);
    Image& image = texture.levels[0];
    const float samples[4][3] = {
        {2e6F, -2e6F, NAN}, {-INFINITY, 1, 2}, {0, INFINITY, -0.5F}, {65024, 65024, 64512}};
    for (int i = 0; i < 4; ++i) {
        for (int c = 0; c < 3; ++c) image.at(i % 2, i / 2, c) = samples[i][c];
    }
    const TemporaryFolder folder;
    for (const char* name : {"a.dds", "a.ktx2"}) {
        for (const Case& c : cases) {
            const TextureReport report = write_texture(folder.file(name), texture, {c.format});
            EXPECT_EQ(report.too_large, c.too_large);
            EXPECT_EQ(report.negative, c.negative);
            EXPECT_EQ(report.not_numbers, 1U);
            EXPECT_EQ(report.clamped(), c.too_large + c.negative + 1);
            EXPECT_EQ(report.largest, INFINITY);
            const TextureBytes file = parsed(folder.file(name));
            const bool is_float = c.format == TexelFormat::kFloat;
            EXPECT_EQ(file.texel(0, 0, 0, 0)[0], is_float ? 2e6 : c.largest[0]);
            EXPECT_EQ(file.texel(0, 0, 0, 0)[1], c.negative > 0 ? 0
                                                 : is_float     ? -2e6
                                                                : -c.largest[0]);
            EXPECT_EQ(file.texel(0, 0, 0, 0)[2], 0);
            EXPECT_EQ(file.texel(0, 0, 1, 0)[0], c.negative > 0 ? 0 : -c.largest[0]);
            EXPECT_EQ(file.texel(0, 0, 0, 1)[1], c.largest[1]);
        }
    }
    Texture calm;
    calm.levels.emplace_back(2, 1, 3);
    calm.levels[0].at(1, 0, 1) = 65408;
    const TextureReport report = write_texture(folder.file("a.dds"), calm, {TexelFormat::kRgb9e5});
    EXPECT_EQ(report.clamped(), 0U);
    EXPECT_EQ(report.largest, 65408);
}

TEST(WriteTexture, MetadataTellOrientationAndWriter) {
    const TemporaryFolder folder;
    write_texture(folder.file("a.ktx2"), made(6, 4, 4, 3, 3, false));
    const TextureBytes file = parsed(folder.file("a.ktx2"));
    EXPECT_EQ(file.metadata.at("KTXorientation"), "rd");
    EXPECT_EQ(file.metadata.at("KTXwriter"), "Aureole");
}

TEST(WriteTexture, RefusesWhatIsNoTexture) {
    const TemporaryFolder folder;
    const auto refusal = [&](const Texture& texture, TexelFormat format = TexelFormat::kHalf,
                             const char* name = "a.dds") -> std::string {
        try {
            write_texture(folder.file(name), texture, {format});
        } catch (const InvalidArgument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal({}), HasSubstr("level 0"));
    EXPECT_THAT(refusal(made(2, 4, 4, 3, 1, false)), HasSubstr("1 or 6"));
    EXPECT_THAT(refusal(made(6, 4, 3, 3, 1, false)), HasSubstr("six squares"));
    EXPECT_THAT(refusal(made(1, 4, 4, 3, 4, false)), HasSubstr("at most 3"));
    EXPECT_THAT(refusal(made(1, 40000, 1, 2, 1, false)), HasSubstr("at most 32768"));
    EXPECT_THAT(refusal(made(1, 4, 4, 1, 1, false)), HasSubstr("2, 3 or 4"));
    EXPECT_THAT(refusal(made(1, 4, 4, 4, 1, true), TexelFormat::kRgb9e5), HasSubstr("holds 3"));
    EXPECT_THAT(refusal(made(1, 4, 4, 3, 1, true), TexelFormat::kHalf, "a.ktx"),
                HasSubstr(".dds or .ktx2"));
    Texture gap = made(1, 4, 4, 3, 3, false);
    gap.levels.erase(gap.levels.begin() + 1);
    EXPECT_THAT(refusal(gap), HasSubstr("must be 2x2, 3 channels"));
    Texture mixed = made(1, 4, 4, 3, 2, false);
    mixed.levels[1] = Image(2, 2, 4);
    EXPECT_THAT(refusal(mixed), HasSubstr("level 1"));
    EXPECT_TRUE(folder.names().empty());
}

TEST(WriteTexture, AppearsWholeOrNotAtAll) {
    const TemporaryFolder folder;
    const Texture texture = made(6, 4, 4, 3, 3, false);
    EXPECT_THROW(write_texture(folder.file("none/a.dds"), texture), FileError);
    EXPECT_TRUE(folder.names().empty());
    write_bytes(folder.file("a.dds"), "before");
    write_texture(folder.file("a.dds"), texture);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.dds"});
    expect_texels(folder.file("a.dds"), texture, TexelFormat::kHalf);
}

}  // namespace
}  // namespace aureole::io
