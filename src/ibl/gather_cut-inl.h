// The cut of the tree for a tile: which nodes are taken as a whole. Included once per instruction
// set; see gather_kernels.cpp.
#if defined(AUREOLE_IBL_GATHER_CUT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_IBL_GATHER_CUT_INL_H_
#undef AUREOLE_IBL_GATHER_CUT_INL_H_
#else
#define AUREOLE_IBL_GATHER_CUT_INL_H_
#endif

#include "ibl/gather_sum-inl.h"
#include "ibl/texel_patch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {

inline constexpr unsigned kAllNodes = 0xF;

struct Place {
    int face;
    int x;
    int y;
};

HWY_INLINE std::uint32_t packed(const Place& place) {
    return static_cast<std::uint32_t>(place.face << 28 | place.y << 14 | place.x);
}

HWY_INLINE Place unpacked(std::uint32_t place) {
    return {static_cast<int>(place >> 28), static_cast<int>(place & 0x3FFF),
            static_cast<int>(place >> 14 & 0x3FFF)};
}

// A list of records for one group of outputs.
struct Records {
    GatherRecord* list;
    int count;
    GroupSums* sums;
};

struct Stack {
    BlockRef* refs;
    int count;
};

// Nodes of a block, as many as a vector holds, seen from the middle of a group.
struct Nodes {
    V4 x, y, z;  // from the middle
    V4 square;   // of that distance
    V4 moment;
    V4 r, g, b;
    V4 solid_angle_sr;
    V4 dipole;
};

HWY_INLINE Nodes seen_from(const GroupPoints& points, V4 x, V4 y, V4 z) {
    Nodes nodes;
    nodes.x = hn::Sub(x, set4(points.centre[0]));
    nodes.y = hn::Sub(y, set4(points.centre[1]));
    nodes.z = hn::Sub(z, set4(points.centre[2]));
    nodes.square =
        hn::MulAdd(nodes.x, nodes.x, hn::MulAdd(nodes.y, nodes.y, hn::Mul(nodes.z, nodes.z)));
    return nodes;
}

// `dipoles` are those of the block; none in level 0.
HWY_INLINE Nodes seen_from(const GroupPoints& points, const RadianceBlock& block,
                           const float* dipoles, int i) {
    const D4 d;
    Nodes nodes = seen_from(points, hn::Load(d, block.x + i), hn::Load(d, block.y + i),
                            hn::Load(d, block.z + i));
    nodes.moment = hn::Load(d, block.moment + i);
    nodes.r = hn::Load(d, block.r + i);
    nodes.g = hn::Load(d, block.g + i);
    nodes.b = hn::Load(d, block.b + i);
    nodes.solid_angle_sr = hn::Load(d, block.solid_angle_sr + i);
    nodes.dipole = dipoles == nullptr ? hn::Zero(d) : hn::LoadU(d, dipoles + i);
    return nodes;
}

// What a group of outputs asks of them: a bit each.
struct Demands {
    unsigned live = 0;    // not below the horizon of all outputs
    unsigned open = 0;    // too large or too bright to be taken as a whole
    unsigned smooth = 0;  // their weight may be interpolated over the group
};

HWY_INLINE unsigned bits(hn::Mask<D4> mask) {
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(D4(), mask, byte);
    return byte[0];
}

