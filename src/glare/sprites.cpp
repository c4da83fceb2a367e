#include "aureole/glare/sprites.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"
#include "glare/sprite_crop.h"
#include "glare/sprite_drawing.h"
#include "glare/sprite_kernel.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {
namespace {

constexpr double kShareOfClusters = 0.5;
constexpr double kShareOfCrop = 0.25;
// Light that stays where it is counts twice: where it should have gone, and where it still is.
constexpr double kShareOfDimLight = 0.125;

constexpr int kCoreRadius = 8;
constexpr int kLargestCellKernel = 1025;

void check(int width, int height, int channels, const ConstImageView& kernel,
           const SpriteOptions& options) {
    if (width < 1 || height < 1) {
        throw InvalidArgument("picture", fmt::format("{}x{}", width, height), "must have pixels");
    }
    if (channels != 1 && channels != 3) {
        throw InvalidArgument("channels", fmt::format("{}", channels), "must be 3, or 1 for grey");
    }
    if (kernel.data == nullptr || kernel.width < 1 || kernel.height < 1 ||
        (kernel.channels != 1 && kernel.channels != channels)) {
        throw InvalidArgument("kernel",
                              fmt::format("{}x{}x{}", kernel.width, kernel.height, kernel.channels),
                              fmt::format("must have pixels, and 1 or {} channels", channels));
    }
    if (!(options.error > 0 && options.error < 1)) {
        throw InvalidArgument("error of sprites", fmt::format("{}", options.error),
                              "must be in (0, 1)");
    }
    if (options.clusters.criterion == sources::ClusterOptions::Criterion::kSimilarColor &&
        std::max(kernel.width, kernel.height) > kLargestCellKernel) {
        throw InvalidArgument(
            "kernel", fmt::format("{}x{}", kernel.width, kernel.height),
            fmt::format("clusters of similar colour take kernels of up to {0} x {0} pixels",
                        kLargestCellKernel));
    }
}

int core_radius_for(const ConstImageView& kernel, const SpriteOptions& options) {
    // The paper's clusters are even cells and use the kernel as it is.
    if (options.clusters.criterion == sources::ClusterOptions::Criterion::kSimilarColor) return 0;
    // A core that is most of the kernel saves nothing.
    return std::min({kCoreRadius, kernel.width / 8, kernel.height / 8});
}

}  // namespace

struct Sprites::Impl {
    Impl(int w, int h, int c, const ConstImageView& kernel, const SpriteOptions& o)
        : width(w),
          height(h),
          channels(c),
          kernel_channels(kernel.channels),
          centre_x(kernel.width / 2),
          centre_y(kernel.height / 2),
          options(o),
          core_radius(core_radius_for(kernel, o)),
          tiles(w, h),
          scratch(static_cast<std::size_t>(max_workers())) {
        const SplitKernel split = split_kernel(kernel, core_radius);
        profile.emplace(split.smooth);
        roughness = sources::roughness_of(split.smooth);
        if (core_radius > 0) core = PaddedKernel(split.core);
        smooth.emplace(1, PaddedKernel(split.smooth));
        options.clusters.cells = std::max(kernel.width, kernel.height) <= kLargestCellKernel;
        if (options.clusters.cells) {
            for (int side = 2; side <= options.clusters.max_side; side *= 2) {
                smooth.emplace(side, PaddedKernel(cell_kernel(split.smooth, side)));
            }
        }
        for (Buffer& buffer : scratch) {
            buffer =
                Buffer(static_cast<std::size_t>(SpriteTiles::kWidth * SpriteTiles::kHeight) * 3);
        }
    }

    SpriteReport apply(const ConstImageView& light, const ImageView& out, const float* weights) {
        sources::ClusterOptions cluster_options = options.clusters;
        cluster_options.error = kShareOfClusters * options.error;
        if (!(cluster_options.dim_limit > 0)) {
            cluster_options.dim_limit =
                sources::dim_limit_for(light, weights, kShareOfDimLight * options.error);
        }
        const sources::Clusters found =
            sources::find_clusters(light, weights, roughness, cluster_options);
        SpriteReport report;
        report.bright_pixels = found.bright_pixels;
        report.sprites = found.clusters.size();
        report.energy = found.energy + found.energy_left;
        report.energy_left = found.energy_left;
        make_sprites(found.clusters, report);
        report.error_bound = found.error_bound + report.energy_cut + 2 * report.energy_left;
        tiles.sort(sprites);
        parallel_for(tiles.size(), [&](std::size_t i, int worker) {
            draw_tile(light, out, weights, cluster_options.dim_limit, i,
                      scratch[static_cast<std::size_t>(worker)].data());
        });
        return report;
    }

