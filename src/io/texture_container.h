// How DDS and KTX files lay out the texels of a texture: internal to the module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/texel.h"

namespace aureole::io {

inline constexpr std::uint32_t kMostTexels = 32768;  // per side of a face

// What a container holds, before any texel is looked at.
struct StoredTexture {
    TexelLayout texel;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t faces = 1;
    std::uint32_t levels = 1;
    // Of the reader only:
    std::size_t row_alignment = 1;
    std::size_t swapped_bytes = 1;       // of each this many bytes the order is turned round
    bool bottom_up = false;              // row 0 is the lowest
    std::vector<std::uint64_t> offsets;  // in the file, of face f of level k: [k * faces + f]

    std::uint32_t level_width(std::uint32_t level) const;
    std::uint32_t level_height(std::uint32_t level) const;
    std::uint64_t row_bytes(std::uint32_t level) const;
    std::uint64_t face_bytes(std::uint32_t level) const;
};

// The first bytes of the files.
inline constexpr std::string_view kDdsMagic = "DDS ";
inline constexpr std::string_view kKtx1Magic = "\xABKTX 11\xBB\r\n\x1A\n";
inline constexpr std::string_view kKtx2Magic = "\xABKTX 20\xBB\r\n\x1A\n";

// Everything before the first texel. DDS: then follow, for each face, its levels from the largest.
std::string dds_header(const StoredTexture& stored, const NamedLayout& layout);
// KTX 2: then follow the levels from the smallest, with all their faces; level k starts at
// offsets[k], and the bytes between levels are zero. Sets offsets, one per level.
std::string ktx2_header(const StoredTexture& stored, const NamedLayout& layout,
                        std::vector<std::uint64_t>& offsets);

// A file whose length is known, and whose bytes are there or an error says what is missing.
class TextureFile {
  public:
    // Throws FileError.
    explicit TextureFile(const std::string& path);
    ~TextureFile();
    TextureFile(const TextureFile&) = delete;
    TextureFile& operator=(const TextureFile&) = delete;

    const std::string& path() const noexcept { return path_; }
    std::uint64_t size() const noexcept { return size_; }
    // Throws FileError unless bytes [offset, offset + size) are in the file; `what` they are.
    void require(std::uint64_t offset, std::uint64_t size, const std::string& what) const;
    void read(std::uint64_t offset, std::size_t size, void* to, const std::string& what) const;
    std::string read(std::uint64_t offset, std::size_t size, const std::string& what) const;
    [[noreturn]] void fail(const std::string& reason) const;

  private:
    std::string path_;
    std::uint64_t size_ = 0;
    int descriptor_ = -1;
};

// Little-endian.
std::uint32_t u32_at(std::string_view bytes, std::size_t offset);
std::uint64_t u64_at(std::string_view bytes, std::size_t offset);

// Sides and levels that no texture has are a FileError.
void check_shape(const TextureFile& file, const StoredTexture& stored);

StoredTexture parse_dds(const TextureFile& file);
StoredTexture parse_ktx1(const TextureFile& file);
StoredTexture parse_ktx2(const TextureFile& file);

// The value of a key among KTX metadata without its closing zero; empty if it is not there. Both
// versions store pairs alike; `swapped` if the lengths have their high byte first.
std::string ktx_value(std::string_view pairs, std::string_view key, bool swapped = false);

}  // namespace aureole::io
