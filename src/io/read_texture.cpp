#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/texture.h"
#include "io/texture_container.h"

namespace aureole::io {
namespace {

constexpr std::size_t kBytesAtOnce = std::size_t{4} << 20;
constexpr std::size_t kMagicBytes = 12;

// The first bytes of a file, fewer if it is shorter.
std::string first_bytes(const TextureFile& file) {
    return file.read(0, static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kMagicBytes)),
                     "the beginning");
}

using Parser = StoredTexture (*)(const TextureFile&);

Parser parser_of(std::string_view beginning) {
    const auto starts = [&](std::string_view magic) {
        return beginning.substr(0, magic.size()) == magic;
    };
    if (starts(kDdsMagic)) return parse_dds;
    if (starts(kKtx1Magic)) return parse_ktx1;
    if (starts(kKtx2Magic)) return parse_ktx2;
    return nullptr;
}

void turn_bytes(std::byte* bytes, std::size_t size, std::size_t word) {
    for (std::size_t at = 0; at + word <= size; at += word) {
        std::reverse(bytes + at, bytes + at + word);
    }
}

void read_face(const TextureFile& file, const StoredTexture& stored, std::uint32_t level,
               std::uint32_t face, std::vector<std::byte>& bytes, Image& image) {
    const auto row_bytes = static_cast<std::size_t>(stored.row_bytes(level));
    const int height = static_cast<int>(stored.level_height(level));
    const int at_once = std::max(1, static_cast<int>(kBytesAtOnce / row_bytes));
    const int top = static_cast<int>(face) * height;
    const std::uint64_t offset = stored.offsets[std::size_t{level} * stored.faces + face];
    for (int begin = 0; begin < height; begin += at_once) {
        const auto rows = static_cast<std::size_t>(std::min(at_once, height - begin));
        bytes.resize(std::max(bytes.size(), rows * row_bytes));
        file.read(offset + static_cast<std::uint64_t>(begin) * row_bytes, rows * row_bytes,
                  bytes.data(), fmt::format("level {}", level));
        parallel_for(rows, [&](std::size_t row, int) {
            std::byte* from = bytes.data() + row * row_bytes;
            if (stored.swapped_bytes > 1) turn_bytes(from, row_bytes, stored.swapped_bytes);
            const int y = begin + static_cast<int>(row);
            decode_row(stored.texel, from, image, top + (stored.bottom_up ? height - 1 - y : y));
        });
    }
}

// Whether the last of four channels is 1 in all levels.
bool is_opaque(const std::vector<Image>& levels) {
    return std::all_of(levels.begin(), levels.end(), [](const Image& level) {
        const float* alpha = level.plane(3);
        return std::all_of(alpha, alpha + level.pixels(), [](float a) { return a == 1; });
    });
}

Texture read(const std::string& path) {
    const TextureFile file(path);
    const Parser parse = parser_of(first_bytes(file));
    if (parse == nullptr) file.fail("is neither a DDS nor a KTX file");
    const StoredTexture stored = parse(file);
    for (std::uint32_t level = 0; level < stored.levels; ++level) {
        for (std::uint32_t face = 0; face < stored.faces; ++face) {
            file.require(stored.offsets[std::size_t{level} * stored.faces + face],
                         stored.face_bytes(level), fmt::format("level {}", level));
        }
    }
    Texture texture;
    texture.faces = static_cast<int>(stored.faces);
    std::vector<std::byte> bytes;
    for (std::uint32_t level = 0; level < stored.levels; ++level) {
        Image image(static_cast<int>(stored.level_width(level)),
                    static_cast<int>(stored.level_height(level) * stored.faces),
                    stored.texel.channels);
        for (std::uint32_t face = 0; face < stored.faces; ++face) {
            read_face(file, stored, level, face, bytes, image);
        }
        texture.levels.push_back(std::move(image));
    }
    if (stored.texel.channels == 4 && is_opaque(texture.levels)) {
        for (Image& level : texture.levels) level = copy(level.view().channel_range(0, 3));
    }
    return texture;
}

}  // namespace

bool is_texture_file(const std::string& path) {
    try {
        return parser_of(first_bytes(TextureFile(path))) != nullptr;
    } catch (const FileError&) {
        return false;
    }
}

Texture read_texture(const std::string& path) {
    try {
        return read(path);
    } catch (const std::bad_alloc&) {
        throw FileError(path, "there is not enough memory to read it");
    }
}

}  // namespace aureole::io
