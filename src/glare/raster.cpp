#include "glare/raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/parallel.h"
#include "glare/sprite_tiles.h"

namespace aureole::glare {
namespace {

// Pixels of a row that are interpolated at a time, and what that needs.
using Nodes = std::array<float, SpriteTiles::kWidth / 2 + 2 * kLargestScale>;
using Line = std::array<float, SpriteTiles::kWidth + 2 * kLargestScale>;

// Whole spans between nodes, of which the first begins half a node before pixel x0, a multiple of
// the scale: pixel x0 + i is line[i + kScale / 2]. nodes[j] is node j + x0 / kScale - 1.
template <int kScale>
void spans_between(const Nodes& nodes, int count, Line& line) {
    static_assert(kScale <= kLargestScale);
    const int spans = (count + kScale - 1) / kScale + 1;
    for (int j = 0; j < spans; ++j) {
        const auto node = static_cast<std::size_t>(j);
        const float step = nodes[node + 1] - nodes[node];
        for (int i = 0; i < kScale; ++i) {
            constexpr float kPixel = 1.0F / kScale;
            line[static_cast<std::size_t>(j * kScale + i)] =
                nodes[node] + (static_cast<float>(i) + 0.5F) * kPixel * step;
        }
    }
}

// The raster at pixels [x0, x0 + count) of row y; the first is where the result points to.
const float* row_between(const Image& raster, int scale, int x0, int y, int c, int count,
                         Line& line) {
    Nodes nodes;
    const Between row = raster_place(y, scale);
    const int first = x0 / scale - 1 + kRasterMargin;
    const float* above = raster.row(row.node + kRasterMargin, c) + first;
    const float* below = raster.row(row.node + kRasterMargin + 1, c) + first;
    const int needed = std::min((count + scale - 1) / scale + 2, raster.width() - first);
    for (int i = 0; i < needed; ++i) {
        nodes[static_cast<std::size_t>(i)] = above[i] + row.right * (below[i] - above[i]);
    }
    switch (scale) {
        case 2:
            spans_between<2>(nodes, count, line);
            break;
        case 4:
            spans_between<4>(nodes, count, line);
            break;
        default:
            spans_between<8>(nodes, count, line);
            break;
    }
    return line.data() + scale / 2;
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
    Line line;
    for (int y = 0; y < tile.height; ++y) {
        for (int c = 0; c < tile.channels; ++c) {
            const float* from = row_between(raster, scale, tile.x, tile.y + y, c, tile.width, line);
            float* to = tile.planes[static_cast<std::size_t>(c)] + y * tile.stride;
            for (int x = 0; x < tile.width; ++x) to[x] += from[x];
        }
    }
}

void add_between(const Image& raster, int scale, const float* weights,
                 const ImageView& out) noexcept {
    parallel_for(static_cast<std::size_t>(out.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        Line line;
        for (int c = 0; c < out.channels; ++c) {
            for (int x0 = 0; x0 < out.width; x0 += SpriteTiles::kWidth) {
                const int count = std::min(SpriteTiles::kWidth, out.width - x0);
                const float* from = row_between(raster, scale, x0, y, c, count, line);
                float* to = &out.at(x0, y, c);
                // A stride of 1 that the compiler knows of becomes vectors.
                if (weights == nullptr && out.pixel_stride == 1) {
                    for (int x = 0; x < count; ++x) to[x] += from[x];
                    continue;
                }
                const float* weight =
                    weights == nullptr ? nullptr : weights + std::ptrdiff_t{y} * out.width + x0;
                if (out.pixel_stride == 1) {
                    for (int x = 0; x < count; ++x) to[x] += from[x] / weight[x];
                    continue;
                }
                for (int x = 0; x < count; ++x) {
                    to[x * out.pixel_stride] += from[x] / (weight == nullptr ? 1.0F : weight[x]);
                }
            }
        }
    });
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
