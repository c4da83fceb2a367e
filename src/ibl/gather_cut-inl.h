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

// What one group of outputs asks of four nodes.
struct Demands {
    V4 x, y, z;  // from the middle of the group
    V4 base;
    unsigned live = 0;  // not below the horizon of all outputs
    unsigned open = 0;
    unsigned far = 0;  // smooth enough over the group to be interpolated
};

HWY_INLINE unsigned bits(hn::Mask<D4> mask) {
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(D4(), mask, byte);
    return byte[0];
}

template <LobeShape kShape>
HWY_INLINE V4 record_base(const GatherLobe& lobe, V4 square, V4 moment) {
    const V4 away = hn::Mul(set4(0.5F), hn::Add(square, moment));  // 1 - N.L
    if constexpr (kShape == LobeShape::kCosine) return hn::Sub(set4(1), away);
    return hn::MulAdd(set4(lobe.scale), away, set4(1));
}

// Nodes i... of a block, as many as a vector holds.
template <LobeShape kShape>
HWY_INLINE void ask(const GatherLobe& lobe, const GroupPoints& points, const RadianceBlock& block,
                    int i, Demands& out) {
    const D4 d;
    out.x = hn::Sub(hn::Load(d, block.x + i), set4(points.centre[0]));
    out.y = hn::Sub(hn::Load(d, block.y + i), set4(points.centre[1]));
    out.z = hn::Sub(hn::Load(d, block.z + i), set4(points.centre[2]));
    const V4 moment = hn::Load(d, block.moment + i);
    const V4 solid_angle = hn::Load(d, block.solid_angle_sr + i);
    const V4 energy = hn::Abs(
        hn::MulAdd(hn::Load(d, block.r + i), set4(kLuminanceWeights[0]),
                   hn::MulAdd(hn::Load(d, block.g + i), set4(kLuminanceWeights[1]),
                              hn::Mul(hn::Load(d, block.b + i), set4(kLuminanceWeights[2])))));
    const V4 square = hn::MulAdd(out.x, out.x, hn::MulAdd(out.y, out.y, hn::Mul(out.z, out.z)));
    out.base = record_base<kShape>(lobe, square, moment);

    // Below the horizon of the outputs, with all of its area.
    const V4 zero = hn::Zero(d);
    const V4 radius = set4(points.radius);
    const V4 cosine = hn::NegMulAdd(set4(0.5F), hn::Add(square, moment), set4(1));
    const V4 highest = hn::Add(cosine, radius);
    const auto below = hn::And(hn::Lt(highest, zero),
                               hn::Gt(hn::Mul(highest, highest),
                                      hn::Add(solid_angle, solid_angle)));
    const auto live = hn::AndNot(below, hn::Gt(solid_angle, zero));

    const V4 spread = hn::Sqrt(moment);
    const auto horizon =
        hn::Lt(hn::Sub(hn::Abs(cosine), radius), hn::Mul(set4(1.5F), spread));
    auto open = live;
    const float radius2 = points.radius * points.radius;
    const V4 distance2 = hn::Add(square, set4(lobe.pole));
    auto smooth = hn::Ge(distance2, set4(lobe.interpolation * radius2));
    if constexpr (kShape == LobeShape::kCosine) {
        open = hn::And(horizon, hn::Gt(hn::Mul(energy, spread), set4(lobe.most_horizon_error)));
        smooth = hn::AndNot(horizon, smooth);
    } else {
        // At the output that is nearest to it.
        const V4 gap = hn::Max(hn::Sub(hn::Sqrt(square), radius), zero);
        const V4 q = hn::MulAdd(set4(0.5F * lobe.scale), hn::Mul(gap, gap), set4(1));
        const V4 r = hn::Div(set4(1), q);
        const V4 weight = hn::Mul(energy, hn::Mul(r, r));
        const V4 size = hn::Mul(hn::Mul(set4(lobe.scale), solid_angle), r);
        const V4 relative = hn::Mul(hn::Mul(set4(2 * lobe.scale), moment), r);
        const auto wide = hn::Or(hn::Gt(size, set4(lobe.most_spread)),
                                 hn::Gt(relative, set4(lobe.most_relative)));
        const auto wrong = hn::Gt(hn::Mul(weight, hn::Mul(relative, relative)),
                                  set4(lobe.most_error));
        const auto cut = hn::And(
            horizon, hn::Gt(hn::Mul(weight, spread), set4(lobe.most_horizon_error)));
        open = hn::Or(wide, hn::Or(wrong, cut));
        const V4 steep = hn::Mul(distance2, distance2);
        smooth = hn::And(smooth, hn::Lt(hn::Mul(weight, set4(radius2 * radius2)), hn::Mul(steep, set4(lobe.most_interpolation_error))));
        smooth = hn::AndNot(cut, smooth);
    }
    out.live = bits(live);
    out.open = bits(open);
    out.far = bits(smooth);
}