// The criteria are those of GatherLobe.
template <LobeShape kShape>
HWY_INLINE Demands demands_of(const GatherLobe& lobe, const GroupPoints& points,
                              const Nodes& nodes) {
    const D4 d;
    const V4 moment = nodes.moment;
    const V4 square = nodes.square;
    const V4 energy = hn::Abs(hn::MulAdd(nodes.r, set4(kLuminanceWeights[0]),
                                         hn::MulAdd(nodes.g, set4(kLuminanceWeights[1]),
                                                    hn::Mul(nodes.b, set4(kLuminanceWeights[2])))));

    // Below the horizon of the outputs, with all of its area.
    const V4 zero = hn::Zero(d);
    const V4 radius = set4(points.radius);
    const V4 cosine = hn::NegMulAdd(set4(0.5F), hn::Add(square, moment), set4(1));
    const V4 highest = hn::Add(cosine, radius);
    const auto below = hn::And(
        hn::Lt(highest, zero),
        hn::Gt(hn::Mul(highest, highest), hn::Add(nodes.solid_angle_sr, nodes.solid_angle_sr)));
    const auto live = hn::AndNot(below, hn::Gt(nodes.solid_angle_sr, zero));

    // Light on both sides of the horizon of some output.
    V4 spread = zero;
    auto horizon = hn::Lt(zero, zero);
    if constexpr (kShape != LobeShape::kNarrow) {
        spread = hn::Sqrt(moment);
        horizon = hn::Lt(hn::Sub(hn::Abs(cosine), radius), hn::Mul(set4(1.5F), spread));
    }
    auto open = live;
    const float radius2 = points.radius * points.radius;
    const V4 distance2 = hn::Add(square, set4(lobe.pole));
    auto smooth = hn::Ge(distance2, set4(lobe.least_distance2 * radius2));
    if constexpr (kShape == LobeShape::kCosine) {
        const auto across =
            hn::And(horizon, hn::Gt(hn::Mul(energy, spread), set4(lobe.most_horizon_error)));
        open = hn::Or(across, hn::Gt(nodes.dipole, set4(lobe.most_dipole)));
        smooth = hn::AndNot(horizon, smooth);
    } else {
        // At the output that is nearest to it.
        const V4 gap = hn::Max(hn::Sub(hn::Sqrt(square), radius), zero);
        const V4 q = hn::MulAdd(set4(0.5F * lobe.scale), hn::Mul(gap, gap), set4(1));
        const V4 r = hn::Div(set4(1), q);
        const V4 weight = hn::Mul(energy, hn::Mul(r, r));
        const V4 size = hn::Mul(hn::Mul(set4(lobe.scale), nodes.solid_angle_sr), r);
        const V4 relative = hn::Mul(hn::Mul(set4(2 * lobe.scale), moment), r);
        const auto wide =
            hn::Or(hn::Gt(size, set4(lobe.most_size)), hn::Gt(relative, set4(lobe.most_spread)));
        const auto wrong =
            hn::Gt(hn::Mul(weight, hn::Mul(relative, relative)), set4(lobe.most_error));
        // The slope of 1/q^2 is 2 r^3 scale |N - L|, at most 2 r^2 sqrt(2 scale r).
        const V4 tilt = hn::Mul(nodes.dipole, hn::Mul(r, r));
        const auto colored = hn::Gt(hn::Mul(hn::Mul(tilt, tilt), hn::Mul(set4(8 * lobe.scale), r)),
                                    set4(lobe.most_dipole * lobe.most_dipole));
        open = hn::Or(hn::Or(wide, wrong), colored);
        const V4 steep = hn::Mul(distance2, distance2);
        smooth = hn::And(smooth, hn::Lt(hn::Mul(weight, set4(radius2 * radius2)),
                                        hn::Mul(steep, set4(lobe.most_interpolation_error))));
        if constexpr (kShape == LobeShape::kWide) {
            const auto across =
                hn::And(horizon, hn::Gt(hn::Mul(weight, spread), set4(lobe.most_horizon_error)));
            open = hn::Or(open, across);
            smooth = hn::AndNot(across, smooth);
        }
    }
    return {bits(live), bits(open), bits(smooth)};
}

// Three times the variance of a node's light along the great circle to the middle of the group.
//
// Squares of a face are seen foreshortened. The covariance of a small square in the direction L is,
// in the plane across L, proportional to 1 - k k^T with k the axis of the face, and its trace is
// the moment. So along u, a unit vector in that plane, it is moment (1 - (k.u)^2) / (1 + (L.k)^2).
// For u towards the middle C, k.u = (C.k - (L.k) (C.L)) / sin. Where outputs lie all around the
// node its mean over u counts instead; the change from one to the other is slow, or neighbouring
// groups would differ.
HWY_INLINE V4 three_variances(const GroupPoints& points, int face, const Nodes& nodes) {
    constexpr float kAround = 6;  // in radii^2 of the group
    const float* axis = kFaceFrames[static_cast<std::size_t>(face)].axis;
    const float ck =
        points.centre[0] * axis[0] + points.centre[1] * axis[1] + points.centre[2] * axis[2];
    const V4 one = set4(1);
    const V4 lk = hn::MulAdd(
        nodes.x, set4(axis[0]),
        hn::MulAdd(nodes.y, set4(axis[1]), hn::MulAdd(nodes.z, set4(axis[2]), set4(ck))));
    const V4 lk2 = hn::Mul(lk, lk);
    const V4 away = hn::Mul(set4(0.5F), nodes.square);
    const V4 cosine = hn::Sub(one, away);
    const V4 sine2 = hn::Mul(away, hn::Add(one, cosine));
    const V4 along = hn::NegMulAdd(lk, cosine, set4(ck));
    const V4 around = set4(kAround * points.radius * points.radius);
    const V4 mean = hn::Mul(set4(0.5F), hn::Sub(one, lk2));
    const V4 share =
        hn::Div(hn::MulAdd(along, along, hn::Mul(around, mean)), hn::Add(sine2, around));
    return hn::Div(hn::Mul(hn::Mul(set4(3), nodes.moment), hn::Sub(one, share)), hn::Add(one, lk2));
}

