// DDS and KTX files understood byte by byte, after Microsoft's "DDS Programming Guide", the "KTX
// File Format Specification 2.0" and the "Khronos Data Format Specification 1.3": an oracle for the
// writer that shares no code with it. Texels are taken apart by the bits that the data format
// descriptor names, in double precision. Whatever the specifications forbid is a runtime_error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace aureole::io {

struct TextureBytes {
    // A run of bits within a texel.
    struct Bits {
        unsigned offset = 0;
        unsigned count = 0;
        unsigned channel = 0;  // 0 R, 1 G, 2 B, 3 alpha
        bool is_signed = false;
        bool is_float = false;
        bool is_exponent = false;
    };

    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t faces = 0;
    std::uint32_t levels = 0;
    unsigned texel_bytes = 0;
    std::vector<Bits> bits;
    std::string bytes;
    std::map<std::pair<unsigned, unsigned>, std::uint64_t> places;  // of (level, face)
    std::map<std::string, std::string> metadata;

    static void demand(bool holds, const std::string& what) {
        if (!holds) throw std::runtime_error(what);
    }
    std::uint64_t number(std::uint64_t at, unsigned size) const {
        demand(at + size <= bytes.size(), "file is too short");
        std::uint64_t value = 0;
        for (unsigned i = 0; i < size; ++i) {
            value += std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
        }
        return value;
    }
    std::uint32_t word(std::uint64_t at) const { return static_cast<std::uint32_t>(number(at, 4)); }
    static std::uint32_t side(std::uint32_t base, unsigned level) {
        for (unsigned i = 0; i < level; ++i) base /= 2;
        return base == 0 ? 1 : base;
    }
    std::uint64_t face_size(unsigned level) const {
        return std::uint64_t{side(width, level)} * side(height, level) * texel_bytes;
    }

    // An IEEE-like number: a sign if it has one, exponent, mantissa.
    static double real(std::uint64_t code, unsigned count, bool is_signed) {
        demand(count == 10 || count == 11 || count == 16 || count == 32, "bits of a float");
        const unsigned exponent_bits = count == 32 ? 8 : 5;
        const unsigned mantissa_bits = count - exponent_bits - (is_signed ? 1 : 0);
        const auto mantissa = static_cast<double>(code % (std::uint64_t{1} << mantissa_bits));
        const auto exponent = static_cast<int>((code >> mantissa_bits) % (1U << exponent_bits));
        const int bias = (1 << (exponent_bits - 1)) - 1;
        const double sign = is_signed && (code >> (count - 1)) != 0 ? -1 : 1;
        const int m = static_cast<int>(mantissa_bits);
        if (exponent == (1 << exponent_bits) - 1) {
            return mantissa == 0 ? sign * INFINITY : std::numeric_limits<double>::quiet_NaN();
        }
        if (exponent == 0) return sign * std::ldexp(mantissa, 1 - bias - m);
        return sign * std::ldexp(std::ldexp(1.0, m) + mantissa, exponent - bias - m);
    }

    // The channels of a texel.
    std::vector<double> texel(unsigned level, unsigned face, unsigned x, unsigned y) const {
        const std::uint64_t at =
            places.at({level, face}) + (std::uint64_t{y} * side(width, level) + x) * texel_bytes;
        std::vector<double> channels;
        for (const Bits& run : bits) {
            std::uint64_t code = 0;
            for (unsigned i = 0; i < run.count; ++i) {
                const unsigned bit = run.offset + i;
                const auto byte = static_cast<unsigned char>(bytes.at(at + bit / 8));
                code += std::uint64_t{(byte >> (bit % 8)) & 1U} << i;
            }
            if (run.channel >= channels.size()) channels.resize(run.channel + 1);
            if (run.is_exponent) {  // of a mantissa that came before it
                channels[run.channel] =
                    std::ldexp(channels[run.channel], static_cast<int>(code) - 15 - 9);
            } else if (run.is_float) {
                channels[run.channel] = real(code, run.count, run.is_signed);
            } else {
                channels[run.channel] = static_cast<double>(code);
            }
        }
        return channels;
    }

