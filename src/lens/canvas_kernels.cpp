#include "lens/canvas_kernels.h"

#include <algorithm>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/canvas_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
// At most 16 lanes, which CanvasLevel::kPadding makes room for.
using D = hn::CappedTag<float, 16>;
using Vec = hn::Vec<D>;

int floor_half(int i) { return i >> 1; }

// The two rows of a coarse level that fine row y lies between, and what it takes of them.
struct CoarseRows {
    int near;  // weight 3/4
    int far;   // weight 1/4
};
CoarseRows rows_at(int y) {
    const int near = floor_half(y);
    return {near, (y & 1) != 0 ? near + 1 : near - 1};
}

// Coarse pixels that contribute to fine row y.
RowSpan used_at(const CanvasLevel& coarse, int y) {
    const CoarseRows rows = rows_at(y);
    RowSpan span = coarse.used[rows.near];
    const RowSpan other = coarse.used[rows.far];
    if (!other.empty()) span.include(other.begin, other.end);
    return span;
}

// Coarse pixels [c0, c1), each becoming two fine ones, added to `to`, whose first element is fine
// pixel 2 c0. Reads one coarse pixel more at either end. Writes up to 2 Lanes(d) - 2 floats too
// many, adding to them what it finds in the coarse row there.
void refine(const float* near, const float* far, int c0, int c1, float* to) {
    const D d;
    const Vec most = hn::Set(d, 0.75F);
    const Vec least = hn::Set(d, 0.25F);
    const auto at = [&](int c) {
        return hn::MulAdd(most, hn::LoadU(d, near + c), hn::Mul(least, hn::LoadU(d, far + c)));
    };
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int c = c0; c < c1; c += lanes, to += 2 * lanes) {
        const Vec middle = hn::Mul(most, at(c));
        Vec even;
        Vec odd;
        hn::LoadInterleaved2(d, to, even, odd);
        even = hn::Add(even, hn::MulAdd(least, at(c - 1), middle));
        odd = hn::Add(odd, hn::MulAdd(least, at(c + 1), middle));
        hn::StoreInterleaved2(even, odd, d, to);
    }
}

void refine_row(const CanvasLevel& coarse, const CanvasLevel& fine, int y) {
    const RowSpan span = used_at(coarse, y);
    if (span.empty()) return;
    // A coarse pixel reaches one fine pixel beyond its own two: those of its neighbours.
    const int c0 = std::max(span.begin - 1, -fine.margin / 2);
    const int c1 = std::min(span.end + 1, floor_half(fine.width + fine.margin + 1));
    if (c0 >= c1) return;
    fine.mark_used(y, 2 * c0, std::min(2 * c1, fine.width + fine.margin));
    const CoarseRows rows = rows_at(y);
    for (int p = 0; p < 3; ++p) {
        refine(coarse.planes[p] + rows.near * coarse.stride,
               coarse.planes[p] + rows.far * coarse.stride, c0, c1,
               fine.planes[p] + y * fine.stride + 2 * c0);
    }
}

constexpr int kChunk = 256;  // fine pixels, even

void add_planar(const float* from, int count, float* to) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        hn::StoreU(hn::Add(hn::LoadU(d, to + x), hn::LoadU(d, from + x)), d, to + x);
    }
    for (; x < count; ++x) to[x] += from[x];
}

void add_interleaved(const float (*from)[kChunk + CanvasLevel::kPadding], int count, float* to) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= count; x += lanes) {
        Vec r;
        Vec g;
        Vec b;
        hn::LoadInterleaved3(d, to + 3 * x, r, g, b);
        hn::StoreInterleaved3(hn::Add(r, hn::LoadU(d, from[0] + x)),
                              hn::Add(g, hn::LoadU(d, from[1] + x)),
                              hn::Add(b, hn::LoadU(d, from[2] + x)), d, to + 3 * x);
    }
    for (; x < count; ++x) {
        for (int p = 0; p < 3; ++p) to[3 * x + p] += from[p][x];
    }
}

void add_row(const CanvasLevel& fine, const CanvasLevel* coarse, const ImageView& out, int y) {
    RowSpan span = fine.used[y];
    RowSpan coarse_span;
    if (coarse != nullptr) {
        coarse_span = used_at(*coarse, y);
        if (!coarse_span.empty()) span.include(2 * coarse_span.begin - 1, 2 * coarse_span.end + 1);
    }
    span = {std::max(span.begin, 0) & ~1, std::min(span.end, out.width)};
    const CoarseRows rows = rows_at(y);
    HWY_ALIGN float sum[3][kChunk + CanvasLevel::kPadding];
    for (int x = span.begin; x < span.end; x += kChunk) {
        const int count = std::min(kChunk, span.end - x);
        for (int p = 0; p < 3; ++p) {
            const float* row = fine.planes[p] + y * fine.stride + x;
            std::copy(row, row + count, sum[p]);
            std::fill(sum[p] + count, sum[p] + count + CanvasLevel::kPadding, 0.0F);
            if (coarse_span.empty()) continue;
            const int c0 = std::max(x / 2, coarse_span.begin - 1);
            const int c1 = std::min((x + count + 1) / 2, coarse_span.end + 1);
            if (c0 >= c1) continue;
            refine(coarse->planes[p] + rows.near * coarse->stride,
                   coarse->planes[p] + rows.far * coarse->stride, c0, c1, sum[p] + (2 * c0 - x));
        }
        float* to = &out.at(x, y, 0);
        if (out.pixel_stride == 3 && out.channel_stride == 1) {
            add_interleaved(sum, count, to);
            continue;
        }
        for (int p = 0; p < 3; ++p, to += out.channel_stride) {
            if (out.pixel_stride == 1) {
                add_planar(sum[p], count, to);
            } else {
                for (int i = 0; i < count; ++i) to[i * out.pixel_stride] += sum[p][i];
            }
        }
    }
}

}  // namespace

CanvasKernels make_canvas_kernels() { return {&refine_row, &add_row}; }

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(make_canvas_kernels);
CanvasKernels canvas_kernels() { return HWY_DYNAMIC_DISPATCH(make_canvas_kernels)(); }
}  // namespace aureole::lens
#endif
