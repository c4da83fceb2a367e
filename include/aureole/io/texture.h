// Textures for GPUs in files: cube maps and tables with all their levels, as DDS and KTX.
//
//   io::Texture texture;
//   texture.faces = 6;
//   for (const ibl::CubeMap& map : chain) texture.levels.push_back(map.stacked());
//   io::write_texture("environment.ktx2", texture);
//
// Layouts, conventions, and what other programs make of them: docs/texture_files.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::io {

struct Texture {
    // 1: a picture. 6: a cube map, its faces in the order +X -X +Y -Y +Z -Z and oriented as in
    // ibl/cube_map.h, which is what Vulkan, Direct3D and OpenGL expect.
    int faces = 1;
    // The largest first; level k of a texture of w x h texels has max(1, w >> k) x max(1, h >> k).
    // There may be fewer levels than lead to a single texel. The faces of a level lie below one
    // another, row 0 of each on top. Linear light; 3 channels (R, G, B), 4 (R, G, B, A) or, for
    // tables of two values, 2; the same in all levels.
    std::vector<Image> levels;

    // Of one face of level 0; 0 without levels.
    int width() const noexcept { return levels.empty() ? 0 : levels.front().width(); }
    int height() const noexcept { return levels.empty() ? 0 : levels.front().height() / faces; }
};

// How texels are stored. Largest values, relative steps:
enum class TexelFormat {
    kHalf,       // 16-bit floats: 65504, 2^-10; R, G, B, A or 2 channels
    kFloat,      // 32-bit floats: nothing is lost; R, G, B, A or 2 channels
    kR11G11B10,  // unsigned floats in 4 bytes: 65024, 65024, 64512; 2^-6, 2^-6, 2^-5; R, G, B
    kRgb9e5,     // one exponent for three in 4 bytes: 65408; 2^-8 of the largest of the three
};

struct TextureOptions {
    TexelFormat format = TexelFormat::kHalf;
};

// Samples that the format could not hold. They were replaced by the nearest that it can, NaN by 0.
struct TextureReport {
    std::size_t too_large = 0;    // beyond the largest value, in either direction; infinities too
    std::size_t negative = 0;     // below 0, in formats without a sign
    std::size_t not_numbers = 0;  // NaN
    // The largest sample met, be it held or not; 0 if none is positive.
    float largest = 0;

    std::size_t clamped() const noexcept { return too_large + negative + not_numbers; }
};

// Writes by extension: .dds (with the DX10 header) or .ktx2 (KTX 2.0 without supercompression).
// Values are rounded to the nearest, ties to even. Three channels become four with alpha 1 in
// kHalf and kFloat, since hardly any GPU has textures of three.
// The file appears whole or not at all (io/picture.h).
// Throws InvalidArgument for another extension, levels or faces that do not fit as told above, a
// face larger than 32768 texels, or a format that does not take the number of channels; FileError
// if the file cannot be written.
TextureReport write_texture(const std::string& path, const Texture& texture,
                            const TextureOptions& options = {});

// Throws InvalidArgument unless write_texture() knows the extension.
void check_texture_extension(const std::string& path);

// Whether the file begins as a DDS, KTX or KTX 2 file does. False too if it cannot be read.
bool is_texture_file(const std::string& path);

// Reads DDS (with or without DX10 header), KTX 1 of either byte order, and KTX 2 without
// supercompression, told apart by their first bytes. Texels: floats of 16 or 32 bits with 2, 3 or 4
// channels, R11G11B10, RGB9E5, and 8 bits in the order RGBA or BGRA, which are decoded from sRGB
// where the format says so or cannot say (DDS without DX10 header). An alpha channel that is 1
// everywhere is left out. NaN and infinities are kept. Pictures whose metadata say that their first
// row is the lowest are turned.
// Sizes are held against the length of the file before memory is allocated.
// Throws FileError for a file that is missing, unreadable, damaged, truncated, or of another kind:
// compressed texels, arrays, volumes, cube maps without all six faces.
Texture read_texture(const std::string& path);

}  // namespace aureole::io