    static std::vector<Bits> floats(unsigned channels, unsigned count) {
        std::vector<Bits> runs;
        for (unsigned c = 0; c < channels; ++c) runs.push_back({c * count, count, c, true, true});
        return runs;
    }
    static std::vector<Bits> packed() {
        return {{0, 11, 0, false, true}, {11, 11, 1, false, true}, {22, 10, 2, false, true}};
    }
    static std::vector<Bits> shared() {
        return {{0, 9, 0},  {27, 5, 0, false, false, true},
                {9, 9, 1},  {27, 5, 1, false, false, true},
                {18, 9, 2}, {27, 5, 2, false, false, true}};
    }

    static TextureBytes dds(const std::string& file) {
        TextureBytes t;
        t.bytes = file;
        demand(file.substr(0, 4) == "DDS ", "magic");
        demand(t.word(4) == 124 && t.word(76) == 32, "sizes of the headers");
        t.height = t.word(12);
        t.width = t.word(16);
        t.levels = t.word(28);
        const std::uint32_t flags = t.word(8);
        demand((flags & 0x1007) == 0x1007, "required flags");
        demand((flags & 0x20000) != 0 || t.levels == 1, "flag of levels");
        demand(t.word(80) == 4 && file.substr(84, 4) == "DX10", "pixel format");
        const std::uint32_t caps = t.word(108);
        const std::uint32_t caps2 = t.word(112);
        demand((caps & 0x1000) != 0, "caps: texture");
        demand((t.levels > 1) == ((caps & 0x400000) != 0), "caps: levels");
        demand((caps2 == 0 || caps2 == 0xfe00), "caps2");
        demand(t.word(132) == 3, "dimension");
        demand(t.word(136) == (caps2 == 0 ? 0 : 4), "cube in both headers");
        demand(t.word(140) == 1, "array size");
        demand(t.word(144) <= 4, "alpha mode");
        t.faces = caps2 == 0 ? 1 : 6;
        const std::map<std::uint32_t, std::vector<Bits>> formats = {
            {10, floats(4, 16)}, {2, floats(4, 32)}, {34, floats(2, 16)},
            {16, floats(2, 32)}, {26, packed()},     {67, shared()}};
        t.bits = formats.at(t.word(128));
        t.set_texel_bytes();
        demand((flags & 8) == 0 || t.word(20) == t.width * t.texel_bytes, "pitch");
        std::uint64_t at = 148;
        for (unsigned face = 0; face < t.faces; ++face) {
            for (unsigned level = 0; level < t.levels; ++level) {
                t.places[{level, face}] = at;
                at += t.face_size(level);
            }
        }
        demand(at == file.size(), "length of the file");
        return t;
    }

    static TextureBytes ktx2(const std::string& file) {
        TextureBytes t;
        t.bytes = file;
        demand(file.substr(0, 12) == "\xABKTX 20\xBB\r\n\x1A\n", "identifier");
        t.width = t.word(20);
        t.height = t.word(24);
        demand(t.word(28) == 0 && t.word(32) == 0, "neither depth nor layers");
        t.faces = t.word(36);
        t.levels = t.word(40);
        demand(t.word(44) == 0, "supercompression");
        const std::uint64_t format_at = t.word(48);
        const std::uint64_t pairs_at = t.word(56);
        const std::uint64_t pairs_end = pairs_at + t.word(60);
        demand(format_at == 80 + 24 * t.levels, "descriptor follows the index");
        demand(pairs_at == format_at + t.word(52), "metadata follow the descriptor");
        demand(t.number(64, 8) == 0 && t.number(72, 8) == 0, "no global data");
        t.read_descriptor(format_at, t.word(52));
        t.check_format(t.word(12), t.word(16));
        t.read_metadata(pairs_at, pairs_end);

        // From the smallest level on, without gaps but for alignment, which is zero.
        const std::uint64_t alignment = t.texel_bytes % 4 == 0 ? t.texel_bytes : 4 * t.texel_bytes;
        demand(alignment > 0, "size of a texel");
        std::uint64_t at = pairs_end;
        for (unsigned level = t.levels; level-- > 0;) {
            const std::uint64_t start = (at + alignment - 1) / alignment * alignment;
            for (; at < start; ++at) demand(file.at(at) == 0, "padding");
            const std::uint64_t length = t.face_size(level) * t.faces;
            demand(t.number(80 + 24 * level, 8) == start, "place of a level");
            demand(t.number(88 + 24 * level, 8) == length, "length of a level");
            demand(t.number(96 + 24 * level, 8) == length, "uncompressed length of a level");
            for (unsigned face = 0; face < t.faces; ++face) {
                t.places[{level, face}] = start + face * t.face_size(level);
            }
            at = start + length;
        }
        demand(at == file.size(), "length of the file");
        return t;
    }

