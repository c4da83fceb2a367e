#include "glare/kernel_sums.h"

#include <cstddef>

#include "aureole/base/parallel.h"
#include "aureole/color/rgb.h"

namespace aureole::glare {
namespace {

// Adds `weight` times each channel of the kernel to a channel of the sum.
template <class ChannelOf, class WeightOf>
Image sum_channels(const Image& kernel, int channels, const ChannelOf& channel_of,
                   const WeightOf& weight_of) {
    Image sum(kernel.width(), kernel.height(), channels);
    parallel_for(static_cast<std::size_t>(kernel.height()), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        for (int channel = 0; channel < kernel.channels(); ++channel) {
            const float* from = kernel.row(y, channel);
            float* to = sum.row(y, channel_of(channel));
            const auto weight = static_cast<float>(weight_of(channel));
            for (int x = 0; x < kernel.width(); ++x) to[x] += weight * from[x];
        }
    });
    return sum;
}

}  // namespace

Image luminance_kernel(const Image& kernel) {
    return sum_channels(
        kernel, 1, [](int) { return 0; },
        [](int channel) {
            return color::kLuminanceWeights[static_cast<std::size_t>(channel % 3)];
        });
}

Image kernel_of_primaries(const Image& kernel) {
    const bool matrix = kernel.channels() == 9;
    return sum_channels(
        kernel, 3, [matrix](int channel) { return matrix ? channel / 3 : channel; },
        [](int) { return 1.0; });
}

}  // namespace aureole::glare
