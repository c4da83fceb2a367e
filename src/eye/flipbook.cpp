#include "aureole/eye/flipbook.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "aureole/base/crc32.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/fourier/byte_spectrum.h"
#include "aureole/fourier/sizes.h"
#include "eye/flipbook_format.h"
#include "eye/flipbook_selection.h"
#include "eye/kernel_checks.h"

namespace aureole::eye {
namespace {

constexpr std::size_t kHeadAlignment = 64;
constexpr std::size_t kSmallestTransform = 64;
constexpr std::size_t kLargestTransform = 4096;

std::size_t rounded_up(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

// The head: preamble, text, zeros up to a multiple of 8, entries, zeros, and in its last four bytes
// the checksum of all of it before.
std::size_t entries_at(std::size_t text_bytes) {
    return rounded_up(sizeof(FlipbookPreamble) + text_bytes, 8);
}
std::size_t head_size(std::size_t text_bytes, std::size_t frames) {
    return rounded_up(entries_at(text_bytes) + frames * sizeof(FlipbookEntry) + 4, kHeadAlignment);
}

template <class T>
T read(std::span<const std::byte> bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

template <class T>
void write(std::span<std::byte> bytes, std::size_t at, const T& value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

// Says what is wrong with bytes that cannot be a book of this program at all.
FlipbookPreamble checked_preamble(std::span<const std::byte> bytes) {
    const char* const foreign = "is no flipbook of aureole";
    if (bytes.size() < sizeof(FlipbookPreamble)) throw InvalidArgument(foreign);
    const auto preamble = read<FlipbookPreamble>(bytes, 0);
    if (preamble.magic != kFlipbookMagic) throw InvalidArgument(foreign);
    if (preamble.byte_order == 0x04030201) {
        throw InvalidArgument("was baked on a machine of the other byte order: bake it here again");
    }
    if (preamble.byte_order != kFlipbookByteOrder) {
        throw InvalidArgument("is damaged: its mark of byte order is none");
    }
    if (preamble.version > kFlipbookVersion) {
        throw InvalidArgument(fmt::format(
            "has version {} of the format, and this program reads version {}: it was baked by a "
            "newer one",
            preamble.version, kFlipbookVersion));
    }
    if (preamble.version < kFlipbookVersion) {
        throw InvalidArgument(fmt::format(
            "has version {} of the format, and this program reads version {}: bake it again",
            preamble.version, kFlipbookVersion));
    }
    if (bytes.size() != preamble.file_bytes) {
        throw InvalidArgument(fmt::format(
            "has {} bytes and says that it should have {}: it is {}", bytes.size(),
            preamble.file_bytes,
            bytes.size() < preamble.file_bytes ? "cut off" : "damaged, or something was added"));
    }
    const std::size_t head = preamble.head_bytes;
    if (head > bytes.size() || head % kHeadAlignment != 0 ||
        head != head_size(preamble.text_bytes, preamble.frames) ||
        crc32(bytes.first(head - 4)) != read<std::uint32_t>(bytes, head - 4)) {
        throw InvalidArgument("is damaged: the checksum of its head is wrong");
    }
    return preamble;
}

std::string frame_name(const FlipbookRange& range, std::size_t frame) {
    const FlipbookAxes axes(range);
    const auto [term, first] =
        frame < axes.first_halo ? std::pair<const char*, std::size_t>{"texture", 0}
        : frame < axes.first_streaks
            ? std::pair<const char*, std::size_t>{"halo", axes.first_halo}
            : std::pair<const char*, std::size_t>{"streaks", axes.first_streaks};
    return fmt::format("frame {} of the {}", frame - first, term);
}

bool is_finite(const FlipbookEntry& entry) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return std::all_of(entry.scale.begin(), entry.scale.end(), finite) && finite(entry.weight) &&
           std::all_of(entry.energy.begin(), entry.energy.end(), finite);
}

}  // namespace

void check_flipbook_grid(const wave::KernelGrid& grid) {
    check_kernel(grid);
    const int size = grid.width + 1;
    if (grid.width == grid.height && size >= static_cast<int>(kSmallestTransform) &&
        size <= static_cast<int>(kLargestTransform) && fourier::is_smooth(size)) {
        return;
    }
    throw InvalidArgument("raster of a flipbook", fmt::format("{}x{}", grid.width, grid.height),
                          "must be square, and one less than an even number from 64 to 4096 "
                          "without prime factors above 7");
}

UnsealedBook open_book(const FlipbookText& text) {
    UnsealedBook book;
    const std::size_t frames = FlipbookAxes(text.range).frames;
    book.head_bytes = head_size(write_flipbook_text(text).size(), frames);
    book.bytes.resize(book.head_bytes + frames * SpectrumShape(text.grid).frame_bytes());
    return book;
}

std::vector<std::byte> seal_book(UnsealedBook book, const FlipbookText& text,
                                 std::vector<FlipbookEntry> entries) {
    const std::span<std::byte> bytes(book.bytes);
    const std::string words = write_flipbook_text(text);
    const std::size_t size = SpectrumShape(text.grid).frame_bytes();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        entries[i].crc = crc32(bytes.subspan(book.head_bytes + i * size, size));
        write(bytes, entries_at(words.size()) + i * sizeof(FlipbookEntry), entries[i]);
    }
    FlipbookPreamble preamble;
    preamble.file_bytes = bytes.size();
    preamble.head_bytes = static_cast<std::uint32_t>(book.head_bytes);
    preamble.text_bytes = static_cast<std::uint32_t>(words.size());
    preamble.frames = static_cast<std::uint32_t>(entries.size());
    write(bytes, 0, preamble);
    std::memcpy(bytes.data() + sizeof preamble, words.data(), words.size());
    write(bytes, book.head_bytes - 4, crc32(bytes.first(book.head_bytes - 4)));
    return std::move(book.bytes);
}

Flipbook::Flipbook(std::span<const std::byte> bytes) : bytes_(bytes) {
    if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0) {
        throw InvalidArgument("bytes of a flipbook must begin at a multiple of 8");
    }
    const FlipbookPreamble preamble = checked_preamble(bytes);
    FlipbookText text;
    try {
        text = read_flipbook_text(
            {reinterpret_cast<const char*>(bytes.data()) + sizeof preamble, preamble.text_bytes});
    } catch (const InvalidArgument& error) {
        throw InvalidArgument(std::string("is damaged: ") + error.what());
    }
    grid_ = text.grid;
    aperture_ = text.aperture;
    range_ = text.range;
    identity_ = std::move(text.identity);
    const std::size_t frames = FlipbookAxes(range_).frames;
    const SpectrumShape shape(grid_);
    const std::size_t size = shape.frame_bytes();
    if (preamble.frames != frames || bytes.size() != preamble.head_bytes + frames * size) {
        throw InvalidArgument(fmt::format("is damaged: it should have {} frames", frames));
    }

