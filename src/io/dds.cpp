// DDS: "DDS Programming Guide" and "DDS_HEADER", "DDS_HEADER_DXT10", "DXGI_FORMAT" of Microsoft's
// Direct3D documentation. A header of 124 bytes after four of magic, 20 more of the DX10 extension
// if the pixel format is the four characters DX10, then the texels, rows tightly packed: each face
// with all its levels.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/texture_container.h"

namespace aureole::io {
namespace {

// From the start of the file.
enum Place : std::size_t {
    kHeaderSize = 4,
    kHeight = 12,
    kWidth = 16,
    kLevels = 28,
    kPixelFormatSize = 76,
    kPixelFlags = 80,
    kFourCc = 84,
    kBits = 88,
    kRedMask = 92,
    kAlphaMask = 104,
    kCaps2 = 112,
    kDxgiFormat = 128,
    kDimension = 132,
    kMisc = 136,
    kArraySize = 140,
};
constexpr std::size_t kLegacyBytes = 128;
constexpr std::size_t kDx10Bytes = 148;

constexpr std::uint32_t kHeaderFlags =
    0x1 | 0x2 | 0x4 | 0x8 | 0x1000;  // caps, sides, pitch, format
constexpr std::uint32_t kHasLevels = 0x20000;
constexpr std::uint32_t kPixelsFourCc = 0x4;
constexpr std::uint32_t kPixelsRgb = 0x40;
constexpr std::uint32_t kPixelsAlpha = 0x1;
constexpr std::uint32_t kDx10 = 0x30315844;  // "DX10"
constexpr std::uint32_t kCapsTexture = 0x1000;
constexpr std::uint32_t kCapsComplex = 0x8;
constexpr std::uint32_t kCapsMipmap = 0x400000;
constexpr std::uint32_t kCaps2Cube = 0x200;
constexpr std::uint32_t kCaps2AllFaces = 0xfc00;
constexpr std::uint32_t kCaps2Volume = 0x200000;
constexpr std::uint32_t kTexture2d = 3;
constexpr std::uint32_t kMiscCube = 0x4;
constexpr std::uint32_t kAlphaStraight = 1;

void put(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> 8U * i & 255U);
}

std::string four_characters(std::uint32_t code) {
    std::string text;
    for (unsigned i = 0; i < 4; ++i) {
        const auto c = static_cast<unsigned char>(code >> 8U * i & 255U);
        if (c < 32 || c > 126) return std::to_string(code);
        text += static_cast<char>(c);
    }
    return "\"" + text + "\"";
}

std::string_view compressed_name(std::uint32_t dxgi) {
    if (dxgi == 95 || dxgi == 96) return " (BC6H: decompress it to RGBA16F first)";
    return (dxgi >= 70 && dxgi <= 84) || (dxgi >= 97 && dxgi <= 99) ? " (block compressed)" : "";
}

TexelLayout dx10_layout(const TextureFile& file, std::uint32_t dxgi) {
    for (const NamedLayout& named : kNamedLayouts) {
        if (named.dxgi == dxgi && dxgi != 0) return named.layout;
    }
    file.fail(
        fmt::format("DXGI format {}{}: only RGBA16F (10), RGBA32F (2), RGB32F (6), RG16F "
                    "(34), RG32F (16), R11G11B10 (26), RGB9E5 (67) and 8-bit RGBA or BGRA "
                    "(28, 29, 87, 88, 91, 93) are read",
                    dxgi, compressed_name(dxgi)));
}

// Direct3D 9's numbers of its floating-point formats stand where others have four characters.
TexelLayout legacy_layout(const TextureFile& file, const std::string& header) {
    const std::uint32_t flags = u32_at(header, kPixelFlags);
    if ((flags & kPixelsFourCc) != 0) {
        const std::uint32_t code = u32_at(header, kFourCc);
        switch (code) {
            case 112:
                return {Sample::kHalf, 2, 2};
            case 113:  // A16B16G16R16F
                return {Sample::kHalf, 4, 4};
            case 115:
                return {Sample::kFloat, 2, 2};
            case 116:  // A32B32G32R32F
                return {Sample::kFloat, 4, 4};
            default:
                file.fail(
                    fmt::format("pixel format {}: only DX10, 112, 113, 115, 116 (floats) and "
                                "uncompressed 8-bit RGB are read",
                                four_characters(code)));
        }
    }
    const std::uint32_t bits = u32_at(header, kBits);
    const std::uint32_t red = u32_at(header, kRedMask);
    const bool alpha = bits == 32 && (flags & kPixelsAlpha) != 0;
    const bool known_alpha = !alpha || u32_at(header, kAlphaMask) == 0xff000000U;
    const bool known_colour = (red == 0xffU || red == 0xff0000U) &&
                              u32_at(header, kRedMask + 4) == 0xff00U &&
                              u32_at(header, kRedMask + 8) == (red ^ 0xff00ffU);
    if ((flags & kPixelsRgb) == 0 || (bits != 24 && bits != 32) || !known_alpha || !known_colour) {
        file.fail(
            fmt::format("pixel format of {} bits with red mask {:#x}: only 8 bits each of R, "
                        "G, B and alpha are read",
                        bits, red));
    }
    return {Sample::kSrgbByte, alpha ? 4 : 3, bits == 32 ? 4 : 3, red != 0xffU};
}

}  // namespace

