// KTX 2: Khronos, "KTX File Format Specification, version 2.0". A header, an index of the levels, a
// data format descriptor ("Khronos Data Format Specification 1.3", chapter 5) which tells bit by
// bit what the number of the format tells at once, pairs of metadata, then the levels from the
// smallest to the largest, each with all its faces, rows tightly packed.
#include <fmt/format.h>

#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "io/texture_container.h"

namespace aureole::io {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kIndexBytes = 24;  // per level: offset, length, length when inflated

void append32(std::string& bytes, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8U * i & 255U);
}

void append64(std::string& bytes, std::uint64_t value) {
    append32(bytes, static_cast<std::uint32_t>(value));
    append32(bytes, static_cast<std::uint32_t>(value >> 32U));
}

// One sample of the descriptor: which bits of a texel are which channel, and what they mean.
struct DescribedBits {
    std::uint32_t offset = 0;
    std::uint32_t count = 0;
    std::uint32_t channel = 0;  // 0 R, 1 G, 2 B, 15 alpha; or one of the qualifiers below
    std::uint32_t lowest = 0;   // stands for 0, or -1 of signed formats
    std::uint32_t highest = 0;  // stands for 1
};
constexpr std::uint32_t kAlphaChannel = 15;
constexpr std::uint32_t kExponent = 0x20;
constexpr std::uint32_t kSigned = 0x40;
constexpr std::uint32_t kFloatingPoint = 0x80;

std::vector<DescribedBits> described_bits(const TexelLayout& texel) {
    const auto one = std::bit_cast<std::uint32_t>(1.0F);
    if (texel.sample == Sample::kR11G11B10) {
        return {{0, 11, 0 | kFloatingPoint, 0, one},
                {11, 11, 1 | kFloatingPoint, 0, one},
                {22, 10, 2 | kFloatingPoint, 0, one}};
    }
    std::vector<DescribedBits> bits;
    if (texel.sample == Sample::kRgb9e5) {
        // Data Format Specification 1.3, table "R9G9B9E5": the exponent is named once per channel,
        // 15 is its bias, and 8448 what the mantissa of the largest value is to be divided by.
        for (std::uint32_t c = 0; c < 3; ++c) {
            bits.push_back({9 * c, 9, c, 0, 8448});
            bits.push_back({27, 5, c | kExponent, 15, 31});
        }
        return bits;
    }
    const std::uint32_t count = texel.sample == Sample::kHalf ? 16 : 32;
    for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(texel.stored); ++c) {
        bits.push_back({c * count, count, (c == 3 ? kAlphaChannel : c) | kFloatingPoint | kSigned,
                        std::bit_cast<std::uint32_t>(-1.0F), one});
    }
    return bits;
}

std::string descriptor(const TexelLayout& texel) {
    constexpr std::uint32_t kRgbModel = 1;    // RGBSDA
    constexpr std::uint32_t kRec709 = 1;      // primaries
    constexpr std::uint32_t kLinear = 1;      // transfer function
    constexpr std::uint32_t kVersion1_3 = 2;  // of the specification
    const std::vector<DescribedBits> bits = described_bits(texel);
    const auto size = static_cast<std::uint32_t>(24 + 16 * bits.size());
    std::string bytes;
    append32(bytes, size + 4);  // of the whole, itself included
    append32(bytes, 0);         // vendor Khronos, basic descriptor
    append32(bytes, kVersion1_3 | size << 16U);
    append32(bytes, kRgbModel | kRec709 << 8U | kLinear << 16U);
    append32(bytes, 0);  // blocks of one texel
    append32(bytes, static_cast<std::uint32_t>(texel_bytes(texel)));
    append32(bytes, 0);  // planes 4 to 7
    for (const DescribedBits& sample : bits) {
        append32(bytes, sample.offset | (sample.count - 1) << 16U | sample.channel << 24U);
        append32(bytes, 0);  // at the texel's place
        append32(bytes, sample.lowest);
        append32(bytes, sample.highest);
    }
    return bytes;
}

// Sorted by key, as the specification demands; each padded to four bytes.
std::string metadata() {
    std::string bytes;
    for (const auto& [key, value] :
         {std::pair<std::string, std::string>{"KTXorientation", "rd"}, {"KTXwriter", "Aureole"}}) {
        append32(bytes, static_cast<std::uint32_t>(key.size() + value.size() + 2));
        bytes += key + '\0' + value + '\0';
        bytes.resize((bytes.size() + 3) / 4 * 4);
    }
    return bytes;
}

std::string_view supercompression_name(std::uint32_t scheme) {
    if (scheme == 1) return "Basis Universal";
    if (scheme == 2) return "Zstandard";
    return scheme == 3 ? "ZLIB" : "unknown";
}