    void set_texel_bytes() {
        unsigned end = 0;
        for (const Bits& run : bits) end = std::max(end, run.offset + run.count);
        texel_bytes = end / 8;
    }

    void read_descriptor(std::uint64_t at, std::uint32_t length) {
        demand(word(at) == length, "total size of the descriptor");
        demand(word(at + 4) == 0, "vendor and type");
        const std::uint32_t size = word(at + 8) >> 16;
        demand((word(at + 8) & 0xffff) == 2 && size + 4 == length && (size - 24) % 16 == 0,
               "version and size of the descriptor block");
        demand(word(at + 12) == (1U | 1U << 8 | 1U << 16), "RGBSDA, BT.709, linear, no flags");
        demand(word(at + 16) == 0 && word(at + 24) == 0, "blocks of one texel, one plane");
        const std::uint32_t one = 0x3f800000;
        for (std::uint64_t s = at + 28; s < at + length; s += 16) {
            const std::uint32_t first = word(s);
            const std::uint32_t channel = first >> 24 & 15;
            const std::uint32_t lower = word(s + 8);
            const std::uint32_t upper = word(s + 12);
            Bits run{first & 0xffff,
                     (first >> 16 & 255) + 1,
                     channel == 15 ? 3 : channel,
                     (first >> 24 & 0x40) != 0,
                     (first >> 24 & 0x80) != 0,
                     (first >> 24 & 0x20) != 0};
            demand((first >> 24 & 0x10) == 0 && word(s + 4) == 0, "qualifier, sample position");
            if (run.is_float) {
                demand(lower == (run.is_signed ? 0xbf800000 : 0) && upper == one, "float range");
            } else if (run.is_exponent) {
                demand(lower == 15 && upper == 31, "exponent range");
            } else {
                demand(lower == 0 && upper == 8448, "mantissa range");
            }
            bits.push_back(run);
        }
        set_texel_bytes();
        demand(word(at + 20) == texel_bytes, "bytesPlane0");
    }

    // The number of the format and the descriptor must agree.
    void check_format(std::uint32_t vulkan, std::uint32_t type_size) const {
        struct Known {
            std::vector<Bits> runs;
            std::uint32_t type_size;
        };
        const std::map<std::uint32_t, Known> formats = {
            {83, {floats(2, 16), 2}},  {97, {floats(4, 16), 2}}, {103, {floats(2, 32), 4}},
            {109, {floats(4, 32), 4}}, {122, {packed(), 4}},     {123, {shared(), 4}}};
        const Known& known = formats.at(vulkan);
        demand(type_size == known.type_size, "typeSize");
        demand(bits.size() == known.runs.size(), "number of samples");
        for (std::size_t i = 0; i < bits.size(); ++i) {
            const Bits& a = bits[i];
            const Bits& b = known.runs[i];
            demand(a.offset == b.offset && a.count == b.count && a.channel == b.channel &&
                       a.is_signed == b.is_signed && a.is_float == b.is_float &&
                       a.is_exponent == b.is_exponent,
                   "samples of the format");
        }
    }

    void read_metadata(std::uint64_t at, std::uint64_t end) {
        std::string before;
        while (at < end) {
            const std::uint32_t length = word(at);
            const std::string pair = bytes.substr(at + 4, length);
            const std::string key = pair.substr(0, pair.find('\0'));
            demand(key > before, "keys are sorted");
            demand(pair.back() == '\0' && pair.size() > key.size() + 1, "closing zero");
            before = key;
            metadata[key] = pair.substr(key.size() + 1, pair.size() - key.size() - 2);
            at += 4 + length;
            for (; at % 4 != 0; ++at) demand(bytes.at(at) == 0, "padding of metadata");
        }
        demand(at == end, "length of the metadata");
    }
};

}  // namespace aureole::io
