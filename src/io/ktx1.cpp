// KTX 1: Khronos, "KTX File Format Specification" of 2018. In the byte order of the machine that
// wrote it; rows padded to four bytes as OpenGL does by default; each level is preceded by its
// length, of a single face if it is a cube map.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "io/texture_container.h"

namespace aureole::io {
namespace {

constexpr std::size_t kHeaderBytes = 64;

// OpenGL 4.6 specification, tables 8.2 and 8.3.
enum GlType : std::uint32_t {
    kUnsignedByte = 0x1401,
    kFloat32 = 0x1406,
    kFloat16 = 0x140b,
    kUnsignedInt10F11F11FRev = 0x8c3b,
    kUnsignedInt5999Rev = 0x8c3e,
};
enum GlFormat : std::uint32_t {
    kRgb = 0x1907,
    kRgba = 0x1908,
    kBgr = 0x80e0,
    kBgra = 0x80e1,
    kRg = 0x8227,
};
// glInternalFormat, of which only this matters: what the file holds is told by type and format.
constexpr std::uint32_t kSrgb8 = 0x8c41;
constexpr std::uint32_t kSrgb8Alpha8 = 0x8c43;

std::optional<TexelLayout> layout_of(std::uint32_t type, std::uint32_t format,
                                     std::uint32_t internal) {
    const bool blue_first = format == kBgr || format == kBgra;
    const bool four = format == kRgba || format == kBgra;
    if (format != kRg && format != kRgb && !four && !blue_first) return std::nullopt;
    const int channels = four ? 4 : format == kRg ? 2 : 3;
    switch (type) {
        case kFloat16:
            return TexelLayout{Sample::kHalf, channels, channels, blue_first};
        case kFloat32:
            return TexelLayout{Sample::kFloat, channels, channels, blue_first};
        case kUnsignedByte: {
            const bool srgb = internal == kSrgb8 || internal == kSrgb8Alpha8;
            return TexelLayout{srgb ? Sample::kSrgbByte : Sample::kByte, channels, channels,
                               blue_first};
        }
        case kUnsignedInt10F11F11FRev:
            if (format != kRgb) return std::nullopt;
            return TexelLayout{Sample::kR11G11B10, 3, 3};
        case kUnsignedInt5999Rev:
            if (format != kRgb) return std::nullopt;
            return TexelLayout{Sample::kRgb9e5, 3, 3};
        default:
            return std::nullopt;
    }
}

std::size_t word_bytes(Sample sample) {
    if (sample == Sample::kHalf) return 2;
    return sample == Sample::kByte || sample == Sample::kSrgbByte ? 1 : 4;
}

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

std::uint32_t swapped(std::uint32_t value) {
    return value << 24U | (value & 0xff00U) << 8U | (value >> 8U & 0xff00U) | value >> 24U;
}

}  // namespace

StoredTexture parse_ktx1(const TextureFile& file) {
    const std::string header = file.read(0, kHeaderBytes, "the header");
    const std::uint32_t order = u32_at(header, 12);
    if (order != 0x04030201U && order != 0x01020304U) {
        file.fail(
            fmt::format("damaged KTX file: byte order {:#010x}, must be 0x04030201 or "
                        "0x01020304",
                        order));
    }
    const bool swap = order == 0x01020304U;
    const auto word = [&](std::string_view bytes, std::size_t at) {
        const std::uint32_t value = u32_at(bytes, at);
        return swap ? swapped(value) : value;
    };
    const std::uint32_t type = word(header, 16);
    const std::uint32_t format = word(header, 24);
    const std::uint32_t internal = word(header, 28);
    const auto layout = layout_of(type, format, internal);
    if (!layout) {
        file.fail(fmt::format(
            "OpenGL type {:#x} with format {:#x}, internally {:#x}: only floats of 16 or 32 bits, "
            "10F_11F_11F_REV, 5_9_9_9_REV and unsigned bytes as RG, RGB, RGBA, BGR, BGRA are read",
            type, format, internal));
    }
    if (word(header, 44) > 1) file.fail("is a volume, not a picture or cube map");
    if (word(header, 48) > 1) {
        file.fail(fmt::format("is an array of {} textures, must be one", word(header, 48)));
    }
    StoredTexture stored;
    stored.texel = *layout;
    stored.width = word(header, 36);
    stored.height = word(header, 40);
    stored.faces = word(header, 52);
    stored.levels = std::max(1U, word(header, 56));  // 0: those after the first are to be made
    stored.row_alignment = 4;
    if (swap) stored.swapped_bytes = word_bytes(stored.texel.sample);
    check_shape(file, stored);

    const std::uint32_t pairs_bytes = word(header, 60);
    file.require(kHeaderBytes, pairs_bytes, "the metadata");
    const std::string pairs = file.read(kHeaderBytes, pairs_bytes, "the metadata");
    const std::string orientation = ktx_value(pairs, "KTXorientation", swap);
    stored.bottom_up = stored.faces == 1 && orientation.find("T=u") != std::string::npos;

    std::uint64_t offset = kHeaderBytes + std::uint64_t{pairs_bytes};
    for (std::uint32_t level = 0; level < stored.levels; ++level) {
        const std::string what = fmt::format("level {}", level);
        const std::uint32_t length = word(file.read(offset, 4, what), 0);
        offset += 4;
        const std::uint64_t face_bytes = stored.face_bytes(level);
        // Some writers give the length of all faces, against the specification.
        if (length != face_bytes && length != face_bytes * stored.faces) {
            file.fail(fmt::format("damaged KTX file: level {} has {} bytes a face, must have {}",
                                  level, length, face_bytes));
        }
        for (std::uint32_t face = 0; face < stored.faces; ++face) {
            file.require(offset, face_bytes, what);
            stored.offsets.push_back(offset);
            offset += padded(face_bytes);
        }
    }
    return stored;
}

}  // namespace aureole::io