HWY_INLINE void add_rows(V4 x, V4 y, V4 z, V4 base, V4 r, V4 g, V4 b, V4 moment, unsigned nodes,
                         Records& to) {
    const D4 d;
    alignas(64) float place[16];
    alignas(64) float light[16];
    hn::StoreInterleaved4(x, y, z, base, d, place);
    hn::StoreInterleaved4(r, g, b, hn::Mul(set4(1.5F), moment), d, light);
    for (int i = 0; i < kFourLanes; ++i) {
        GatherRecord& record = to.list[to.count];
        const auto d_row = hn::CappedTag<float, 4>();
        for (int j = 0; j < 4; j += kFourLanes) {
            hn::Store(hn::Load(d_row, place + 4 * i + j), d_row, &record.x + j);
            hn::Store(hn::Load(d_row, light + 4 * i + j), d_row, &record.r + j);
        }
        to.count += static_cast<int>(nodes >> i & 1U);
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
    // As in ask(): the neglected part of a node goes as its size to the power of 6, so that of
    // each of four parts of it is a 64th, and of all four a 16th.
    const float dx = block.x[node] - points.centre[0];
    const float dy = block.y[node] - points.centre[1];
    const float dz = block.z[node] - points.centre[2];
    const float gap =
        std::max(0.0F, std::sqrt(dx * dx + dy * dy + dz * dz) - points.radius);
    const float r = 1 / (1 + 0.5F * lobe.scale * gap * gap);
    const float energy = std::abs(kLuminanceWeights[0] * block.r[node] +
                                  kLuminanceWeights[1] * block.g[node] +
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
    } while (splits < kMostSplits && (error > lobe.most_error || size > lobe.most_spread ||
                                      relative > lobe.most_relative));
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
            const V4 x = hn::Sub(p.x, set4(points.centre[0]));
            const V4 y = hn::Sub(p.y, set4(points.centre[1]));
            const V4 z = hn::Sub(p.z, set4(points.centre[2]));
            const V4 square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
            add_rows(x, y, z, record_base<kShape>(lobe, square, p.moment),
                     hn::Mul(part, set4(block.r[node])), hn::Mul(part, set4(block.g[node])),
                     hn::Mul(part, set4(block.b[node])), p.moment, kAllNodes, to);
        }
    }
}

struct CutTask {
    const std::vector<RadianceLevel>& levels;
    const GatherLobe& lobe;
    const GroupPoints& points;
    GatherScratch& scratch;
};

HWY_INLINE void push_children(const Place& place, int level, unsigned nodes, BlockRef* refs,
                              int& count) {
    for (int i = 0; i < 4; ++i) {
        if ((nodes >> i & 1U) == 0) continue;
        const Place child = {place.face, 2 * place.x + i % 2, 2 * place.y + i / 2};
        refs[count++] = {packed(child), static_cast<std::uint16_t>(level - 1), kAllNodes};
    }
}

// Takes blocks from the stack until it is empty. With kDefer, nodes that are too near to be
// interpolated are left in `deferred` to the quarters of the tile; ends early when that is full.
template <LobeShape kShape, bool kDefer>
void cut(const CutTask& task, Stack& stack, Records& records, Stack* deferred) {
    const D4 d;
    const GatherLobe& lobe = task.lobe;
    const GroupPoints& points = task.points;
    const float large = 0.5F * points.radius * points.radius;
    while (stack.count > 0 && !(kDefer && deferred->count == GatherScratch::kDeferred)) {
        const BlockRef ref = stack.refs[--stack.count];
        const Place place = unpacked(ref.place);
        const RadianceLevel& level = task.levels[ref.level];
        const RadianceBlock& block = level.row(place.face, place.y)[place.x];
        task.scratch.visited++;
        make_room<kShape>(lobe, points, 4, records);
        unsigned open = 0;
        unsigned defer = 0;
        for (int i = 0; i < 4; i += kFourLanes) {
            Demands demands;
            ask<kShape>(lobe, points, block, i, demands);
            const unsigned live = demands.live & (ref.nodes >> i);
            unsigned take = live & ~demands.open;
            unsigned apart = live & demands.open;
            if constexpr (kDefer) {
                const unsigned near = live & ~demands.far;
                unsigned big = 0;
                if (ref.level > 0) {
                    big = near & bits(hn::Gt(hn::Load(d, block.solid_angle_sr + i), set4(large)));
                }
                defer |= (near & ~big) << i;
                take &= demands.far;
                apart = (apart & demands.far) | big;
            }
            open |= apart << i;
            if (take != 0) {
                add_rows(demands.x, demands.y, demands.z, demands.base, hn::Load(d, block.r + i),
                         hn::Load(d, block.g + i), hn::Load(d, block.b + i),
                         hn::Load(d, block.moment + i), take, records);
            }
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