    frames_.resize(frames);
    std::vector<std::uint8_t> good(frames);
    parallel_for(frames, [&](std::size_t i, int) {
        const auto entry =
            read<FlipbookEntry>(bytes, entries_at(preamble.text_bytes) + i * sizeof(FlipbookEntry));
        const auto stored = bytes.subspan(preamble.head_bytes + i * size, size);
        bool is_good = crc32(stored) == entry.crc && is_finite(entry);
        Frame& frame = frames_[i];
        frame.weight = entry.weight;
        frame.energy = entry.energy;
        frame.scale = entry.scale;
        for (std::size_t c = 0; c < 3; ++c) {
            frame.spectra[c] = stored.data() + c * shape.bytes();
            is_good =
                is_good && fourier::scales_are_finite(frame.spectra[c], shape.rows, shape.columns);
        }
        good[i] = is_good ? 1 : 0;
    });
    const auto bad = std::find(good.begin(), good.end(), std::uint8_t{0});
    if (bad != good.end()) {
        throw InvalidArgument(
            fmt::format("is damaged: the checksum of {} is wrong",
                        frame_name(range_, static_cast<std::size_t>(bad - good.begin()))));
    }
}

bool same_pitch(const wave::KernelGrid& a, const wave::KernelGrid& b) noexcept {
    constexpr double kTolerance = 1e-4;
    return std::abs(a.pitch_deg / b.pitch_deg - 1) < kTolerance;
}

std::optional<Flipbook::Difference> Flipbook::difference(const Eye& eye,
                                                         const SpectralSampling& sampling) const {
    const std::vector<NamedValue> here = identity_of(eye, sampling);
    const auto value_in = [](const std::vector<NamedValue>& values, const std::string& name) {
        const auto found = std::find_if(values.begin(), values.end(), [&](const NamedValue& value) {
            return value.name == name;
        });
        return found == values.end() ? std::string() : found->value;
    };
    for (const auto* values : {&here, &identity_}) {
        for (const NamedValue& value : *values) {
            Difference both{value.name, value_in(here, value.name),
                            value_in(identity_, value.name)};
            if (both.here != both.in_book) return both;
        }
    }
    return std::nullopt;
}

}  // namespace aureole::eye
