#include "glare/sprite_drawing.h"

#include <algorithm>
#include <cmath>

#include "glare/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "glare/sprite_drawing.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::glare::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using Vec = hn::Vec<D>;

template <class Sum>
HWY_INLINE void add_span(float* to, int count, const Sum& sum) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        hn::StoreU(sum(x, hn::LoadU(d, to + x)), d, to + x);
    }
    if (x < count) {
        const auto mask = hn::FirstN(d, static_cast<std::size_t>(count - x));
        hn::BlendedStore(sum(x, hn::MaskedLoad(mask, d, to + x)), mask, d, to + x);
    }
}

// Kernels have room for a vector beyond the end of each row, so that only the tile needs a mask.
void add_one_tap(const float* kernel, float weight, float* to, int count) {
    const D d;
    const Vec w = hn::Set(d, weight);
    add_span(to, count,
             [&](int x, Vec sum) HWY_ATTR { return hn::MulAdd(w, hn::LoadU(d, kernel + x), sum); });
}

void add_four_taps(const float* kernel, std::ptrdiff_t stride, const std::array<float, 4>& weight,
                   float* to, int count) {
    const D d;
    const Vec w0 = hn::Set(d, weight[0]);
    const Vec w1 = hn::Set(d, weight[1]);
    const Vec w2 = hn::Set(d, weight[2]);
    const Vec w3 = hn::Set(d, weight[3]);
    const float* above = kernel - stride;
    add_span(to, count, [&](int x, Vec sum) HWY_ATTR {
        sum = hn::MulAdd(w0, hn::LoadU(d, kernel + x), sum);
        sum = hn::MulAdd(w1, hn::LoadU(d, kernel + x - 1), sum);
        sum = hn::MulAdd(w2, hn::LoadU(d, above + x), sum);
        return hn::MulAdd(w3, hn::LoadU(d, above + x - 1), sum);
    });
}

void draw_row(const Sprite& sprite, const SpriteTile& tile, int y) {
    const float dy = static_cast<float>(y) + 0.5F - sprite.centre_y;
    const float half2 = sprite.radius * sprite.radius - dy * dy;
    if (half2 <= 0) return;
    const float half = std::sqrt(half2);
    // Pixels whose middle is in the disc.
    const int first =
        std::max({tile.x, sprite.left, static_cast<int>(std::ceil(sprite.centre_x - half - 0.5F))});
    const int end = std::min({tile.x + tile.width, sprite.right,
                              static_cast<int>(std::floor(sprite.centre_x + half - 0.5F)) + 1});
    if (first >= end) return;
    const std::ptrdiff_t from = (y - sprite.y0) * sprite.stride + (first - sprite.x0);
    const std::ptrdiff_t to = (y - tile.y) * tile.stride + (first - tile.x);
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c) {
        if (sprite.taps == 1) {
            add_one_tap(sprite.kernel[c] + from, sprite.weight[c][0], tile.planes[c] + to,
                        end - first);
        } else {
            add_four_taps(sprite.kernel[c] + from, sprite.stride, sprite.weight[c],
                          tile.planes[c] + to, end - first);
        }
    }
}

void draw(const Sprite* sprites, const std::uint32_t* order, std::size_t count,
          const SpriteTile& tile) {
    for (std::size_t i = 0; i < count; ++i) {
        const Sprite& sprite = sprites[order[i]];
        const int end = std::min(tile.y + tile.height, sprite.bottom);
        for (int y = std::max(tile.y, sprite.top); y < end; ++y) draw_row(sprite, tile, y);
    }
}

}  // namespace
}  // namespace aureole::glare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::glare {

HWY_EXPORT(draw);

void draw_sprites(const Sprite* sprites, const std::uint32_t* order, std::size_t count,
                  const SpriteTile& tile) {
    HWY_DYNAMIC_DISPATCH(draw)(sprites, order, count, tile);
}

}  // namespace aureole::glare
#endif
