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
// `share(dx)`: factors of the pixels from dx on, dx counting from the sprite's centre.
template <class Share>
void add_one_tap(const float* kernel, float weight, float* to, int count, float dx,
                 const Share& share) {
    const D d;
    const Vec w = hn::Set(d, weight);
    add_span(to, count, [&](int x, Vec sum) HWY_ATTR {
        const Vec factor = share(dx + static_cast<float>(x));
        return hn::MulAdd(hn::Mul(w, factor), hn::LoadU(d, kernel + x), sum);
    });
}

template <class Share>
void add_four_taps(const float* kernel, std::ptrdiff_t stride, const std::array<float, 4>& weight,
                   float* to, int count, float dx, const Share& share) {
    const D d;
    const Vec w0 = hn::Set(d, weight[0]);
    const Vec w1 = hn::Set(d, weight[1]);
    const Vec w2 = hn::Set(d, weight[2]);
    const Vec w3 = hn::Set(d, weight[3]);
    const float* above = kernel - stride;
    add_span(to, count, [&](int x, Vec sum) HWY_ATTR {
        Vec value = hn::Mul(w0, hn::LoadU(d, kernel + x));
        value = hn::MulAdd(w1, hn::LoadU(d, kernel + x - 1), value);
        value = hn::MulAdd(w2, hn::LoadU(d, above + x), value);
        value = hn::MulAdd(w3, hn::LoadU(d, above + x - 1), value);
        return hn::MulAdd(share(dx + static_cast<float>(x)), value, sum);
    });
}

// What of a sprite is left at pixels of a row: smoothstep(0, fade, radius - distance).
class Fade {
  public:
    Fade(const Sprite& sprite, float dy)
        : dy2_(dy * dy), radius_(sprite.radius), per_pixel_(1 / sprite.fade) {}

    // At distances dx, dx + 1, ... to the right of the sprite's centre.
    Vec operator()(float dx) const {
        const D d;
        const Vec x = hn::Add(hn::Set(d, dx), hn::Iota(d, 0));
        const Vec distance = hn::Sqrt(hn::MulAdd(x, x, hn::Set(d, dy2_)));
        const Vec left = hn::Mul(hn::Sub(hn::Set(d, radius_), distance), hn::Set(d, per_pixel_));
        const Vec t = hn::Min(hn::Max(left, hn::Zero(d)), hn::Set(d, 1.0F));
        return hn::Mul(hn::Mul(t, t), hn::NegMulAdd(hn::Set(d, 2.0F), t, hn::Set(d, 3.0F)));
    }

  private:
    float dy2_;
    float radius_;
    float per_pixel_;
};

struct Whole {
    Vec operator()(float) const { return hn::Set(D(), 1.0F); }
};

// Pixels [first, end) of row y.
template <class Share>
void draw_span(const Sprite& sprite, const SpriteTile& tile, int y, int first, int end,
               const Share& share) {
    if (first >= end) return;
    const std::ptrdiff_t from = (y - sprite.y0) * sprite.stride + (first - sprite.x0);
    const std::ptrdiff_t to = (y - tile.y) * tile.stride + (first - tile.x);
    const float dx = static_cast<float>(first) + 0.5F - sprite.centre_x;
    for (std::size_t c = 0; c < static_cast<std::size_t>(tile.channels); ++c) {
        if (sprite.taps == 1) {
            add_one_tap(sprite.kernel[c] + from, sprite.weight[c][0], tile.planes[c] + to,
                        end - first, dx, share);
        } else {
            add_four_taps(sprite.kernel[c] + from, sprite.stride, sprite.weight[c],
                          tile.planes[c] + to, end - first, dx, share);
        }
    }
}

// Half the width of the disc of this radius in a row, or less than 0.
float half_width(float radius, float dy) {
    const float half2 = radius * radius - dy * dy;
    return radius > 0 && half2 > 0 ? std::sqrt(half2) : -1.0F;
}

void draw_row(const Sprite& sprite, const SpriteTile& tile, int y) {
    const float dy = static_cast<float>(y) + 0.5F - sprite.centre_y;
    const float half = half_width(sprite.radius, dy);
    if (half < 0) return;
    // Pixels whose middle is in the disc.
    const auto begin_of = [&](float half_px) {
        return std::max(
            {tile.x, sprite.left, static_cast<int>(std::ceil(sprite.centre_x - half_px - 0.5F))});
    };
    const auto end_of = [&](float half_px) {
        return std::min({tile.x + tile.width, sprite.right,
                         static_cast<int>(std::floor(sprite.centre_x + half_px - 0.5F)) + 1});
    };
    const int first = begin_of(half);
    const int end = end_of(half);
    if (sprite.fade == 0) {
        draw_span(sprite, tile, y, first, end, Whole());
        return;
    }
    const Fade fade(sprite, dy);
    const float whole = half_width(sprite.radius - sprite.fade, dy);
    const int whole_first = begin_of(whole);
    const int whole_end = end_of(whole);
    if (whole < 0 || whole_first >= whole_end) {
        draw_span(sprite, tile, y, first, end, fade);
        return;
    }
    draw_span(sprite, tile, y, first, whole_first, fade);
    draw_span(sprite, tile, y, whole_first, whole_end, Whole());
    draw_span(sprite, tile, y, whole_end, end, fade);
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