// Appends those nodes whose bit is set.
template <LobeShape kShape>
HWY_INLINE void add_nodes(const GatherLobe& lobe, const GroupPoints& points, int face,
                          const Nodes& nodes, unsigned chosen, Records& to) {
    const D4 d;
    const V4 away = hn::Mul(set4(0.5F), hn::Add(nodes.square, nodes.moment));  // 1 - N.L
    V4 base;
    V4 variance;
    V4 r = nodes.r;
    V4 g = nodes.g;
    V4 b = nodes.b;
    if constexpr (kShape == LobeShape::kCosine) {
        base = hn::Sub(set4(1), away);
        variance = hn::Zero(d);
    } else {
        // What is left of the fourth order is so small that it may be taken from the middle of the
        // group; docs/environment_filtering.md derives the number.
        constexpr float kFourthOrder = 0.5F;
        base = hn::MulAdd(set4(lobe.scale), away, set4(1));
        variance = three_variances(points, face, nodes);
        const V4 spread = hn::Div(hn::Mul(set4(2 * lobe.scale), nodes.moment), base);
        const V4 factor = hn::NegMulAdd(hn::Mul(spread, spread), set4(kFourthOrder), set4(1));
        r = hn::Mul(factor, r);
        g = hn::Mul(factor, g);
        b = hn::Mul(factor, b);
    }
    alignas(64) float place[16];
    alignas(64) float light[16];
    hn::StoreInterleaved4(nodes.x, nodes.y, nodes.z, base, d, place);
    hn::StoreInterleaved4(r, g, b, variance, d, light);
    for (int i = 0; i < kFourLanes; ++i) {
        GatherRecord& record = to.list[to.count];
        for (int j = 0; j < 4; j += kFourLanes) {
            hn::Store(hn::Load(d, place + 4 * i + j), d, &record.x + j);
            hn::Store(hn::Load(d, light + 4 * i + j), d, &record.r + j);
        }
        to.count += static_cast<int>(chosen >> i & 1U);
    }
}

template <LobeShape kShape>
HWY_INLINE void make_room(const GatherLobe& lobe, const GroupPoints& points, int records,
                          Records& list) {
    if (list.count + records <= GatherScratch::kRecords) return;
    add_records<kShape>(lobe, list.list, list.count, points, *list.sums);
    list.count = 0;
}

// A texel that is too large or too bright for its place in the lobe, in parts.
template <LobeShape kShape>
void add_split_texel(const GatherLobe& lobe, const GroupPoints& points, const RadianceBlock& block,
                     int node, const Place& place, int nodes_per_side, Records& to) {
    constexpr int kMostSplits = 4;
    const D4 d;
    // As in demands_of(): the neglected part of a node goes as its size to the power of 6, so that
    // of each of four parts of it is a 64th, and of all four a 16th.
    const float dx = block.x[node] - points.centre[0];
    const float dy = block.y[node] - points.centre[1];
    const float dz = block.z[node] - points.centre[2];
    const float gap = std::max(0.0F, std::sqrt(dx * dx + dy * dy + dz * dz) - points.radius);
    const float r = 1 / (1 + 0.5F * lobe.scale * gap * gap);
    const float energy =
        std::abs(kLuminanceWeights[0] * block.r[node] + kLuminanceWeights[1] * block.g[node] +
                 kLuminanceWeights[2] * block.b[node]);
    float relative = 2 * lobe.scale * block.moment[node] * r;
    float error = energy * r * r * relative * relative;
    float size = lobe.scale * block.solid_angle_sr[node] * r;
    int splits = 0;
    do {
        error /= 16;
        size /= 4;
        relative /= 4;
        ++splits;
    } while (splits < kMostSplits &&
             (error > lobe.most_error || size > lobe.most_size || relative > lobe.most_spread));
    const int parts = 1 << splits;
    const float side = 2 / static_cast<float>(nodes_per_side * parts);
    const int x0 = (2 * place.x + node % 2) * parts;
    const int y0 = (2 * place.y + node / 2) * parts;
    const FaceFrame& frame = kFaceFrames[static_cast<std::size_t>(place.face)];
    const V4 share = set4(1 / block.solid_angle_sr[node]);
    for (int i = 0; i < parts * parts; i += 4) {
        alignas(16) float s[4];
        alignas(16) float t[4];
        for (int j = 0; j < 4; ++j) {
            s[j] = (static_cast<float>(x0 + (i + j) % parts) + 0.5F) * side - 1;
            t[j] = (static_cast<float>(y0 + (i + j) / parts) + 0.5F) * side - 1;
        }
        make_room<kShape>(lobe, points, 4, to);
        for (int j = 0; j < 4; j += kFourLanes) {
            const Patches p = texel_patches(frame, hn::Load(d, s + j), hn::Load(d, t + j), side);
            const V4 part = hn::Mul(share, p.solid_angle_sr);
            Nodes nodes = seen_from(points, p.x, p.y, p.z);
            nodes.moment = p.moment;
            nodes.r = hn::Mul(part, set4(block.r[node]));
            nodes.g = hn::Mul(part, set4(block.g[node]));
            nodes.b = hn::Mul(part, set4(block.b[node]));
            add_nodes<kShape>(lobe, points, place.face, nodes, kAllNodes, to);
        }
    }
}

