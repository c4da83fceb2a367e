// Sprites sorted into the tiles of a picture that they touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "glare/sprite_drawing.h"

namespace aureole::glare {

class SpriteTiles {
  public:
    // Wide enough for long vectors, and three planes of a tile stay in the L2 cache.
    static constexpr int kWidth = 256;
    static constexpr int kHeight = 32;
    static constexpr std::size_t kPlane = std::size_t{kWidth} * kHeight;

    SpriteTiles(int width, int height);

    std::size_t size() const { return static_cast<std::size_t>(columns_) * rows_; }
    // The part of the picture that tile `index` is: planes are not set.
    SpriteTile tile(std::size_t index) const;
    // The same in scratch memory of 3 kPlane floats, which is set to 0.
    SpriteTile cleared_tile(std::size_t index, int channels, float* scratch) const;

    // Keeps the order of the sprites in every tile.
    void sort(const std::vector<Sprite>& sprites);
    const std::uint32_t* order(std::size_t index) const { return order_.data() + first_[index]; }
    std::size_t count(std::size_t index) const { return first_[index + 1] - first_[index]; }

  private:
    template <class Body>
    void for_each_tile_of(const Sprite& sprite, const Body& body) const;

    int width_;
    int height_;
    int columns_;
    std::size_t rows_;
    std::vector<std::size_t> first_;  // in order_, per tile, and the end
    std::vector<std::uint32_t> order_;
    std::vector<std::size_t> next_;  // while sorting
};

}  // namespace aureole::glare
