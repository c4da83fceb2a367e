#include "aureole/glare/sprites.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/sources/brightness.h"
#include "glare/far_kernel.h"
#include "glare/sprite_crop.h"
#include "glare/sprite_drawing.h"
#include "glare/sprite_kernel.h"
#include "glare/sprite_layer.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {
namespace {

// Of the error asked for. Of the clusters' share each layer has half if there are two, and the far
// one pays for its raster with its own.
constexpr double kShareOfClusters = 0.5;
constexpr double kShareOfFarRaster = 0.125;
constexpr double kShareOfCrop = 0.25;
// Light that stays where it is counts twice: where it should have gone, and where it still is.
constexpr double kShareOfDimLight = 0.125;

constexpr int kCoreRadius = 8;
constexpr int kLargestCellKernel = 1025;
constexpr int kFarClusterSide = 64;
constexpr int kFarMargin = 1;  // nodes beyond the picture's edge, to interpolate from

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
          options(o),
          scratch(static_cast<std::size_t>(max_workers())) {
        std::optional<FarKernel> split;
        if (bounded()) split = find_far_kernel(kernel, kShareOfFarRaster * options.error);
        if (split) {
            far.emplace(w, h, c, split->scale, kFarMargin, split->coarse, 1);
            far_roughness = split->roughness;
            far_error = split->error;
            far_canvas = Image((w + split->scale - 1) / split->scale + 2 * kFarMargin,
                               (h + split->scale - 1) / split->scale + 2 * kFarMargin, c);
        }
        prepare_near(split ? split->near.view() : kernel);
        for (Buffer& buffer : scratch) buffer = Buffer(3 * kTilePlane);
    }

    bool bounded() const {
        return options.clusters.criterion == sources::ClusterOptions::Criterion::kBoundedError;
    }

    void prepare_near(const ConstImageView& kernel) {
        core_radius = core_radius_for(kernel, options);
        const SplitKernel split = split_kernel(kernel, core_radius);
        if (core_radius > 0) core = PaddedKernel(split.core);
        roughness = sources::roughness_of(split.smooth);
        options.clusters.cells = std::max(kernel.width, kernel.height) <= kLargestCellKernel;
        near.emplace(width, height, channels, 1, 0, split.smooth,
                     options.clusters.cells ? options.clusters.max_side : 1);
    }

    SpriteReport apply(const ConstImageView& light, const ImageView& out, const float* weights) {
        sources::ClusterOptions cluster_options = options.clusters;
        const double clusters_share = kShareOfClusters * options.error / (far ? 2 : 1);
        cluster_options.error = clusters_share;
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
        report.error_bound = found.error_bound + 2 * report.energy_left;
        const double most_lost = kShareOfCrop * options.error * report.energy / (far ? 2 : 1);
        add(near->make(found.clusters, crop_level(found.clusters, near->profile(), most_lost)), 1,
            report);
        if (far) {
            cluster_options.cells = false;
            cluster_options.max_side = kFarClusterSide;
            cluster_options.error = clusters_share - far_error;
            const sources::Clusters groups =
                sources::find_clusters(light, weights, far_roughness, cluster_options);
            report.far_sprites = groups.clusters.size();
            report.error_bound += groups.error_bound + far_error * found.energy;
            const double pixel_area = far->scale() * far->scale();
            add(far->make(groups.clusters,
                          crop_level(groups.clusters, far->profile(), most_lost / pixel_area)),
                pixel_area, report);
            draw_far();
        }
        parallel_for(near->tiles().size(), [&](std::size_t i, int worker) {
            draw_tile(light, out, weights, cluster_options.dim_limit, i,
                      scratch[static_cast<std::size_t>(worker)].data());
        });
        return report;
    }

    // `pixel_area`: how many pixels of the picture one of the layer stands for.
    static void add(const SpriteLayer::Made& made, double pixel_area, SpriteReport& report) {
        const double cut = made.energy_cut * pixel_area;
        report.energy_cut += cut;
        report.error_bound += cut;
        report.pixels_drawn += made.pixels_drawn;
    }

