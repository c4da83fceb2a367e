#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/texture.h"
#include "io/readable.h"
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

TextureFile::TextureFile(const std::string& path) : path_(path) {
    check_readable(path);
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
        const bool opened = descriptor_ >= 0;
        const std::string reason = opened ? "it is not a regular file" : std::strerror(errno);
        if (opened) ::close(descriptor_);
        fail("cannot be read: " + reason);
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

TextureFile::~TextureFile() { ::close(descriptor_); }

void TextureFile::fail(const std::string& reason) const { throw FileError(path_, reason); }

void TextureFile::require(std::uint64_t offset, std::uint64_t size, const std::string& what) const {
    if (offset <= size_ && size <= size_ - offset) return;
    fail(fmt::format("truncated or damaged texture: {} needs {} bytes from {} on, the file has {}",
                     what, size, offset, size_));
}

void TextureFile::read(std::uint64_t offset, std::size_t size, void* to,
                       const std::string& what) const {
    require(offset, size, what);
    auto* bytes = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t got = ::pread(descriptor_, bytes, size, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0)
            fail(std::string("cannot be read: ") +
                 (got < 0 ? std::strerror(errno) : "it became shorter"));
        bytes += got;
        offset += static_cast<std::uint64_t>(got);
        size -= static_cast<std::size_t>(got);
    }
}

std::string TextureFile::read(std::uint64_t offset, std::size_t size,
                              const std::string& what) const {
    require(offset, size, what);
    std::string bytes(size, '\0');
    read(offset, size, bytes.data(), what);
    return bytes;
}

std::uint32_t u32_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
        value = value << 8U | static_cast<unsigned char>(bytes[offset + i]);
    }
    return value;
}

std::uint64_t u64_at(std::string_view bytes, std::size_t offset) {
    return u32_at(bytes, offset) | std::uint64_t{u32_at(bytes, offset + 4)} << 32U;
}

void check_shape(const TextureFile& file, const StoredTexture& stored) {
    const std::uint32_t side = std::max(stored.width, stored.height);
    if (stored.width == 0 || stored.height == 0 || side > kMostTexels) {
        file.fail(fmt::format("has {}x{} texels, sides must be in [1, {}]", stored.width,
                              stored.height, kMostTexels));
    }
    if (stored.faces != 1 && stored.faces != 6) {
        file.fail(fmt::format("has {} faces, must have 1 or 6", stored.faces));
    }
    if (stored.faces == 6 && stored.width != stored.height) {
        file.fail(fmt::format("is a cube map with faces of {}x{} texels, which must be squares",
                              stored.width, stored.height));
    }
    const auto most = static_cast<std::uint32_t>(std::bit_width(side));
    if (stored.levels > most) {
        file.fail(fmt::format("has {} levels, {}x{} texels can have at most {}", stored.levels,
                              stored.width, stored.height, most));
    }
}

std::string ktx_value(std::string_view pairs, std::string_view key, bool swapped) {
    while (pairs.size() >= 4) {
        std::uint32_t length = u32_at(pairs, 0);
        if (swapped) {
            const char bytes[] = {pairs[3], pairs[2], pairs[1], pairs[0]};
            length = u32_at({bytes, 4}, 0);
        }
        pairs.remove_prefix(4);
        if (length > pairs.size()) break;  // metadata do not decide whether texels can be read
        const std::string_view pair = pairs.substr(0, length);
        if (pair.size() > key.size() && pair.substr(0, key.size()) == key &&
            pair[key.size()] == '\0') {
            const std::string_view value = pair.substr(key.size() + 1);
            return std::string(value.substr(0, value.find('\0')));
        }
        pairs.remove_prefix(std::min<std::size_t>(pairs.size(), (std::size_t{length} + 3) / 4 * 4));
    }
    return "";
}

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
