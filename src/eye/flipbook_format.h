// The bytes of a flipbook (docs/flipbooks.md, "File").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aureole/eye/flipbook.h"
#include "aureole/fourier/byte_spectrum.h"

namespace aureole::eye {

inline constexpr std::array<char, 8> kFlipbookMagic = {'A', 'U', 'R', 'B', 'O', 'O', 'K', '\n'};
inline constexpr std::uint32_t kFlipbookByteOrder = 0x01020304;
inline constexpr std::uint32_t kFlipbookVersion = 2;

struct FlipbookPreamble {
    std::array<char, 8> magic = kFlipbookMagic;
    std::uint32_t byte_order = kFlipbookByteOrder;
    std::uint32_t version = kFlipbookVersion;
    std::uint64_t file_bytes = 0;
    std::uint32_t head_bytes = 0;  // up to the first frame; a multiple of 64
    std::uint32_t text_bytes = 0;
    std::uint32_t frames = 0;
    std::uint32_t zero = 0;
};
static_assert(sizeof(FlipbookPreamble) == 40);

struct FlipbookEntry {
    std::uint32_t crc = 0;  // of the frame's bytes
    std::array<float, 3> scale = {};
    double weight = 0;
    std::array<double, 3> energy = {};
};
static_assert(sizeof(FlipbookEntry) == 48);

// The text in the head.
struct FlipbookText {
    wave::KernelGrid grid;
    wave::ApertureGrid aperture;
    FlipbookRange range;
    std::vector<NamedValue> identity;
};
std::string write_flipbook_text(const FlipbookText& text);
// Throws InvalidArgument for anything that write_flipbook_text does not write.
FlipbookText read_flipbook_text(std::string_view text);

// Throws InvalidArgument unless the grid is a raster of books.
void check_flipbook_grid(const wave::KernelGrid& grid);

// What a raster's spectra take.
struct SpectrumShape {
    explicit SpectrumShape(const wave::KernelGrid& grid)
        : rows(grid.width + 1), columns(rows / 2 + 1) {}
    std::size_t numbers() const {
        return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    }
    std::size_t bytes() const { return fourier::byte_spectrum_size(rows, columns); }
    std::size_t frame_bytes() const { return 3 * bytes(); }

    int rows;
    int columns;
};

// A book without its frames: they are to be written from head_bytes on, then it is to be sealed.
struct UnsealedBook {
    std::vector<std::byte> bytes;
    std::size_t head_bytes = 0;
};
UnsealedBook open_book(const FlipbookText& text);
// Writes entries and checksums (FlipbookEntry::crc too).
std::vector<std::byte> seal_book(UnsealedBook book, const FlipbookText& text,
                                 std::vector<FlipbookEntry> entries);

}  // namespace aureole::eye
