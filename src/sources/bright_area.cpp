#include "aureole/sources/bright_area.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"

namespace aureole::sources {
namespace {

constexpr int kSide = BrightnessHistogram::kBlockSide;

// Adds the block of at most kSide x kSide pixels at (x0, y0).
void add_block(const ConstImageView& light, int x0, int y0, float limit, BrightArea& area) {
    ConstImageView part = light;
    part.data += light.offset(x0, 0, 0);
    part.width = std::min(kSide, light.width - x0);
    const int height = std::min(kSide, light.height - y0);
    // Bit x + 1 of rows[y + 1] is pixel (x, y); what is beyond the block is no edge of it.
    std::array<std::uint32_t, kSide + 2> rows;
    rows.fill(~std::uint32_t{0});
    const std::uint32_t inside = (std::uint32_t{1} << static_cast<unsigned>(part.width + 1)) - 2;
    std::array<float, kSide> largest;
    for (int y = 0; y < height; ++y) {
        largest_channel_row(part, y0 + y, largest.data());
        std::uint32_t bright = ~inside;
        for (int x = 0; x < part.width; ++x) {
            const std::uint32_t bit = largest[static_cast<std::size_t>(x)] > limit ? 1 : 0;
            bright |= bit << static_cast<unsigned>(x + 1);
        }
        rows[static_cast<std::size_t>(y + 1)] = bright;
    }
    area.blocks += 1;
    for (std::size_t y = 1; y <= static_cast<std::size_t>(height); ++y) {
        const std::uint32_t row = rows[y];
        const std::uint32_t neighbours = (row << 1U) & (row >> 1U) & rows[y - 1] & rows[y + 1];
        area.pixels += std::popcount(row & inside);
        area.edge_pixels += std::popcount(row & inside & ~neighbours);
    }
}

}  // namespace

BrightArea bright_area(const ConstImageView& light, const BrightnessHistogram& histogram,
                       float limit, int block_step) {
    constexpr int kShiftPerStrip = 3;  // of the blocks that are chosen: no columns of them
    std::vector<BrightArea> strips(static_cast<std::size_t>((light.height + kSide - 1) / kSide));
    parallel_for(strips.size(), [&](std::size_t strip, int) {
        const int y = static_cast<int>(strip) * kSide;
        const int first = kShiftPerStrip * static_cast<int>(strip) % block_step * kSide;
        for (int x = first; x < light.width; x += block_step * kSide) {
            if (!histogram.may_be_above(limit, x, y, x + kSide, y + kSide)) continue;
            add_block(light, x, y, limit, strips[strip]);
        }
    });
    BrightArea area;
    for (const BrightArea& strip : strips) {
        area.blocks += block_step * strip.blocks;
        area.pixels += block_step * strip.pixels;
        area.edge_pixels += block_step * strip.edge_pixels;
    }
    return area;
}

}  // namespace aureole::sources
