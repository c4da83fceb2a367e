#include "glare/sprite_tiles.h"

#include <algorithm>

namespace aureole::glare {

SpriteTiles::SpriteTiles(int width, int height)
    : width_(width),
      height_(height),
      columns_((width + kWidth - 1) / kWidth),
      rows_(static_cast<std::size_t>((height + kHeight - 1) / kHeight)),
      first_(size() + 1) {}

SpriteTile SpriteTiles::tile(std::size_t index) const {
    SpriteTile tile;
    tile.x = static_cast<int>(index % static_cast<std::size_t>(columns_)) * kWidth;
    tile.y = static_cast<int>(index / static_cast<std::size_t>(columns_)) * kHeight;
    tile.width = std::min(kWidth, width_ - tile.x);
    tile.height = std::min(kHeight, height_ - tile.y);
    return tile;
}

SpriteTile SpriteTiles::cleared_tile(std::size_t index, int channels, float* scratch) const {
    SpriteTile cleared = tile(index);
    cleared.channels = channels;
    cleared.stride = kWidth;
    for (std::size_t c = 0; c < 3; ++c) cleared.planes[c] = scratch + c * kPlane;
    std::fill_n(scratch, static_cast<std::size_t>(channels) * kPlane, 0.0F);
    return cleared;
}

template <class Body>
void SpriteTiles::for_each_tile_of(const Sprite& sprite, const Body& body) const {
    if (sprite.left >= sprite.right || sprite.top >= sprite.bottom) return;
    for (int row = sprite.top / kHeight; row <= (sprite.bottom - 1) / kHeight; ++row) {
        for (int column = sprite.left / kWidth; column <= (sprite.right - 1) / kWidth; ++column) {
            body(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column));
        }
    }
}

void SpriteTiles::sort(const std::vector<Sprite>& sprites) {
    std::fill(first_.begin(), first_.end(), std::size_t{0});
    for (const Sprite& sprite : sprites) {
        for_each_tile_of(sprite, [&](std::size_t tile) { ++first_[tile + 1]; });
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    order_.resize(first_.back());
    next_.assign(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < sprites.size(); ++i) {
        for_each_tile_of(sprites[i], [&](std::size_t tile) {
            order_[next_[tile]++] = static_cast<std::uint32_t>(i);
        });
    }
}

}  // namespace aureole::glare
