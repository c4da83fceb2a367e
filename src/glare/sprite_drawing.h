// The inner loops of sprites: spans of a kernel times an energy, added to a tile of the picture.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace aureole::glare {

// One sprite. The kernel's pixel for picture pixel (x, y) is (x - x0, y - y0).
struct Sprite {
    std::array<const float*, 3> kernel = {};  // planes, readable one pixel around (PaddedKernel)
    std::ptrdiff_t stride = 0;
    int x0 = 0;
    int y0 = 0;
    // Energy times the bilinear weights of the pixels at (0, 0), (1, 0), (0, 1), (1, 1) from the
    // source: the kernel is read at (x - x0 - i, y - y0 - j). With one tap only the first counts.
    std::array<std::array<float, 4>, 3> weight = {};
    int taps = 1;  // 1 or 4
    // What is drawn: a disc about (centre_x, centre_y) (continuous pixel coordinates), within
    // columns [left, right) and rows [top, bottom). Over the last `fade` pixels of the radius it
    // falls smoothly to nothing.
    float centre_x = 0;
    float centre_y = 0;
    float radius = 0;
    float fade = 0;
    int left = 0;
    int right = 0;
    int top = 0;
    int bottom = 0;
};

// A part of the picture: planes of `width` x `height` floats at (x, y).
struct SpriteTile {
    std::array<float*, 3> planes = {};
    std::ptrdiff_t stride = 0;
    int channels = 3;
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// Adds sprites[order[0 .. count)], in that order.
void draw_sprites(const Sprite* sprites, const std::uint32_t* order, std::size_t count,
                  const SpriteTile& tile);

}  // namespace aureole::glare
