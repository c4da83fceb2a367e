#include "lens/matrix_chord_sums.h"

#include <algorithm>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/matrix_chord_sums.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using Vec = hn::Vec<D>;

// Of lines [begin, end), scaled by `radius`.
template <class Cut>
void cut_by_lines(const ChordEdges& edges, int begin, int end, Vec along, float radius,
                  const Cut& cut) {
    const D d;
    for (int i = begin; i < end; ++i) {
        cut(hn::MulAdd(hn::Set(d, edges.slope[i]), along, hn::Set(d, radius * edges.offset[i])));
    }
}

// Between `bottom` and `top` what the iris leaves, its middle at 0 and of this signed radius.
void cut_by_iris(const ChordEdges& edges, Vec along, float radius, Vec& bottom, Vec& top) {
    const auto from_above = [&](Vec line) { top = hn::Min(top, line); };
    const auto from_below = [&](Vec line) { bottom = hn::Max(bottom, line); };
    // Mirrored, lines above are below.
    if (radius > 0) {
        cut_by_lines(edges, 0, edges.upper, along, radius, from_above);
        cut_by_lines(edges, edges.upper, edges.count, along, radius, from_below);
    } else {
        cut_by_lines(edges, 0, edges.upper, along, radius, from_below);
        cut_by_lines(edges, edges.upper, edges.count, along, radius, from_above);
    }
}

}  // namespace

ChordSums chord_sums(const ChordEdges& edges, const ChordNodes& nodes, const ChordRange& range,
                     std::span<const ChordClip> discs, std::span<const ChordClip> irises) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    Vec area = hn::Zero(d);
    Vec along = area;
    Vec across = area;
    ChordSums sums = {0, 0, 0, kChords, -1};
    for (int i = 0; i < kChords; i += lanes) {
        const Vec x = hn::MulAdd(hn::Load(d, nodes.position + i), hn::Set(d, range.half),
                                 hn::Set(d, range.middle));
        Vec square = hn::Set(d, 1e20F);
        for (const ChordClip& disc : discs) {
            square = hn::Min(square, hn::Mul(hn::Sub(x, hn::Set(d, disc.low)),
                                             hn::Sub(hn::Set(d, disc.high), x)));
        }
        Vec top = hn::Sqrt(hn::Max(square, hn::Zero(d)));
        Vec bottom = hn::Neg(top);
        cut_by_iris(edges, x, 1, bottom, top);
        for (const ChordClip& iris : irises) {
            cut_by_iris(edges, hn::Sub(x, hn::Set(d, iris.center)), iris.radius, bottom, top);
        }
        const Vec length = hn::Sub(top, bottom);
        const auto open = hn::Gt(length, hn::Zero(d));
        if (hn::AllFalse(d, open)) continue;
        if (sums.last < 0) sums.first = i + static_cast<int>(hn::FindFirstTrue(d, open));
        // What is open is convex: from the first on as many as are open.
        sums.last = std::max(sums.first, i) - 1 + static_cast<int>(hn::CountTrue(d, open));
        const Vec weighted =
            hn::IfThenElseZero(open, hn::Mul(length, hn::Load(d, nodes.weight + i)));
        area = hn::Add(area, weighted);
        along = hn::MulAdd(weighted, x, along);
        across = hn::MulAdd(weighted, hn::Add(top, bottom), across);
    }
    sums.area = range.half * hn::GetLane(hn::SumOfLanes(d, area));
    sums.along = range.half * hn::GetLane(hn::SumOfLanes(d, along));
    sums.across = range.half * 0.5F * hn::GetLane(hn::SumOfLanes(d, across));
    return sums;
}

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(chord_sums);
ChordSums sum_chords(const ChordEdges& edges, const ChordNodes& nodes, const ChordRange& range,
                     std::span<const ChordClip> discs, std::span<const ChordClip> irises) noexcept {
    return HWY_DYNAMIC_DISPATCH(chord_sums)(edges, nodes, range, discs, irises);
}
}  // namespace aureole::lens
#endif
