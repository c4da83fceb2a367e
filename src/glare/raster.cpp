#include "glare/raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/parallel.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {
namespace {

// Adds `count` pixels from `x0` on, a multiple of the scale. nodes[j] is node j + x0 / kScale - 1.
template <int kScale>
void add_row_between(const float* nodes, int count, float* to) {
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

// sum[x] += factor in(x, y, c) weights[x]
void add_row(const ConstImageView& in, int y, int c, const float* weights, float factor,
             float* sum) {
    const float* from = in.data + in.offset(0, y, c);
    const std::ptrdiff_t stride = in.pixel_stride;
    // A stride of 1 that the compiler knows of becomes vectors.
    if (stride == 1 && weights == nullptr) {
        for (int x = 0; x < in.width; ++x) sum[x] += factor * from[x];
    } else if (stride == 1) {
        for (int x = 0; x < in.width; ++x) sum[x] += factor * from[x] * weights[x];
    } else {
        for (int x = 0; x < in.width; ++x) {
            sum[x] += factor * from[x * stride] * (weights == nullptr ? 1.0F : weights[x]);
        }
    }
}

// nodes[j] = sum over i < kTaps of hat[i] line[step j + i].
template <int kTaps>
void gather_row(const float* line, const float* hat, int count, float* nodes) {
    for (int j = 0; j < count; ++j, line += kTaps / 2) {
        float sum = 0;
        for (int i = 0; i < kTaps; ++i) sum += hat[i] * line[i];
        nodes[j] = sum;
    }
}

}  // namespace

int raster_size(int pixels, int scale) { return (pixels + scale - 1) / scale + 2 * kRasterMargin; }

Between raster_place(int x, int scale) {
    const double t = (x + 0.5) / scale - 0.5;
    const double node = std::floor(t);
    return {static_cast<int>(node), static_cast<float>(t - node)};
}

void add_between(const Image& raster, int scale, const SpriteTile& tile) {
    std::array<float, SpriteTiles::kWidth / 2 + 2 * kLargestScale> nodes;
    const int first = tile.x / scale - 1 + kRasterMargin;
    const int count = std::min((tile.width + scale - 1) / scale + 2, raster.width() - first);
    for (int y = 0; y < tile.height; ++y) {
        const Between row = raster_place(tile.y + y, scale);
        for (int c = 0; c < tile.channels; ++c) {
            const float* above = raster.row(row.node + kRasterMargin, c) + first;
            const float* below = raster.row(row.node + kRasterMargin + 1, c) + first;
            for (int i = 0; i < count; ++i) {
                nodes[static_cast<std::size_t>(i)] = above[i] + row.right * (below[i] - above[i]);
            }
            float* to = tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
            switch (scale) {
                case 2:
                    add_row_between<2>(nodes.data(), tile.width, to);
                    break;
                case 4:
                    add_row_between<4>(nodes.data(), tile.width, to);
                    break;
                default:
                    add_row_between<8>(nodes.data(), tile.width, to);
                    break;
            }
        }
    }
}

RasterGatherer::RasterGatherer(int width, int scale)
    : scale_(scale), scratch_(static_cast<std::size_t>(max_workers())) {
    for (int i = 0; i < 2 * scale; ++i) {
        hat_.push_back(static_cast<float>(1 - std::abs((i + 0.5) / scale - 1)));
    }
    const int line = (raster_size(width, scale) + 1) * scale;
    for (Buffer& buffer : scratch_) buffer = Buffer(static_cast<std::size_t>(line));
}

void RasterGatherer::run(const ConstImageView& in, const float* weights, Image& raster) noexcept {
    parallel_for(static_cast<std::size_t>(raster.height()), [&](std::size_t row, int worker) {
        Buffer& line = scratch_[static_cast<std::size_t>(worker)];
        // Of the 2 scale pixels about a node, the first along either axis.
        const auto first_pixel = [&](int node) {
            return (node - kRasterMargin) * scale_ - scale_ / 2;
        };
        const int first_row = first_pixel(static_cast<int>(row));
        for (int c = 0; c < in.channels; ++c) {
            std::fill_n(line.data(), line.size(), 0.0F);
            for (int i = 0; i < 2 * scale_; ++i) {
                const int y = first_row + i;
                if (y < 0 || y >= in.height) continue;
                add_row(in, y, c,
                        weights == nullptr ? nullptr : weights + std::ptrdiff_t{y} * in.width,
                        hat_[static_cast<std::size_t>(i)], line.data() - first_pixel(0));
            }
            float* nodes = raster.row(static_cast<int>(row), c);
            switch (scale_) {
                case 2:
                    gather_row<4>(line.data(), hat_.data(), raster.width(), nodes);
                    break;
                case 4:
                    gather_row<8>(line.data(), hat_.data(), raster.width(), nodes);
                    break;
                default:
                    gather_row<16>(line.data(), hat_.data(), raster.width(), nodes);
                    break;
            }
        }
    });
}

}  // namespace aureole::glare
