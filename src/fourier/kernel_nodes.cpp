#include "aureole/fourier/kernel_nodes.h"

#include <algorithm>
#include <string>

#include "aureole/base/error.h"

namespace aureole::fourier {
namespace {

// Adds `share` times the kernel of a half to the middle of `out`.
void add_whole(const Image& half, float share, Image& out) {
    const int reach = half.width() - 1;
    const int x0 = out.width() / 2;
    const int y0 = out.height() / 2 - half.height() / 2;
    for (int c = 0; c < half.channels(); ++c) {
        for (int y = 0; y < half.height(); ++y) {
            const float* from = half.row(y, c);
            float* to = out.row(y0 + y, c) + x0;
            float* turned = out.row(y0 + half.height() - 1 - y, c) + x0;
            to[0] += share * from[0];
            for (int x = 1; x <= reach; ++x) {
                to[x] += share * from[x];
                turned[-x] += share * from[x];
            }
        }
    }
}

}  // namespace

void KernelNodes::half_of(int node, const ImageView& out) const noexcept {
    const std::size_t terms = mixture.empty() ? 1 : halves.size();
    for (int c = 0; c < out.channels; ++c) {
        for (int y = 0; y < out.height; ++y) {
            for (std::size_t t = 0; t < terms; ++t) {
                const auto n = static_cast<std::size_t>(node);
                const float factor = mixture.empty() ? 1.0F : mixture[n * terms + t];
                if (t > 0 && factor == 0) continue;
                const float* from = halves[mixture.empty() ? n : t].row(y, c);
                float* to = &out.at(0, y, c);
                for (int x = 0; x < out.width; ++x) {
                    to[x] = t == 0 ? factor * from[x] : to[x] + factor * from[x];
                }
            }
        }
    }
}

Image KernelNodes::half_of(int node) const {
    const Image& first = halves.front();
    Image half(first.width(), first.height(), first.channels());
    half_of(node, half);
    return half;
}

Image right_half(const Image& kernel) {
    const int width = kernel.width();
    const int height = kernel.height();
    if (width % 2 == 0 || height % 2 == 0) {
        throw InvalidArgument("kernel of a node",
                              std::to_string(width) + "x" + std::to_string(height),
                              "must have an odd width and height");
    }
    Image half(width / 2 + 1, height, kernel.channels());
    for (int c = 0; c < kernel.channels(); ++c) {
        for (int y = 0; y < height; ++y) {
            const float* row = kernel.row(y, c);
            const float* turned = kernel.row(height - 1 - y, c);
            float* to = half.row(y, c);
            for (int x = 0; x < half.width(); ++x) {
                to[x] = 0.5F * (row[width / 2 + x] + turned[width / 2 - x]);
            }
        }
    }
    return half;
}

Image whole_kernel(const Image& right_half) {
    Image kernel(2 * right_half.width() - 1, right_half.height(), right_half.channels());
    add_whole(right_half, 1, kernel);
    return kernel;
}

NodeBlend node_blend(int pixel, int pixels, int nodes) {
    if (nodes == 1 || pixels == 1) return {};
    const double at = static_cast<double>(pixel) * (nodes - 1) / (pixels - 1);
    const int first = std::min(static_cast<int>(at), nodes - 1);
    return {first, static_cast<float>(at - first)};
}

Image kernel_at(const std::vector<KernelNodes>& parts, int width, int height, int x, int y) {
    int reach_x = 0;
    int reach_y = 0;
    int channels = 1;
    for (const KernelNodes& part : parts) {
        reach_x = std::max(reach_x, part.reach_x());
        reach_y = std::max(reach_y, part.reach_y());
        channels = part.halves.front().channels();
    }
    Image result(2 * reach_x + 1, 2 * reach_y + 1, channels);
    for (const KernelNodes& part : parts) {
        const NodeBlend across = node_blend(x, width, part.columns);
        const NodeBlend down = node_blend(y, height, part.rows);
        for (const int j : {0, 1}) {
            for (const int i : {0, 1}) {
                const float share = (i == 0 ? 1 - across.second_share : across.second_share) *
                                    (j == 0 ? 1 - down.second_share : down.second_share);
                if (share == 0) continue;
                add_whole(part.half_of((down.first + j) * part.columns + across.first + i), share,
                          result);
            }
        }
    }
    return result;
}

std::size_t bytes(const std::vector<KernelNodes>& parts) {
    std::size_t sum = 0;
    for (const KernelNodes& part : parts) {
        sum += part.mixture.size() * sizeof(float);
        for (const Image& half : part.halves) {
            sum += half.pixels() * static_cast<std::size_t>(half.channels()) * sizeof(float);
        }
    }
    return sum;
}

}  // namespace aureole::fourier