    void make_sprites(const std::vector<sources::Cluster>& clusters, SpriteReport& report) {
        const double most_lost = kShareOfCrop * options.error * report.energy;
        const double level = crop_level(clusters, *profile, most_lost);
        sprites.clear();
        for (const sources::Cluster& cluster : clusters) {
            const int radius = crop_radius(cluster, *profile, level);
            report.energy_cut += energy_beyond(cluster, *profile, radius);
            sprites.push_back(sprite_of(cluster, radius));
            const Sprite& s = sprites.back();
            report.pixels_drawn += std::max(0.0, static_cast<double>(s.right - s.left)) *
                                   std::max(0, s.bottom - s.top);
        }
    }

    Sprite sprite_of(const sources::Cluster& cluster, int radius) const {
        Sprite sprite;
        const bool is_cell = cluster.shape == sources::Cluster::Shape::kCell;
        const double x = cluster.centroid_x - 0.5;  // in pixels, middles at whole numbers
        const double y = cluster.centroid_y - 0.5;
        const int base_x = is_cell ? cluster.x : static_cast<int>(std::floor(x));
        const int base_y = is_cell ? cluster.y : static_cast<int>(std::floor(y));
        const double fx = is_cell ? 0 : x - base_x;
        const double fy = is_cell ? 0 : y - base_y;
        sprite.taps = fx == 0 && fy == 0 ? 1 : 4;
        const PaddedKernel& kernel = smooth.at(is_cell ? cluster.side : 1);
        sprite.stride = kernel.stride();
        sprite.x0 = base_x - centre_x;
        sprite.y0 = base_y - centre_y;
        for (int c = 0; c < channels; ++c) {
            const auto i = static_cast<std::size_t>(c);
            sprite.kernel[i] = kernel.plane(std::min(c, kernel_channels - 1));
            const double e = static_cast<double>(cluster.energy[i]);
            sprite.weight[i] = {
                static_cast<float>(e * (1 - fx) * (1 - fy)), static_cast<float>(e * fx * (1 - fy)),
                static_cast<float>(e * (1 - fx) * fy), static_cast<float>(e * fx * fy)};
        }
        sprite.centre_x = static_cast<float>(cluster.centroid_x);
        sprite.centre_y = static_cast<float>(cluster.centroid_y);
        // A cell's own half diagonal, and the half pixel between whole distances.
        sprite.radius = static_cast<float>(radius + 1 + (is_cell ? 0.75 * cluster.side : 0));
        const int extra = sprite.taps == 4 ? 1 : 0;
        const auto reach = static_cast<int>(sprite.radius) + 1;
        const auto within = [&](int centre, int start, int extent, int size) {
            return std::pair{std::max({0, start, centre - reach}),
                             std::min({size, start + extent + extra, centre + reach + 1})};
        };
        std::tie(sprite.left, sprite.right) =
            within(static_cast<int>(cluster.centroid_x), sprite.x0, kernel.width(), width);
        std::tie(sprite.top, sprite.bottom) =
            within(static_cast<int>(cluster.centroid_y), sprite.y0, kernel.height(), height);
        return sprite;
    }

    void draw_tile(const ConstImageView& light, const ImageView& out, const float* weights,
                   float dim_limit, std::size_t index, float* planes) const {
        SpriteTile tile = tiles.tile(index);
        tile.channels = channels;
        tile.stride = SpriteTiles::kWidth;
        constexpr std::size_t kPlane = SpriteTiles::kWidth * SpriteTiles::kHeight;
        for (std::size_t c = 0; c < 3; ++c) tile.planes[c] = planes + c * kPlane;
        std::fill_n(planes, 3 * kPlane, 0.0F);
        if (core_radius > 0) draw_cores(light, weights, dim_limit, tile);
        draw_sprites(sprites.data(), tiles.order(index), tiles.count(index), tile);
        for (int y = 0; y < tile.height; ++y) {
            for (int c = 0; c < channels; ++c) finish_row(out, weights, tile, y, c);
        }
        keep_dim_light(light, out, dim_limit, tile);
    }

