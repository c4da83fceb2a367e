// The sum over a list of nodes for 16 outputs. Included once per instruction set; see
// gather_kernels.cpp.
#if defined(AUREOLE_IBL_GATHER_SUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_IBL_GATHER_SUM_INL_H_
#undef AUREOLE_IBL_GATHER_SUM_INL_H_
#else
#define AUREOLE_IBL_GATHER_SUM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "ibl/face_frame.h"
#include "ibl/gather_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<float, kGroup>;
using V16 = hn::Vec<D16>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(D16()));
// So many vectors of outputs take each step together.
inline constexpr int kTogether = kLanes <= kGroup / 2 ? 2 : 1;

HWY_INLINE V16 set16(float value) { return hn::Set(D16(), value); }

// Outputs N = centre + offset, so that |N - L|^2 = |offset|^2 - 2 offset.(L - centre) + |L -
// centre|^2 keeps its digits where N and L are close.
struct GroupPoints {
    float centre[3];
    float radius;
    alignas(64) float x[kGroup];  // offset times the scale of the lobe
    alignas(64) float y[kGroup];
    alignas(64) float z[kGroup];
    alignas(64) float base[kGroup];  // scale |offset|^2 / 2
};

HWY_INLINE GroupPoints group_points(int face, const GatherGrid& grid, float scale,
                                    float* HWY_RESTRICT length) {
    const D16 d;
    const FaceFrame& frame = kFaceFrames[static_cast<std::size_t>(face)];
    GroupPoints points;
    const float middle_s = 0.5F * (grid.s[0] + grid.s[kGroupSide - 1]);
    const float middle_t = 0.5F * (grid.t[0] + grid.t[kGroupSide - 1]);
    const float middle = 1 / std::sqrt(1 + middle_s * middle_s + middle_t * middle_t);
    for (int i = 0; i < 3; ++i) {
        points.centre[i] =
            middle * (frame.axis[i] + middle_s * frame.right[i] + middle_t * frame.down[i]);
    }
    alignas(64) float all_s[kGroup];
    alignas(64) float all_t[kGroup];
    for (int i = 0; i < kGroup; ++i) {
        all_s[i] = grid.s[i % kGroupSide];
        all_t[i] = grid.t[i / kGroupSide];
    }
    V16 farthest = hn::Zero(d);
    for (int i = 0; i < kGroup; i += kLanes) {
        const V16 s = hn::Load(d, all_s + i);
        const V16 t = hn::Load(d, all_t + i);
        const V16 norm = hn::Sqrt(hn::MulAdd(s, s, hn::MulAdd(t, t, set16(1))));
        const V16 unit = hn::Div(set16(1), norm);
        hn::Store(norm, d, length + i);
        const auto offset = [&](int c) {
            const V16 p = hn::MulAdd(s, set16(frame.right[c]),
                                     hn::MulAdd(t, set16(frame.down[c]), set16(frame.axis[c])));
            return hn::MulSub(p, unit, set16(points.centre[c]));
        };
        const V16 x = offset(0);
        const V16 y = offset(1);
        const V16 z = offset(2);
        const V16 square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        farthest = hn::Max(farthest, square);
        hn::Store(hn::Mul(x, set16(scale)), d, points.x + i);
        hn::Store(hn::Mul(y, set16(scale)), d, points.y + i);
        hn::Store(hn::Mul(z, set16(scale)), d, points.z + i);
        hn::Store(hn::Mul(square, set16(0.5F * scale)), d, points.base + i);
    }
    points.radius = std::sqrt(hn::GetLane(hn::MaxOfLanes(d, farthest)));
    return points;
}

struct Light {
    V16 r, g, b;
};

// w to second order in the extent of a node: with v the variance of q,
//
//     <w> = w(q) + w''(q) v / 2 = r ((c0 r - c1) + v r^2 (3 c0 r - c1)),     r = 1 / q.
//
// A node's light is spread evenly in all directions around its mean (it is a small square, or a
// few of them), with half of the moment in each: |N - L|^2 / 2 = 1 - N.L has the variance (moment /
// 2) sin^2, and in terms of q, scale^2 sin^2 = (q - 1) (2 scale + 1 - q).
template <LobeShape kShape>
HWY_INLINE void add_record(const GatherLobe& lobe, const GatherRecord& node, V16 x, V16 y, V16 z,
                           V16 base, Light& sum) {
    const D16 d;
    V16 q = hn::Add(base, set16(node.base));
    q = hn::NegMulAdd(x, set16(node.x), q);
    q = hn::NegMulAdd(y, set16(node.y), q);
    q = hn::NegMulAdd(z, set16(node.z), q);
    V16 weight;
    if constexpr (kShape == LobeShape::kCosine) {
        weight = hn::Max(q, hn::Zero(d));
    } else {
        V16 cosine = hn::NegMulAdd(set16(lobe.c1), q, set16(lobe.c0));
        const V16 sine2 =
            hn::MulAdd(q, hn::Sub(set16(2 * lobe.scale + 2), q), set16(-2 * lobe.scale - 1));
        const V16 variance = hn::Mul(sine2, set16(node.variance));
        const V16 square = hn::MulSub(q, q, variance);
        const V16 estimate = hn::ApproximateReciprocal(square);
        const V16 r = hn::Mul(estimate, hn::NegMulAdd(square, estimate, set16(2)));
        if constexpr (kShape == LobeShape::kWide) {
            cosine =
                hn::MulAdd(hn::Mul(set16(lobe.c1 * (2.0F / 3)), variance), hn::Mul(q, r), cosine);
        }
        weight = hn::Mul(hn::Max(cosine, hn::Zero(d)), r);
    }
    sum.r = hn::MulAdd(weight, set16(node.r), sum.r);
    sum.g = hn::MulAdd(weight, set16(node.g), sum.g);
    sum.b = hn::MulAdd(weight, set16(node.b), sum.b);
}

template <LobeShape kShape>
void add_records(const GatherLobe& lobe, const GatherRecord* nodes, int count,
                 const GroupPoints& points, GroupSums& sums) {
    const D16 d;
    for (int i = 0; i < kGroup; i += kTogether * kLanes) {
        const int j = i + (kTogether - 1) * kLanes;
        Light a = {hn::Load(d, sums.r + i), hn::Load(d, sums.g + i), hn::Load(d, sums.b + i)};
        Light b = {hn::Load(d, sums.r + j), hn::Load(d, sums.g + j), hn::Load(d, sums.b + j)};
        for (int k = 0; k < count; ++k) {
            add_record<kShape>(lobe, nodes[k], hn::Load(d, points.x + i), hn::Load(d, points.y + i),
                               hn::Load(d, points.z + i), hn::Load(d, points.base + i), a);
            if constexpr (kTogether == 2) {
                add_record<kShape>(lobe, nodes[k], hn::Load(d, points.x + j),
                                   hn::Load(d, points.y + j), hn::Load(d, points.z + j),
                                   hn::Load(d, points.base + j), b);
            }
        }
        if constexpr (kTogether == 2) {
            hn::Store(b.r, d, sums.r + j);
            hn::Store(b.g, d, sums.g + j);
            hn::Store(b.b, d, sums.b + j);
        }
        hn::Store(a.r, d, sums.r + i);
        hn::Store(a.g, d, sums.g + i);
        hn::Store(a.b, d, sums.b + i);
    }
}

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