    void draw_far() {
        parallel_for(far->tiles().size(), [&](std::size_t i, int worker) {
            const SpriteTile tile =
                cleared_tile(*far, i, scratch[static_cast<std::size_t>(worker)].data());
            far->draw(i, tile);
            for (int c = 0; c < channels; ++c) {
                const float* plane = tile.planes[static_cast<std::size_t>(c)];
                for (int y = 0; y < tile.height; ++y) {
                    std::copy_n(plane + y * tile.stride, tile.width,
                                far_canvas.row(tile.y + y, c) + tile.x);
                }
            }
        });
    }

    // Tile `index` in three planes of scratch memory, all 0.
    SpriteTile cleared_tile(const SpriteLayer& layer, std::size_t index, float* planes) const {
        SpriteTile tile = layer.tiles().tile(index);
        tile.channels = channels;
        tile.stride = SpriteTiles::kWidth;
        for (std::size_t c = 0; c < 3; ++c) tile.planes[c] = planes + c * kTilePlane;
        std::fill_n(planes, 3 * kTilePlane, 0.0F);
        return tile;
    }

    // The far layer between its nodes, added to a tile of the picture.
    void add_far(const SpriteTile& tile) const {
        const int scale = far->scale();
        std::vector<float> nodes(static_cast<std::size_t>(far_canvas.width()));
        for (int y = 0; y < tile.height; ++y) {
            const Between row = coarse_place(tile.y + y, scale);
            for (int c = 0; c < channels; ++c) {
                const float* above = far_canvas.row(row.node + kFarMargin, c);
                const float* below = far_canvas.row(row.node + kFarMargin + 1, c);
                const int first = coarse_place(tile.x, scale).node + kFarMargin;
                const int end = coarse_place(tile.x + tile.width - 1, scale).node + kFarMargin + 2;
                for (int i = first; i < end; ++i) {
                    nodes[static_cast<std::size_t>(i)] =
                        above[i] + row.right * (below[i] - above[i]);
                }
                add_between(nodes.data() + kFarMargin, scale, tile.x, tile.width,
                            tile.planes[static_cast<std::size_t>(c)] + y * tile.stride);
            }
        }
    }

    static void add_between(const float* nodes, int scale, int x0, int count, float* to) {
        std::array<float, 16> right = {};  // by place within a coarse pixel
        std::array<int, 16> step = {};
        for (int i = 0; i < scale; ++i) {
            const Between place = coarse_place(i, scale);
            right[static_cast<std::size_t>(i)] = place.right;
            step[static_cast<std::size_t>(i)] = place.node;
        }
        for (int x = 0; x < count; ++x) {
            const int pixel = x0 + x;
            const auto phase = static_cast<std::size_t>(pixel % scale);
            const float* node = nodes + pixel / scale + step[phase];
            to[x] += node[0] + right[phase] * (node[1] - node[0]);
        }
    }

    void draw_tile(const ConstImageView& light, const ImageView& out, const float* weights,
                   float dim_limit, std::size_t index, float* planes) const {
        const SpriteTile tile = cleared_tile(*near, index, planes);
        if (core_radius > 0) draw_cores(light, weights, dim_limit, tile);
        near->draw(index, tile);
        if (far) add_far(tile);
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

    static constexpr std::size_t kTilePlane = SpriteTiles::kWidth * SpriteTiles::kHeight;

    int width;
    int height;
    int channels;
    int kernel_channels;
    SpriteOptions options;
    int core_radius = 0;
    PaddedKernel core;
    std::optional<SpriteLayer> near;
    sources::KernelRoughness roughness;
    std::optional<SpriteLayer> far;  // of large kernels
    sources::KernelRoughness far_roughness;
    double far_error = 0;  // of its raster, per energy
    Image far_canvas;
    std::vector<Buffer> scratch;
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