    // From energy back to the picture's values.
    void finish_row(const ImageView& out, const float* weights, const SpriteTile& tile, int y,
                    int c) const {
        const float* row = tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
        float* to = &out.at(tile.x, tile.y + y, c);
        if (weights == nullptr) {
            for (int x = 0; x < tile.width; ++x) to[x * out.pixel_stride] = row[x];
            return;
        }
        const float* weight = weights + pixel(tile.x, tile.y + y);
        for (int x = 0; x < tile.width; ++x) to[x * out.pixel_stride] = row[x] / weight[x];
    }

    // Light that is too dim to be drawn stays where it is.
    void keep_dim_light(const ConstImageView& light, const ImageView& out, float dim_limit,
                        const SpriteTile& tile) const {
        std::array<float, SpriteTiles::kWidth> largest;
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            sources::largest_channel_row(part(light, tile.x, tile.width), y, largest.data());
            for (int c = 0; c < channels; ++c) {
                const float* from = light.data + light.offset(tile.x, y, c);
                float* to = &out.at(tile.x, y, c);
                for (int x = 0; x < tile.width; ++x) {
                    const float dim = largest[static_cast<std::size_t>(x)] > dim_limit
                                          ? 0.0F
                                          : from[x * light.pixel_stride];
                    to[x * out.pixel_stride] += dim;
                }
            }
        }
    }

    static ConstImageView part(const ConstImageView& view, int x, int width) {
        ConstImageView columns = view;
        columns.data += view.offset(x, 0, 0);
        columns.width = width;
        return columns;
    }

    // The cores of all bright pixels that reach into the tile.
    void draw_cores(const ConstImageView& light, const float* weights, float dim_limit,
                    const SpriteTile& tile) const {
        constexpr std::uint32_t kFirst = 0;
        const int end_y = std::min(height, tile.y + tile.height + core_radius);
        const int end_x = std::min(width, tile.x + tile.width + core_radius);
        const int first_x = std::max(0, tile.x - core_radius);
        std::array<float, SpriteTiles::kWidth + 2 * kCoreRadius> largest;
        for (int y = std::max(0, tile.y - core_radius); y < end_y; ++y) {
            sources::largest_channel_row(part(light, first_x, end_x - first_x), y, largest.data());
            if (!sources::any_above(largest.data(), end_x - first_x, dim_limit)) continue;
            for (int x = first_x; x < end_x; ++x) {
                if (!(largest[static_cast<std::size_t>(x - first_x)] > dim_limit)) continue;
                const float weight = weights == nullptr ? 1.0F : weights[pixel(x, y)];
                const Sprite sprite = core_sprite(light, x, y, weight);
                draw_sprites(&sprite, &kFirst, 1, tile);
            }
        }
    }

    Sprite core_sprite(const ConstImageView& light, int x, int y, float weight) const {
        Sprite sprite;
        sprite.stride = core.stride();
        sprite.x0 = x - core_radius;
        sprite.y0 = y - core_radius;
        for (int c = 0; c < channels; ++c) {
            const auto i = static_cast<std::size_t>(c);
            sprite.kernel[i] = core.plane(std::min(c, kernel_channels - 1));
            sprite.weight[i][0] = weight * light.at(x, y, c);
        }
        sprite.centre_x = static_cast<float>(x) + 0.5F;
        sprite.centre_y = static_cast<float>(y) + 0.5F;
        sprite.radius = static_cast<float>(core_radius);
        sprite.left = std::max(0, x - core_radius);
        sprite.right = std::min(width, x + core_radius + 1);
        sprite.top = std::max(0, y - core_radius);
        sprite.bottom = std::min(height, y + core_radius + 1);
        return sprite;
    }

    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }

    int width;
    int height;
    int channels;
    int kernel_channels;
    int centre_x;
    int centre_y;
    SpriteOptions options;
    int core_radius;
    std::optional<KernelProfile> profile;
    sources::KernelRoughness roughness;
    PaddedKernel core;
    std::map<int, PaddedKernel> smooth;  // by side of the cell; 1: of points
    SpriteTiles tiles;
    std::vector<Buffer> scratch;
    std::vector<Sprite> sprites;
};

Sprites::Sprites(int width, int height, int channels, const ConstImageView& kernel,
                 const SpriteOptions& options) {
    check(width, height, channels, kernel, options);
    impl_ = std::make_unique<Impl>(width, height, channels, kernel, options);
}
Sprites::~Sprites() = default;
Sprites::Sprites(Sprites&&) noexcept = default;
Sprites& Sprites::operator=(Sprites&&) noexcept = default;

SpriteReport Sprites::apply(const ConstImageView& light, const ImageView& out,
                            const float* weights) {
    return impl_->apply(light, out, weights);
}

}  // namespace aureole::glare
