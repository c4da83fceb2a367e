#include "glare/sprite_layer.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "aureole/base/units.h"
#include "glare/sprite_crop.h"

namespace aureole::glare {
namespace {

void add_work(const Sprite& sprite, SpriteWork& work) {
    const double width = std::max(0, sprite.right - sprite.left);
    const double height = std::max(0, sprite.bottom - sprite.top);
    const double radius = static_cast<double>(sprite.radius);
    const double area = std::min(width * height, kPi * radius * radius);
    (sprite.taps == 1 ? work.one_tap_pixels : work.four_tap_pixels) += area;
    work.rows += height * (1 + width / SpriteTiles::kWidth);
}

}  // namespace

SpriteLayer::SpriteLayer(int width, int height, int channels, int scale, int margin,
                         const ConstImageView& kernel, int max_cell_side)
    : width_((width + scale - 1) / scale + 2 * margin),
      height_((height + scale - 1) / scale + 2 * margin),
      channels_(channels),
      scale_(scale),
      margin_(margin),
      kernel_channels_(kernel.channels),
      centre_x_(kernel.width / 2),
      centre_y_(kernel.height / 2),
      profile_(kernel),
      tiles_(width_, height_) {
    kernels_.emplace(1, PaddedKernel(kernel));
    for (int side = 2; side <= max_cell_side; side *= 2) {
        kernels_.emplace(side, PaddedKernel(cell_kernel(kernel, side)));
    }
}

SpriteLayer::Made SpriteLayer::make(const std::vector<sources::Cluster>& clusters, double level) {
    Made made;
    sprites_.clear();
    for (const sources::Cluster& cluster : clusters) {
        const int radius = crop_radius(cluster, profile_, level);
        made.energy_cut += energy_lost(cluster, profile_, radius);
        sprites_.push_back(sprite_of(cluster, radius));
        add_work(sprites_.back(), made.work);
    }
    tiles_.sort(sprites_);
    return made;
}

Sprite SpriteLayer::sprite_of(const sources::Cluster& cluster, int radius) const {
    Sprite sprite;
    const bool is_cell = cluster.shape == sources::Cluster::Shape::kCell;
    // Pixels of the layer, middles at whole numbers.
    const double x = cluster.centroid_x / scale_ - 0.5 + margin_;
    const double y = cluster.centroid_y / scale_ - 0.5 + margin_;
    const int base_x = is_cell ? cluster.x + margin_ : static_cast<int>(std::floor(x));
    const int base_y = is_cell ? cluster.y + margin_ : static_cast<int>(std::floor(y));
    const double fx = is_cell ? 0 : x - base_x;
    const double fy = is_cell ? 0 : y - base_y;
    sprite.taps = fx == 0 && fy == 0 ? 1 : 4;
    const PaddedKernel& kernel = kernels_.at(is_cell ? cluster.side : 1);
    sprite.stride = kernel.stride();
    sprite.x0 = base_x - centre_x_;
    sprite.y0 = base_y - centre_y_;
    for (int c = 0; c < channels_; ++c) {
        const auto i = static_cast<std::size_t>(c);
        sprite.kernel[i] = kernel.plane(std::min(c, kernel_channels_ - 1));
        const double e = static_cast<double>(cluster.energy[i]);
        sprite.weight[i] = {static_cast<float>(e * (1 - fx) * (1 - fy)),
                            static_cast<float>(e * fx * (1 - fy)),
                            static_cast<float>(e * (1 - fx) * fy), static_cast<float>(e * fx * fy)};
    }
    sprite.centre_x = static_cast<float>(x + 0.5);
    sprite.centre_y = static_cast<float>(y + 0.5);
    // The half diagonal of a cell, and the half pixel between whole distances.
    sprite.radius = static_cast<float>(radius + 1 + (is_cell ? 0.75 * cluster.side : 0));
    // Kernels that are there as a whole have their own end.
    if (radius < profile_.end()) {
        sprite.fade = static_cast<float>((1 - kFadeFrom) * std::max(radius, 1));
    }
    const int extra = sprite.taps == 4 ? 1 : 0;
    const auto reach = static_cast<int>(sprite.radius) + 1;
    const auto within = [&](double centre, int start, int extent, int size) {
        const auto middle = static_cast<int>(std::floor(centre));
        return std::pair{std::max({0, start, middle - reach}),
                         std::min({size, start + extent + extra, middle + reach + 1})};
    };
    std::tie(sprite.left, sprite.right) = within(x + 0.5, sprite.x0, kernel.width(), width_);
    std::tie(sprite.top, sprite.bottom) = within(y + 0.5, sprite.y0, kernel.height(), height_);
    return sprite;
}

void SpriteLayer::draw(std::size_t index, const SpriteTile& tile) const {
    draw_sprites(sprites_.data(), tiles_.order(index), tiles_.count(index), tile);
}

}  // namespace aureole::glare
