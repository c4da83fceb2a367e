#include "sources/brightness_sums.h"

#include <algorithm>
#include <cmath>

#include "sources/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sources/brightness_sums.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::sources::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;

// Columns [0, end) in whole vectors; returns where it ended. `planes`: rows of the channels.
template <int kChannels>
int add_row(const float* const* planes, const float* weights, int count, float* energy,
            float* largest) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        auto most = hn::Abs(hn::LoadU(d, planes[0] + x));
        auto sum = most;
        for (int c = 1; c < kChannels; ++c) {
            const auto value = hn::Abs(hn::LoadU(d, planes[c] + x));
            most = hn::Max(most, value);
            sum = hn::Add(sum, value);
        }
        if (weights != nullptr) sum = hn::Mul(sum, hn::LoadU(d, weights + x));
        hn::StoreU(hn::Add(hn::LoadU(d, energy + x), sum), d, energy + x);
        hn::StoreU(hn::Max(hn::LoadU(d, largest + x), most), d, largest + x);
    }
    return x;
}

int add(const float* const* planes, int channels, const float* weights, int count, float* energy,
        float* largest) {
    return channels == 3 ? add_row<3>(planes, weights, count, energy, largest)
                         : add_row<1>(planes, weights, count, energy, largest);
}

}  // namespace
}  // namespace aureole::sources::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::sources {

HWY_EXPORT(add);

void add_brightness_row(const ConstImageView& view, const float* weights, int y, float* energy,
                        float* largest) noexcept {
    int x = 0;
    if (view.pixel_stride == 1 && (view.channels == 1 || view.channels == 3)) {
        const float* planes[3] = {};
        for (int c = 0; c < view.channels; ++c) planes[c] = view.data + view.offset(0, y, c);
        x = HWY_DYNAMIC_DISPATCH(add)(planes, view.channels, weights, view.width, energy, largest);
    }
    for (; x < view.width; ++x) {
        float sum = 0;
        for (int c = 0; c < view.channels; ++c) {
            const float value = std::abs(view.at(x, y, c));
            sum += value;
            largest[x] = std::max(largest[x], value);
        }
        energy[x] += weights == nullptr ? sum : weights[x] * sum;
    }
}

}  // namespace aureole::sources
#endif
