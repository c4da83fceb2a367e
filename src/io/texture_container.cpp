#include "io/texture_container.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "aureole/base/error.h"
#include "io/readable.h"

namespace aureole::io {

std::uint32_t StoredTexture::level_width(std::uint32_t level) const {
    return std::max(1U, width >> level);
}

std::uint32_t StoredTexture::level_height(std::uint32_t level) const {
    return std::max(1U, height >> level);
}

std::uint64_t StoredTexture::row_bytes(std::uint32_t level) const {
    const std::uint64_t bytes = std::uint64_t{level_width(level)} * texel_bytes(texel);
    return (bytes + row_alignment - 1) / row_alignment * row_alignment;
}

std::uint64_t StoredTexture::face_bytes(std::uint32_t level) const {
    return row_bytes(level) * level_height(level);
}

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

}  // namespace aureole::io