struct CutTask {
    const std::vector<RadianceLevel>& levels;
    const GatherLobe& lobe;
    const GroupPoints& points;
};

HWY_INLINE void push_children(const Place& place, int level, unsigned nodes, BlockRef* refs,
                              int& count) {
    const std::uint32_t first = packed({place.face, 2 * place.x, 2 * place.y});
    const auto below = static_cast<std::uint16_t>(level - 1);
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t child = first + packed({0, i % 2, i / 2});
        refs[count] = {child, below, kAllNodes};
        count += static_cast<int>(nodes >> i & 1U);
    }
}

// Takes blocks from the stack until it is empty. With kDefer, nodes that are too near to be
// interpolated are left in `deferred` to the quarters of the tile; ends early when that is full.
template <LobeShape kShape, bool kDefer>
void cut(const CutTask& task, Stack& stack, Records& records, Stack* deferred) {
    const GatherLobe& lobe = task.lobe;
    const GroupPoints& points = task.points;
    const float large = 0.5F * points.radius * points.radius;
    while (stack.count > 0 && !(kDefer && deferred->count == GatherScratch::kDeferred)) {
        const BlockRef ref = stack.refs[--stack.count];
        const Place place = unpacked(ref.place);
        const RadianceLevel& level = task.levels[ref.level];
        const RadianceBlock& block = level.row(place.face, place.y)[place.x];
        const float* const dipoles =
            ref.level == 0 ? nullptr : level.dipole_row(place.face, place.y) + 4 * place.x;
        make_room<kShape>(lobe, points, 4, records);
        unsigned open = 0;
        unsigned defer = 0;
        for (int i = 0; i < 4; i += kFourLanes) {
            const Nodes nodes = seen_from(points, block, dipoles, i);
            const Demands demands = demands_of<kShape>(lobe, points, nodes);
            const unsigned live = demands.live & (ref.nodes >> i);
            unsigned take = live & ~demands.open;
            unsigned apart = live & demands.open;
            if constexpr (kDefer) {
                const unsigned near = live & ~demands.smooth;
                unsigned big = 0;
                if (ref.level > 0) big = near & bits(hn::Gt(nodes.solid_angle_sr, set4(large)));
                defer |= (near & ~big) << i;
                take &= demands.smooth;
                apart = (apart & demands.smooth) | big;
            }
            open |= apart << i;
            if (take != 0) add_nodes<kShape>(lobe, points, place.face, nodes, take, records);
        }
        if (open != 0) {
            if (ref.level > 0) {
                push_children(place, ref.level, open, stack.refs, stack.count);
            } else {
                for (int i = 0; i < 4; ++i) {
                    if ((open >> i & 1U) == 0) continue;
                    add_split_texel<kShape>(lobe, points, block, i, place, level.nodes_per_side,
                                            records);
                }
            }
        }
        if (kDefer && defer != 0) {
            deferred->refs[deferred->count++] = {ref.place, ref.level,
                                                 static_cast<std::uint16_t>(defer)};
        }
    }
}

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
