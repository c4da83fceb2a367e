// Texture files made byte by byte, and textures to write: what the tests of reading share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "aureole/io/texture.h"
#include "io/exr_bytes.h"
#include "io/test_support.h"

namespace aureole::io {

inline std::string words(const std::vector<std::uint32_t>& values) {
    std::string bytes;
    for (const std::uint32_t value : values) bytes += little_endian(value);
    return bytes;
}

// A DDS file without DX10 header: `pixels` is flags, characters, bits, and the four masks.
inline std::string legacy_dds(std::uint32_t width, std::uint32_t height, std::uint32_t levels,
                              const std::vector<std::uint32_t>& pixels, std::uint32_t caps2,
                              const std::string& texels) {
    std::string bytes = "DDS " + words({124, 0x1007, height, width, 0, 0, levels});
    bytes += std::string(44, '\0') + words({32}) + words(pixels);
    return bytes + words({0x1000, caps2, 0, 0, 0}) + texels;
}

inline std::string dx10_dds(std::uint32_t dxgi, std::uint32_t dimension, std::uint32_t misc,
                            std::uint32_t array, std::uint32_t side, std::uint32_t levels,
                            const std::string& texels) {
    return legacy_dds(side, side, levels, {4, 0x30315844, 0, 0, 0, 0, 0}, 0, "") +
           words({dxgi, dimension, misc, array, 0}) + texels;
}

inline Texture sample_texture(int faces, int width, int height, int channels, int levels) {
    Texture texture;
    texture.faces = faces;
    for (int k = 0; k < levels; ++k) {
        texture.levels.push_back(noise(std::max(1, width >> k), std::max(1, height >> k) * faces,
                                       channels, static_cast<std::uint64_t>(k + 1)));
    }
    return texture;
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

inline std::string halves(const std::vector<int>& values) {  // small whole numbers
    std::string bytes;
    for (const int value : values) {
        const int exponent = value == 0 ? 0 : static_cast<int>(std::log2(value));
        const int code = value == 0 ? 0 : ((exponent + 14) << 10) + ((value << 10) >> exponent);
        bytes += little_endian(static_cast<std::uint16_t>(code));
    }
    return bytes;
}

}  // namespace aureole::io
