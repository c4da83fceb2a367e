#include "aureole/sources/brightness.h"

#include <algorithm>
#include <cmath>

namespace aureole::sources {

void largest_channel_row(const ConstImageView& view, int y, float* out) noexcept {
    for (int c = 0; c < view.channels; ++c) {
        const float* row = view.data + view.offset(0, y, c);
        const auto merge = [&](auto value_at) {
            if (c == 0) {
                for (int x = 0; x < view.width; ++x) out[x] = std::abs(value_at(x));
            } else {
                for (int x = 0; x < view.width; ++x) {
                    const float value = std::abs(value_at(x));
                    out[x] = value > out[x] ? value : out[x];
                }
            }
        };
        // A stride of 1 that the compiler knows of becomes vectors.
        if (view.pixel_stride == 1) {
            merge([row](int x) { return row[x]; });
        } else {
            merge([row, stride = view.pixel_stride](int x) { return row[x * stride]; });
        }
    }
}

bool any_above(const float* values, int count, float limit) noexcept {
    int above = 0;
    for (int x = 0; x < count; ++x) above |= values[x] > limit ? 1 : 0;
    return above != 0;
}

}  // namespace aureole::sources
