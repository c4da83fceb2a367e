#include "glare/sprite_painter.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/sources/brightness.h"
#include "glare/sprite_crop.h"

namespace aureole::glare {
namespace {

using Criterion = sources::ClusterOptions::Criterion;

constexpr int kCoreRadius = 12;
constexpr int kLargestCellKernel = 1025;
constexpr ErrorShares kShares;

int core_radius_for(const ConstImageView& kernel, const SpriteOptions& options) {
    // The paper's clusters are even cells and use the kernel as it is.
    if (options.clusters.criterion == Criterion::kSimilarColor) return 0;
    // A core that is most of the kernel saves nothing.
    return std::min({kCoreRadius, kernel.width / 8, kernel.height / 8});
}

ConstImageView part(const ConstImageView& view, int x, int width) {
    ConstImageView columns = view;
    columns.data += view.offset(x, 0, 0);
    columns.width = width;
    return columns;
}

}  // namespace

SpritePainter::SpritePainter(int width, int height, int channels, const ConstImageView& kernel,
                             const SpriteOptions& options, const FarKernel* split)
    : width_(width),
      height_(height),
      channels_(channels),
      kernel_channels_(kernel.channels),
      options_(options),
      scratch_(static_cast<std::size_t>(max_workers())) {
    if (split != nullptr) far_.emplace(width, height, channels, *split);
    const ConstImageView near = split == nullptr ? kernel : split->near.view();
    core_radius_ = core_radius_for(near, options);
    const SplitKernel parts = split_kernel(near, core_radius_);
    if (core_radius_ > 0) core_ = PaddedKernel(parts.core);
    roughness_ = sources::roughness_of(parts.smooth);
    options_.clusters.cells = std::max(near.width, near.height) <= kLargestCellKernel;
    near_.emplace(width, height, channels, 1, 0, parts.smooth,
                  options_.clusters.cells ? options_.clusters.max_side : 1);
    const double lost = kShares.crop * options.error / (far_ ? 2 : 1);
    const double radius = near_->profile().radius_losing(lost);
    typical_area_ = std::min(kPi * radius * radius, static_cast<double>(near.width) * near.height);
    for (Buffer& buffer : scratch_) buffer = Buffer(3 * SpriteTiles::kPlane);
}

double SpritePainter::dim_share() const { return kShares.dim_light * options_.error; }

// All that is left below the limit of the histogram is within the share of the error: so is then a
// part of it, which falls to nothing from half of that limit up to it.
float SpritePainter::dim_limit(const sources::BrightnessHistogram& histogram) const {
    if (options_.clusters.dim_limit > 0) return options_.clusters.dim_limit;
    const float limit = histogram.dim_limit(dim_share());
    return options_.clusters.criterion == Criterion::kBoundedError ? limit / 2 : limit;
}

bool SpritePainter::light_near(const SpriteTile& tile, const sources::BrightnessHistogram& measured,
                               float limit) const {
    const int reach = core_radius_;
    return measured.may_be_above(limit, tile.x - reach, tile.y - reach, tile.x + tile.width + reach,
                                 tile.y + tile.height + reach);
}

double SpritePainter::lit_pixels(const sources::BrightnessHistogram& measured, float limit) const {
    double pixels = 0;
    for (std::size_t i = 0; i < near_->tiles().size(); ++i) {
        const SpriteTile tile = near_->tiles().tile(i);
        if (light_near(tile, measured, limit)) {
            pixels += static_cast<double>(tile.width) * tile.height;
        }
    }
    return pixels;
}

SpritePainter::Plan SpritePainter::plan(const ConstImageView& light, const float* weights,
                                        const sources::BrightnessHistogram& measured) {
    dim_limit_ = dim_limit(measured);
    full_limit_ = options_.clusters.dim_limit > 0 ? dim_limit_ : measured.dim_limit(dim_share());
    // Of the shares of clusters and of ends each layer has half if there are two; the far one pays
    // for its raster with its own.
    const double layers = far_ ? 2 : 1;
    const double clusters_share = kShares.clusters * options_.error / layers;
    sources::ClusterOptions cluster_options = options_.clusters;
    cluster_options.error = clusters_share;
    cluster_options.dim_limit = dim_limit_;
    cluster_options.full_limit = full_limit_;
    const sources::Clusters found =
        sources::find_clusters(light, weights, roughness_, cluster_options, &measured);
    Plan plan;
    SpriteReport& report = plan.report;
    report.bright_pixels = found.bright_pixels;
    report.sprites = found.clusters.size();
    report.energy = found.energy + found.energy_left;
    report.energy_left = found.energy_left;
    const double most_lost = kShares.crop * options_.error * report.energy / layers;
    const SpriteLayer::Made made =
        near_->make(found.clusters, crop_level(found.clusters, near_->profile(), most_lost));
    report.energy_cut = made.energy_cut;
    report.error_bound = found.error_bound + made.energy_cut + 2 * report.energy_left;
    plan.near = made.work;
    if (far_) {
        const FarLayer::Plan distant =
            far_->plan(light, weights, measured, {dim_limit_, full_limit_},
                       clusters_share - far_->error(), most_lost);
        report.far_sprites = distant.sprites;
        report.energy_cut += distant.energy_cut;
        report.error_bound += distant.error_bound;
        plan.far = distant.work;
    }
    report.pixels_drawn = plan.near.pixels() + plan.far.pixels();
    plan.lit_pixels = lit_pixels(measured, dim_limit_);
    const double side = 2 * core_radius_ + 1;
    plan.core_pixels = static_cast<double>(report.bright_pixels) * side * side;
    return plan;
}

void SpritePainter::draw(const ConstImageView& light, const ImageView& out, const float* weights,
                         const sources::BrightnessHistogram& measured) {
    if (far_) far_->draw();
    parallel_for(near_->tiles().size(), [&](std::size_t i, int worker) {
        draw_tile(light, out, weights, measured, i,
                  scratch_[static_cast<std::size_t>(worker)].data());
    });
}

void SpritePainter::draw_tile(const ConstImageView& light, const ImageView& out,
                              const float* weights, const sources::BrightnessHistogram& measured,
                              std::size_t index, float* planes) const {
    SpriteTile tile = near_->tiles().tile(index);
    const bool bright = light_near(tile, measured, dim_limit_);
    // planes[0] stays null where nothing is drawn.
    if (bright || far_ || near_->tiles().count(index) > 0) {
        tile = near_->tiles().cleared_tile(index, channels_, planes);
        if (bright && core_radius_ > 0) draw_cores(light, weights, tile);
        near_->draw(index, tile);
        if (far_) far_->add_to(tile);
    }
    for (int y = 0; y < tile.height; ++y) finish_row(light, out, weights, tile, y, bright);
}

// From energy back to the picture's values; light that is too dim to be drawn stays where it is.
void SpritePainter::finish_row(const ConstImageView& light, const ImageView& out,
                               const float* weights, const SpriteTile& tile, int y,
                               bool bright) const {
    std::array<float, SpriteTiles::kWidth> kept;  // what stays, of each pixel
    if (bright) {
        sources::largest_channel_row(part(light, tile.x, tile.width), tile.y + y, kept.data());
        for (int x = 0; x < tile.width; ++x) {
            float& value = kept[static_cast<std::size_t>(x)];
            value = 1 - sources::bright_share(value, dim_limit_, full_limit_);
        }
    }
    for (int c = 0; c < (weights == nullptr ? 0 : channels_); ++c) {
        if (tile.planes[0] == nullptr) break;
        float* row = tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
        const float* weight = weights + pixel(tile.x, tile.y + y);
        for (int x = 0; x < tile.width; ++x) row[x] /= weight[x];
    }
    for (int c = 0; c < channels_; ++c) {
        const float* from = light.data + light.offset(tile.x, tile.y + y, c);
        float* to = &out.at(tile.x, tile.y + y, c);
        const float* row = tile.planes[0] == nullptr
                               ? nullptr
                               : tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
        const auto finish = [&](auto in_stride, auto out_stride) {
            if (row == nullptr) {
                for (int x = 0; x < tile.width; ++x) to[x * out_stride] = from[x * in_stride];
            } else if (!bright) {
                for (int x = 0; x < tile.width; ++x) {
                    to[x * out_stride] = row[x] + from[x * in_stride];
                }
            } else {
                for (int x = 0; x < tile.width; ++x) {
                    to[x * out_stride] =
                        row[x] + kept[static_cast<std::size_t>(x)] * from[x * in_stride];
                }
            }
        };
        // Strides of 1 that the compiler knows of become vectors.
        if (light.pixel_stride == 1 && out.pixel_stride == 1) {
            constexpr std::integral_constant<int, 1> kOne;
            finish(kOne, kOne);
        } else {
            finish(light.pixel_stride, out.pixel_stride);
        }
    }
}

// The cores of all bright pixels that reach into the tile.
void SpritePainter::draw_cores(const ConstImageView& light, const float* weights,
                               const SpriteTile& tile) const {
    constexpr std::uint32_t kFirst = 0;
    const int end_y = std::min(height_, tile.y + tile.height + core_radius_);
    const int end_x = std::min(width_, tile.x + tile.width + core_radius_);
    const int first_x = std::max(0, tile.x - core_radius_);
    std::array<float, SpriteTiles::kWidth + 2 * kCoreRadius> largest;
    for (int y = std::max(0, tile.y - core_radius_); y < end_y; ++y) {
        sources::largest_channel_row(part(light, first_x, end_x - first_x), y, largest.data());
        if (!sources::any_above(largest.data(), end_x - first_x, dim_limit_)) continue;
        for (int x = first_x; x < end_x; ++x) {
            const float share = sources::bright_share(
                largest[static_cast<std::size_t>(x - first_x)], dim_limit_, full_limit_);
            if (share == 0) continue;
            const float weight = weights == nullptr ? 1.0F : weights[pixel(x, y)];
            const Sprite sprite = core_sprite(light, x, y, share * weight);
            draw_sprites(&sprite, &kFirst, 1, tile);
        }
    }
}

Sprite SpritePainter::core_sprite(const ConstImageView& light, int x, int y, float weight) const {
    Sprite sprite;
    sprite.stride = core_.stride();
    sprite.x0 = x - core_radius_;
    sprite.y0 = y - core_radius_;
    for (int c = 0; c < channels_; ++c) {
        const auto i = static_cast<std::size_t>(c);
        sprite.kernel[i] = core_.plane(std::min(c, kernel_channels_ - 1));
        sprite.weight[i][0] = weight * light.at(x, y, c);
    }
    sprite.centre_x = static_cast<float>(x) + 0.5F;
    sprite.centre_y = static_cast<float>(y) + 0.5F;
    sprite.radius = static_cast<float>(core_radius_);
    sprite.left = std::max(0, x - core_radius_);
    sprite.right = std::min(width_, x + core_radius_ + 1);
    sprite.top = std::max(0, y - core_radius_);
    sprite.bottom = std::min(height_, y + core_radius_ + 1);
    return sprite;
}

}  // namespace aureole::glare
