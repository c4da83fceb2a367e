// Pieces onto the pixels below them. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_SCATTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_SCATTER_INL_H_
#undef AUREOLE_LENS_MESH_SCATTER_INL_H_
#else
#define AUREOLE_LENS_MESH_SCATTER_INL_H_
#endif

#include <bit>

#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// A rectangle at most one pixel wide, laid over two pixels.
struct Overlap {
    V first;  // left or upper pixel
    V share;  // of the rectangle on it
};

// One axis of the rectangles of pieces, from their middles and changes over a piece: so many times
// as wide as a rectangle with the same second moment, and no wider than a pixel.
HWY_INLINE Overlap lay(V middle, V change_i, V change_j, float times) {
    const V own2 = hn::MulAdd(change_i, change_i, hn::Mul(change_j, change_j));
    const V width = hn::Min(hn::Max(hn::Mul(set(times), hn::Sqrt(own2)), set(1e-3F)), set(1));
    const V left = hn::NegMulAdd(set(0.5F), width, middle);
    const V first = hn::Floor(left);
    const V share = hn::Div(hn::Sub(hn::Add(first, set(1)), left), width);
    return {first, hn::Min(share, set(1))};
}

// Which of these positions are within a pixel of the tile.
HWY_INLINE M near(const MeshTile& tile, V x, V y) {
    const M columns = hn::And(hn::Gt(x, set(static_cast<float>(tile.x0 - 1))),
                              hn::Lt(x, set(static_cast<float>(tile.x1 + 1))));
    const M rows = hn::And(hn::Gt(y, set(static_cast<float>(tile.y0 - 1))),
                           hn::Lt(y, set(static_cast<float>(tile.y1 + 1))));
    return hn::And(columns, rows);
}

// Which rectangles have a pixel in the tile, from the first pixel of each.
HWY_INLINE M touching(const MeshTile& tile, V x, V y) {
    const M columns = hn::And(hn::Ge(x, set(static_cast<float>(tile.x0 - 1))),
                              hn::Lt(x, set(static_cast<float>(tile.x1))));
    const M rows = hn::And(hn::Ge(y, set(static_cast<float>(tile.y0 - 1))),
                           hn::Lt(y, set(static_cast<float>(tile.y1))));
    return hn::And(columns, rows);
}

// Adds the energy of rectangles, those of `which` that have any, to the pixels of the tile.
HWY_INLINE void scatter(const MeshTile& tile, const Overlap& x, const Overlap& y, M which,
                        V energy) {
    const D d;
    const hn::Rebind<std::int32_t, D> di;
    const M kept =
        hn::And(hn::And(which, hn::Gt(energy, hn::Zero(d))), touching(tile, x.first, y.first));
    if (hn::AllFalse(d, kept)) return;
    const V upper = hn::Mul(energy, y.share);
    const V lower = hn::Sub(energy, upper);
    const V upper_left = hn::Mul(upper, x.share);
    const V lower_left = hn::Mul(lower, x.share);
    const auto column = hn::ConvertTo(di, hn::Sub(x.first, set(static_cast<float>(tile.x0 - 1))));
    const auto row = hn::ConvertTo(di, hn::Sub(y.first, set(static_cast<float>(tile.y0 - 1))));
    const auto at =
        hn::Add(hn::Mul(row, hn::Set(di, static_cast<std::int32_t>(tile.stride))), column);
    // Two pixels of a row at a time.
    HWY_ALIGN float pairs[2][2 * kGroup];
    HWY_ALIGN std::int32_t offset[kGroup];
    hn::StoreInterleaved2(upper_left, hn::Sub(upper, upper_left), d, pairs[0]);
    hn::StoreInterleaved2(lower_left, hn::Sub(lower, lower_left), d, pairs[1]);
    hn::Store(at, di, offset);
    static_assert(kGroup <= 16);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, kept, bytes);
    const hn::CappedTag<float, 2> d2;
    for (unsigned left = bytes[0] | bytes[1] * 256U; left != 0; left &= left - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(left));
        float* to = tile.sums + offset[k];
        for (int row_pair = 0; row_pair < 2; ++row_pair, to += tile.stride) {
            if constexpr (hn::MaxLanes(d2) == 2) {
                const auto pair = hn::Load(d2, pairs[row_pair] + 2 * k);
                hn::StoreU(hn::Add(hn::LoadU(d2, to), pair), d2, to);
            } else {
                to[0] += pairs[row_pair][2 * k];
                to[1] += pairs[row_pair][2 * k + 1];
            }
        }
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