std::string dds_header(const StoredTexture& stored, const NamedLayout& layout) {
    const bool cube = stored.faces == 6;
    const bool chain = stored.levels > 1;
    std::string bytes(kDx10Bytes, '\0');
    std::copy(kDdsMagic.begin(), kDdsMagic.end(), bytes.begin());
    put(bytes, kHeaderSize, 124);
    put(bytes, kHeaderSize + 4, kHeaderFlags | (chain ? kHasLevels : 0));
    put(bytes, kHeight, stored.height);
    put(bytes, kWidth, stored.width);
    put(bytes, kWidth + 4, static_cast<std::uint32_t>(stored.row_bytes(0)));
    put(bytes, kLevels, stored.levels);
    put(bytes, kPixelFormatSize, 32);
    put(bytes, kPixelFlags, kPixelsFourCc);
    put(bytes, kFourCc, kDx10);
    put(bytes, kCaps2 - 4,
        kCapsTexture | (cube || chain ? kCapsComplex : 0) | (chain ? kCapsMipmap : 0));
    put(bytes, kCaps2, cube ? kCaps2Cube | kCaps2AllFaces : 0);
    put(bytes, kDxgiFormat, layout.dxgi);
    put(bytes, kDimension, kTexture2d);
    put(bytes, kMisc, cube ? kMiscCube : 0);
    put(bytes, kArraySize, 1);
    put(bytes, kArraySize + 4, layout.layout.channels == 4 ? kAlphaStraight : 0);
    return bytes;
}

StoredTexture parse_dds(const TextureFile& file) {
    std::string header = file.read(0, kLegacyBytes, "the header");
    const std::uint32_t size = u32_at(header, kHeaderSize);
    const std::uint32_t pixel_size = u32_at(header, kPixelFormatSize);
    if (size != 124 || pixel_size != 32) {
        file.fail(fmt::format("damaged DDS header: sizes {} and {}, must be 124 and 32", size,
                              pixel_size));
    }
    StoredTexture stored;
    stored.height = u32_at(header, kHeight);
    stored.width = u32_at(header, kWidth);
    stored.levels = std::max(1U, u32_at(header, kLevels));
    const std::uint32_t caps2 = u32_at(header, kCaps2);
    if ((caps2 & kCaps2Volume) != 0) file.fail("is a volume, not a picture or cube map");
    const bool dx10 =
        (u32_at(header, kPixelFlags) & kPixelsFourCc) != 0 && u32_at(header, kFourCc) == kDx10;
    std::uint64_t offset = kLegacyBytes;
    bool cube = (caps2 & kCaps2Cube) != 0;
    if (dx10) {
        header = file.read(0, kDx10Bytes, "the DX10 header");
        offset = kDx10Bytes;
        cube = (u32_at(header, kMisc) & kMiscCube) != 0;
        const std::uint32_t dimension = u32_at(header, kDimension);
        if (dimension != kTexture2d) {
            file.fail(
                fmt::format("DDS resource dimension {}: must be 3 (two-dimensional)", dimension));
        }
        const std::uint32_t array = u32_at(header, kArraySize);
        if (array > 1) {  // some writers leave it 0
            file.fail(fmt::format("is an array of {} textures, must be one", array));
        }
        stored.texel = dx10_layout(file, u32_at(header, kDxgiFormat));
    } else {
        if (cube && (caps2 & kCaps2AllFaces) != kCaps2AllFaces) {
            file.fail(fmt::format("is a cube map without all of its faces (caps2 {:#x})", caps2));
        }
        stored.texel = legacy_layout(file, header);
    }
    stored.faces = cube ? 6 : 1;
    check_shape(file, stored);
    stored.offsets.resize(std::size_t{stored.levels} * stored.faces);
    for (std::uint32_t face = 0; face < stored.faces; ++face) {
        for (std::uint32_t level = 0; level < stored.levels; ++level) {
            stored.offsets[std::size_t{level} * stored.faces + face] = offset;
            offset += stored.face_bytes(level);
        }
    }
    return stored;
}

}  // namespace aureole::io