TexelLayout layout_of(const TextureFile& file, std::uint32_t vulkan) {
    for (const NamedLayout& named : kNamedLayouts) {
        if (named.vulkan == vulkan && vulkan != 0) return named.layout;
    }
    const bool bc6h = vulkan == 131 || vulkan == 132;
    file.fail(fmt::format(
        "VkFormat {}{}: only floats of 16 bits (83, 90, 97) or 32 bits (103, 106, 109), "
        "B10G11R11 (122), E5B9G9R9 (123) and 8-bit RGBA or BGRA (37, 43, 44, 50) are read",
        vulkan, bc6h ? " (BC6H: decompress it to R16G16B16A16_SFLOAT first)" : ""));
}

}  // namespace

std::string ktx2_header(const StoredTexture& stored, const NamedLayout& layout,
                        std::vector<std::uint64_t>& offsets) {
    const std::string format = descriptor(layout.layout);
    const std::string pairs = metadata();
    const auto format_offset =
        static_cast<std::uint32_t>(kHeaderBytes + kIndexBytes * stored.levels);
    const auto pairs_offset = static_cast<std::uint32_t>(format_offset + format.size());

    // Levels start at multiples of both the texel's size and 4, which divides all that are written.
    const std::uint64_t alignment = texel_bytes(layout.layout);
    offsets.assign(stored.levels, 0);
    std::uint64_t end = pairs_offset + pairs.size();
    for (std::uint32_t level = stored.levels; level-- > 0;) {
        offsets[level] = (end + alignment - 1) / alignment * alignment;
        end = offsets[level] + stored.face_bytes(level) * stored.faces;
    }

    std::string bytes(kKtx2Magic);
    append32(bytes, layout.vulkan);
    append32(bytes, layout.layout.sample == Sample::kHalf ? 2 : 4);  // bytes of a word
    append32(bytes, stored.width);
    append32(bytes, stored.height);
    append32(bytes, 0);  // no depth
    append32(bytes, 0);  // no array
    append32(bytes, stored.faces);
    append32(bytes, stored.levels);
    append32(bytes, 0);  // no supercompression
    append32(bytes, format_offset);
    append32(bytes, static_cast<std::uint32_t>(format.size()));
    append32(bytes, pairs_offset);
    append32(bytes, static_cast<std::uint32_t>(pairs.size()));
    append64(bytes, 0);  // supercompression has no data of its own
    append64(bytes, 0);
    for (std::uint32_t level = 0; level < stored.levels; ++level) {
        append64(bytes, offsets[level]);
        append64(bytes, stored.face_bytes(level) * stored.faces);
        append64(bytes, stored.face_bytes(level) * stored.faces);
    }
    return bytes + format + pairs;
}

StoredTexture parse_ktx2(const TextureFile& file) {
    const std::string header = file.read(0, kHeaderBytes, "the header");
    const std::uint32_t scheme = u32_at(header, 44);
    if (scheme != 0) {
        file.fail(fmt::format("supercompression {} ({}): only KTX 2 files without it are read",
                              scheme, supercompression_name(scheme)));
    }
    if (u32_at(header, 28) > 1) file.fail("is a volume, not a picture or cube map");
    if (u32_at(header, 32) > 1) {
        file.fail(fmt::format("is an array of {} textures, must be one", u32_at(header, 32)));
    }
    StoredTexture stored;
    stored.texel = layout_of(file, u32_at(header, 12));
    stored.width = u32_at(header, 20);
    stored.height = u32_at(header, 24);
    stored.faces = u32_at(header, 36);
    stored.levels = std::max(1U, u32_at(header, 40));  // 0: those after the first are to be made
    check_shape(file, stored);

    const std::uint32_t pairs_bytes = u32_at(header, 60);
    file.require(u32_at(header, 56), pairs_bytes, "the metadata");
    const std::string pairs = file.read(u32_at(header, 56), pairs_bytes, "the metadata");
    const std::string orientation = ktx_value(pairs, "KTXorientation");
    stored.bottom_up = stored.faces == 1 && orientation.size() > 1 && orientation[1] == 'u';

    const std::string index = file.read(kHeaderBytes, kIndexBytes * stored.levels, "the levels");
    for (std::uint32_t level = 0; level < stored.levels; ++level) {
        const std::uint64_t offset = u64_at(index, kIndexBytes * level);
        const std::uint64_t length = u64_at(index, kIndexBytes * level + 8);
        const std::uint64_t needed = stored.face_bytes(level) * stored.faces;
        if (length != needed) {
            file.fail(fmt::format("damaged KTX 2 file: level {} has {} bytes, must have {}", level,
                                  length, needed));
        }
        file.require(offset, length, fmt::format("level {}", level));
        for (std::uint32_t face = 0; face < stored.faces; ++face) {
            stored.offsets.push_back(offset + face * stored.face_bytes(level));
        }
    }
    return stored;
}

}  // namespace aureole::io
