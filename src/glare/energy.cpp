#include "aureole/glare/energy.h"

#include <algorithm>

#include "aureole/base/parallel.h"

namespace aureole::glare {
namespace {

// sums[i] += sign * kernel(i, y, channel); rows outside the kernel count as 0.
void add_row(std::vector<double>& sums, const ConstImageView& kernel, int y, int channel,
             double sign) {
    if (y < 0 || y >= kernel.height) return;
    for (int i = 0; i < kernel.width; ++i) {
        sums[static_cast<std::size_t>(i)] += sign * kernel.at(i, y, channel);
    }
}

void share_of_channel(const ConstImageView& kernel, int channel, Image& share) {
    const int width = share.width();
    const int height = share.height();
    const int centre_x = kernel.width / 2;
    const int centre_y = kernel.height / 2;
    // A source in row sy sees kernel rows [centre_y - sy, centre_y - sy + height).
    std::vector<double> column_sums(static_cast<std::size_t>(kernel.width));
    for (int y = centre_y; y < centre_y + height; ++y) {
        add_row(column_sums, kernel, y, channel, 1);
    }
    std::vector<double> prefix(static_cast<std::size_t>(kernel.width) + 1);
    for (int sy = 0; sy < height; ++sy) {
        for (std::size_t i = 0; i < column_sums.size(); ++i) {
            prefix[i + 1] = prefix[i] + column_sums[i];
        }
        float* out = share.row(sy, channel);
        for (int sx = 0; sx < width; ++sx) {
            const int first = std::clamp(centre_x - sx, 0, kernel.width);
            const int end = std::clamp(centre_x - sx + width, 0, kernel.width);
            out[sx] = static_cast<float>(prefix[static_cast<std::size_t>(end)] -
                                         prefix[static_cast<std::size_t>(first)]);
        }
        add_row(column_sums, kernel, centre_y - sy - 1, channel, 1);
        add_row(column_sums, kernel, centre_y - sy - 1 + height, channel, -1);
    }
}

}  // namespace

Image share_inside(int width, int height, const ConstImageView& kernel) {
    Image share(width, height, kernel.channels);
    parallel_for(static_cast<std::size_t>(kernel.channels), [&](std::size_t channel, int) {
        share_of_channel(kernel, static_cast<int>(channel), share);
    });
    return share;
}

}  // namespace aureole::glare
