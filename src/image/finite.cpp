#include "aureole/image/finite.h"

#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

#include "aureole/base/parallel.h"

namespace aureole {
namespace {

// By the exponent bits: true in any floating-point mode, and a vector instruction per lane.
bool nonfinite(float value) {
    return (std::bit_cast<std::uint32_t>(value) & 0x7f800000U) == 0x7f800000U;
}

bool row_is_finite(const ImageView& view, int y) {
    bool found = false;
    for (int c = 0; c < view.channels; ++c) {
        const float* row = &view.at(0, y, c);
        if (view.pixel_stride == 1) {
            for (int x = 0; x < view.width; ++x) found |= nonfinite(row[x]);
        } else {
            for (int x = 0; x < view.width; ++x) found |= nonfinite(row[x * view.pixel_stride]);
        }
    }
    return !found;
}

std::size_t clean_row(const ImageView& view, int y) {
    std::size_t pixels = 0;
    for (int x = 0; x < view.width; ++x) {
        bool found = false;
        for (int c = 0; c < view.channels; ++c) {
            float& value = view.at(x, y, c);
            if (!nonfinite(value)) continue;
            value = 0;
            found = true;
        }
        if (found) ++pixels;
    }
    return pixels;
}

}  // namespace

std::size_t replace_nonfinite(const ImageView& view) {
    std::vector<std::size_t> pixels(static_cast<std::size_t>(view.height));
    parallel_for(pixels.size(), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        if (!row_is_finite(view, y)) pixels[row] = clean_row(view, y);
    });
    return std::accumulate(pixels.begin(), pixels.end(), std::size_t{0});
}

}  // namespace aureole
