#include "glare/far_layer.h"

#include <algorithm>

#include "aureole/base/parallel.h"
#include "glare/raster.h"

namespace aureole::glare {
namespace {

constexpr int kClusterSide = 64;

}  // namespace

FarLayer::FarLayer(int width, int height, int channels, const FarKernel& kernel)
    : channels_(channels),
      scale_(kernel.scale),
      error_(kernel.error),
      roughness_(kernel.roughness),
      layer_(width, height, channels, kernel.scale, kRasterMargin, kernel.coarse, 1),
      canvas_(raster_size(width, kernel.scale), raster_size(height, kernel.scale), channels),
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
    const sources::Clusters& found = finder_.find(light, weights, roughness_, options, &measured);
    // Coarse pixels stand for scale^2 of the picture.
    const double area = scale_ * scale_;
    const double level = ends_.level(found.clusters, layer_.profile(), most_lost / area);
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

void FarLayer::add_to(const SpriteTile& tile) const { add_between(canvas_, scale_, tile); }

void FarLayer::add_to(const ImageView& out, const float* weights) const noexcept {
    add_between(canvas_, scale_, weights, out);
}

}  // namespace aureole::glare
