#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/random.h"
#include "aureole/io/texture.h"
#include "io/test_support.h"
#include "io/texture_fixtures.h"

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

TEST(DamagedTexture, WhatCannotBeReadIsNamed) {
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
TEST(DamagedTexture, NeverCrashes) {
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
