// Texels as files hold them: internal to the module.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "aureole/image/image.h"
#include "aureole/io/texture.h"

namespace aureole::io {

enum class Sample { kHalf, kFloat, kR11G11B10, kRgb9e5, kByte, kSrgbByte };

struct TexelLayout {
    Sample sample = Sample::kHalf;
    int channels = 4;
    int stored = 4;           // channels in the file; those beyond `channels` have no meaning
    bool blue_first = false;  // B, G, R in memory
    bool operator==(const TexelLayout&) const = default;
};

// What DDS (DXGI_FORMAT) and KTX 2 (VkFormat) call a layout; 0: it has no name there.
struct NamedLayout {
    TexelLayout layout;
    std::uint32_t dxgi = 0;
    std::uint32_t vulkan = 0;
};

inline constexpr std::array<NamedLayout, 14> kNamedLayouts = {{
    {{Sample::kHalf, 4, 4}, 10, 97},
    {{Sample::kHalf, 3, 3}, 0, 90},
    {{Sample::kHalf, 2, 2}, 34, 83},
    {{Sample::kFloat, 4, 4}, 2, 109},
    {{Sample::kFloat, 3, 3}, 6, 106},
    {{Sample::kFloat, 2, 2}, 16, 103},
    {{Sample::kR11G11B10, 3, 3}, 26, 122},
    {{Sample::kRgb9e5, 3, 3}, 67, 123},
    {{Sample::kByte, 4, 4}, 28, 37},
    {{Sample::kSrgbByte, 4, 4}, 29, 43},
    {{Sample::kByte, 4, 4, true}, 87, 44},
    {{Sample::kSrgbByte, 4, 4, true}, 91, 50},
    {{Sample::kByte, 3, 4, true}, 88, 0},
    {{Sample::kSrgbByte, 3, 4, true}, 93, 0},
}};

std::size_t texel_bytes(const TexelLayout& layout);

// The layout that write_texture() uses; throws InvalidArgument for a number of channels that the
// format does not take.
const NamedLayout& written_layout(TexelFormat format, int channels);

// Row `y` of `image`, as `layout` has it, into width * texel_bytes() bytes. Adds to `report`. Where
// the layout has more channels than the image they become 1.
void encode_row(const TexelLayout& layout, const Image& image, int y, std::byte* bytes,
                TextureReport& report);
// The inverse; `image` has layout.channels.
void decode_row(const TexelLayout& layout, const std::byte* bytes, Image& image, int y);

}  // namespace aureole::io
