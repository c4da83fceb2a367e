#include "glare/far_layer.h"

#include <algorithm>
#include <array>

#include "aureole/base/parallel.h"
#include "glare/sprite_crop.h"

namespace aureole::glare {
namespace {

constexpr int kClusterSide = 64;
constexpr int kMargin = 1;  // nodes beyond the picture's edge, to interpolate from

constexpr int kLargestScale = 8;

// Adds `count` pixels from `x0` on, a multiple of the scale. nodes[j] is node j + x0 / kScale - 1.
template <int kScale>
void add_between(const float* nodes, int count, float* to) {
    static_assert(kScale <= kLargestScale);
    // Whole spans between nodes, which begin half a coarse pixel before the tile.
    std::array<float, SpriteTiles::kWidth + 2 * kLargestScale> line;
    const int spans = (count + kScale - 1) / kScale + 1;
    for (int j = 0; j < spans; ++j) {
        const float step = nodes[j + 1] - nodes[j];
        for (int i = 0; i < kScale; ++i) {
            constexpr float kPixel = 1.0F / kScale;
            line[static_cast<std::size_t>(j * kScale + i)] =
                nodes[j] + (static_cast<float>(i) + 0.5F) * kPixel * step;
        }
    }
    for (int x = 0; x < count; ++x) to[x] += line[static_cast<std::size_t>(x + kScale / 2)];
}

}  // namespace

FarLayer::FarLayer(int width, int height, int channels, const FarKernel& kernel)
    : channels_(channels),
      scale_(kernel.scale),
      error_(kernel.error),
      roughness_(kernel.roughness),
      layer_(width, height, channels, kernel.scale, kMargin, kernel.coarse, 1),
      canvas_((width + kernel.scale - 1) / kernel.scale + 2 * kMargin,
              (height + kernel.scale - 1) / kernel.scale + 2 * kMargin, channels),
      scratch_(static_cast<std::size_t>(max_workers())) {
    for (Buffer& buffer : scratch_) buffer = Buffer(3 * SpriteTiles::kPlane);
}

FarLayer::Plan FarLayer::plan(const ConstImageView& light, const float* weights,
                              const sources::BrightnessHistogram& measured, const Limits& limits,
                              double cluster_error, double most_lost) {
    sources::ClusterOptions options;
    options.cells = false;
    options.max_side = kClusterSide;
    options.error = cluster_error;
    options.dim_limit = limits.dim;
    options.full_limit = limits.full;
    const sources::Clusters found =
        sources::find_clusters(light, weights, roughness_, options, &measured);
    // Coarse pixels stand for scale^2 of the picture.
    const double area = scale_ * scale_;
    const double level = crop_level(found.clusters, layer_.profile(), most_lost / area);
    const SpriteLayer::Made made = layer_.make(found.clusters, level);
    Plan plan;
    plan.sprites = found.clusters.size();
    plan.bright_energy = found.energy;
    plan.energy_left = found.energy_left;
    plan.energy_cut = made.energy_cut * area;
    plan.error_bound = found.error_bound + error_ * found.energy + plan.energy_cut;
    plan.work = made.work;
    return plan;
}

void FarLayer::draw() {
    parallel_for(layer_.tiles().size(), [&](std::size_t i, int worker) {
        const SpriteTile tile = layer_.tiles().cleared_tile(
            i, channels_, scratch_[static_cast<std::size_t>(worker)].data());
        layer_.draw(i, tile);
        for (int c = 0; c < channels_; ++c) {
            const float* plane = tile.planes[static_cast<std::size_t>(c)];
            for (int y = 0; y < tile.height; ++y) {
                std::copy_n(plane + y * tile.stride, tile.width,
                            canvas_.row(tile.y + y, c) + tile.x);
            }
        }
    });
}

void FarLayer::add_to(const SpriteTile& tile) const {
    std::array<float, SpriteTiles::kWidth / 2 + 2 * kLargestScale> nodes;
    const int first = tile.x / scale_ - 1 + kMargin;
    const int count = std::min((tile.width + scale_ - 1) / scale_ + 2, canvas_.width() - first);
    for (int y = 0; y < tile.height; ++y) {
        const Between row = coarse_place(tile.y + y, scale_);
        for (int c = 0; c < channels_; ++c) {
            const float* above = canvas_.row(row.node + kMargin, c) + first;
            const float* below = canvas_.row(row.node + kMargin + 1, c) + first;
            for (int i = 0; i < count; ++i) {
                nodes[static_cast<std::size_t>(i)] = above[i] + row.right * (below[i] - above[i]);
            }
            float* to = tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
            switch (scale_) {
                case 2:
                    add_between<2>(nodes.data(), tile.width, to);
                    break;
                case 4:
                    add_between<4>(nodes.data(), tile.width, to);
                    break;
                default:
                    add_between<8>(nodes.data(), tile.width, to);
                    break;
            }
        }
    }
}

}  // namespace aureole::glare
