// Two stages. The first one works in lanes: it finds where on the cube directions point, lane by
// lane, and notes the four texels around and how much of each to take. The second one goes through
// these notes and adds the texels up: RGB0 of two neighbours at a time, which one load fetches.
#include "ibl/sampling_kernels.h"

#include <algorithm>
#include <cmath>

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/sampling_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
// Notes of one block of samples stay in the first cache.
constexpr int kNotes = 512;

V set(float value) { return hn::Set(D(), value); }

// Four texels: number and weight of the left ones, what is right of them, and the share of that.
struct Notes {
    alignas(64) std::int32_t texel[kNotes];
    alignas(64) std::int32_t stride[kNotes];
    alignas(64) float right[kNotes];
    alignas(64) float top[kNotes];
    alignas(64) float bottom[kNotes];
};

struct Vector3 {
    V x, y, z;
};

// Tangents and normal, as the document has them: for each texel one frame, which only depends on
// the normal.
struct Frame {
    Vector3 tangent, bitangent, normal;
};

HWY_INLINE Vector3 in_world(const Frame& frame, V x, V y, V z) {
    const auto mix = [&](V a, V b, V c) {
        return hn::MulAdd(x, a, hn::MulAdd(y, b, hn::Mul(z, c)));
    };
    return {mix(frame.tangent.x, frame.bitangent.x, frame.normal.x),
            mix(frame.tangent.y, frame.bitangent.y, frame.normal.y),
            mix(frame.tangent.z, frame.bitangent.z, frame.normal.z)};
}

HWY_INLINE Frame frame_about(const Vector3& n) {
    const D d;
    // cross((0, 0, 1), n), or near the poles cross((1, 0, 0), n).
    const M usual = hn::Lt(hn::Abs(n.z), set(0.999F));
    Vector3 t = {hn::IfThenElse(usual, hn::Neg(n.y), hn::Zero(d)),
                 hn::IfThenElse(usual, n.x, hn::Neg(n.z)), hn::IfThenElse(usual, hn::Zero(d), n.y)};
    const V scale =
        hn::Div(set(1), hn::Sqrt(hn::MulAdd(t.x, t.x, hn::MulAdd(t.y, t.y, hn::Mul(t.z, t.z)))));
    t = {hn::Mul(t.x, scale), hn::Mul(t.y, scale), hn::Mul(t.z, scale)};
    const Vector3 b = {hn::MulSub(n.y, t.z, hn::Mul(n.z, t.y)),
                       hn::MulSub(n.z, t.x, hn::Mul(n.x, t.z)),
                       hn::MulSub(n.x, t.y, hn::Mul(n.y, t.x))};
    return {t, b, n};
}

// The direction of each texel of a tile, padded with the last one to whole vectors.
struct TileNormals {
    int count = 0;
    alignas(64) float x[kTileTexels + kLanes];
    alignas(64) float y[kTileTexels + kLanes];
    alignas(64) float z[kTileTexels + kLanes];
};

void find_normals(const Tile& tile, int size, TileNormals& normals) {
    normals.count = tile.width * tile.height;
    // direction_of() before it is normalised is linear in s and t.
    const Direction middle = direction_of({tile.face, 0, 0});
    const auto axis = [&](double s, double t) {
        const Direction at = direction_of({tile.face, s, t});
        const double length = 1 / dot(at, middle);
        return Direction{at.x * length - middle.x, at.y * length - middle.y,
                         at.z * length - middle.z};
    };
    const Direction along_s = axis(1, 0);
    const Direction along_t = axis(0, 1);
    for (int i = 0; i < normals.count + kLanes - 1; ++i) {
        const int texel = std::min(i, normals.count - 1);
        const double s = (2.0 * (tile.x + texel % tile.width) + 1) / size - 1;
        const double t = (2.0 * (tile.y + texel / tile.width) + 1) / size - 1;
        const double scale = 1 / std::sqrt(1 + s * s + t * t);
        normals.x[i] = static_cast<float>((middle.x + s * along_s.x + t * along_t.x) * scale);
        normals.y[i] = static_cast<float>((middle.y + s * along_s.y + t * along_t.y) * scale);
        normals.z[i] = static_cast<float>((middle.z + s * along_s.z + t * along_t.z) * scale);
    }
}

// Where on the cube: s and t in [-1, 1], as cube_point_of().
struct Place {
    VI face;
    V s, t;
};

HWY_INLINE Place place_of(const Vector3& direction) {
    const DI di;
    const auto [x, y, z] = direction;
    const V ax = hn::Abs(x);
    const V ay = hn::Abs(y);
    const V az = hn::Abs(z);
    const M on_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const M on_y = hn::AndNot(on_x, hn::Ge(ay, az));
    const V axis = hn::IfThenElse(on_x, x, hn::IfThenElse(on_y, y, z));
    const V sign = hn::And(axis, hn::SignBit(D()));
    const V scale = hn::Div(set(1), hn::Abs(axis));
    // +X: -z, -X: z; +Y, -Y: x; +Z: x, -Z: -x.
    const V s =
        hn::IfThenElse(on_x, hn::Neg(hn::Xor(z, sign)), hn::IfThenElse(on_y, x, hn::Xor(x, sign)));
    // +Y: z, -Y: -z; the others: -y.
    const V t = hn::IfThenElse(on_y, hn::Xor(z, sign), hn::Neg(y));
    const VI pair =
        hn::IfThenElse(hn::RebindMask(di, on_x), hn::Zero(di),
                       hn::IfThenElse(hn::RebindMask(di, on_y), hn::Set(di, 2), hn::Set(di, 4)));
    const VI negative = hn::ShiftRight<31>(hn::BitCast(di, axis));  // -1 or 0
    return {hn::Sub(pair, negative), hn::Mul(s, scale), hn::Mul(t, scale)};
}

// Sizes and strides of the level of each lane.
struct LaneLevel {
    V half_size;
    VI first, stride, face_stride;
};

HWY_INLINE LaneLevel lane_level(const BorderedLevel& level) {
    const DI di;
    return {set(static_cast<float>(level.size) / 2),
            hn::Set(di, static_cast<std::int32_t>(level.first)),
            hn::Set(di, static_cast<std::int32_t>(level.stride)),
            hn::Set(di, static_cast<std::int32_t>(level.face_stride))};
}

// The four texels around a place.
struct Four {
    VI texel, stride;
    V right, top, bottom;
};

HWY_INLINE Four four_around(const Place& place, const LaneLevel& level, V weight) {
    const DI di;
    // In texels of the bordered face, from the centre of its first one: in [1/2, size + 1/2].
    const V half = set(0.5F);
    const V x = hn::MulAdd(place.s, level.half_size, hn::Add(level.half_size, half));
    const V y = hn::MulAdd(place.t, level.half_size, hn::Add(level.half_size, half));
    const VI column = hn::ConvertTo(di, x);
    const VI row = hn::ConvertTo(di, y);
    Four four;
    four.texel =
        hn::Add(hn::Add(level.first, column),
                hn::Add(hn::Mul(place.face, level.face_stride), hn::Mul(row, level.stride)));
    four.stride = level.stride;
    four.right = hn::Sub(x, hn::ConvertTo(D(), column));
    four.bottom = hn::Mul(weight, hn::Sub(y, hn::ConvertTo(D(), row)));
    four.top = hn::Sub(weight, four.bottom);
    return four;
}

HWY_INLINE void note(const Four& four, Notes& notes, int at) {
    const D d;
    const DI di;
    hn::StoreU(four.texel, di, notes.texel + at);
    hn::StoreU(four.stride, di, notes.stride + at);
    hn::StoreU(four.right, d, notes.right + at);
    hn::StoreU(four.top, d, notes.top + at);
    hn::StoreU(four.bottom, d, notes.bottom + at);
}

// The same without the lanes outside of `kept`; how many were kept. Mostly it is all or none.
HWY_INLINE int note_some(const Four& four, M kept, Notes& notes, int at) {
    const D d;
    const auto kept_i = hn::RebindMask(DI(), kept);
    if (hn::AllFalse(d, kept)) return 0;
    if (hn::AllTrue(d, kept)) {
        note(four, notes, at);
        return kLanes;
    }
    // CompressStore would write kept lanes only, by masked stores that are many times slower on
    // some machines; there is room for all.
    note({hn::Compress(four.texel, kept_i), hn::Compress(four.stride, kept_i),
          hn::Compress(four.right, kept), hn::Compress(four.top, kept),
          hn::Compress(four.bottom, kept)},
         notes, at);
    return static_cast<int>(hn::CountTrue(d, kept));
}

// Left texel in the lower half, right one in the upper; or both in turn where vectors are short,
// or channel by channel where there are none.
using DT = hn::CappedTag<float, 2 * kTexelFloats>;
using VT = hn::Vec<DT>;
constexpr int kWide = static_cast<int>(hn::MaxLanes(DT()));
constexpr bool kPairs = kWide == 2 * kTexelFloats;
constexpr int kParts = kPairs ? 1 : kTexelFloats / kWide;

struct Sum {
    VT parts[kParts];
};

HWY_INLINE void clear(Sum& sum) {
    for (VT& part : sum.parts) part = hn::Zero(DT());
}

// Adds every `step`th note from `first` to `end`.
HWY_INLINE void add_notes(const float* texels, const Notes& notes, int first, int end, int step,
                          Sum& to) {
    const DT d;
    alignas(32) constexpr float kSlope[] = {-1, -1, -1, -1, 1, 1, 1, 1};
    alignas(32) constexpr float kStart[] = {1, 1, 1, 1, 0, 0, 0, 0};
    const VT slope = hn::Load(d, kSlope);
    const VT start = hn::Load(d, kStart);
    Sum sum = to;
    for (int i = first; i < end; i += step) {
        const float* top =
            texels + std::size_t{kTexelFloats} * static_cast<std::uint32_t>(notes.texel[i]);
        const float* bottom =
            top + std::size_t{kTexelFloats} * static_cast<std::uint32_t>(notes.stride[i]);
        const VT right = hn::Set(d, notes.right[i]);
        const VT left_or_right = hn::MulAdd(right, slope, start);
        const VT weight_top = hn::Set(d, notes.top[i]);
        const VT weight_bottom = hn::Set(d, notes.bottom[i]);
        for (int part = 0; part < kParts; ++part) {
            const auto column = [&](int at) {
                return hn::MulAdd(hn::LoadU(d, bottom + at), weight_bottom,
                                  hn::Mul(hn::LoadU(d, top + at), weight_top));
            };
            VT& in = sum.parts[part];
            in = hn::MulAdd(column(part * kWide), left_or_right, in);
            if constexpr (!kPairs) {
                in = hn::MulAdd(column(kTexelFloats + part * kWide), right, in);
            }
        }
    }
    to = sum;
}

HWY_INLINE void store_sum(const Sum& sum, float scale, float* to) {
    alignas(32) float parts[2 * kTexelFloats] = {};
    for (int part = 0; part < kParts; ++part) {
        hn::Store(sum.parts[part], DT(), parts + part * kWide);
    }
    for (int c = 0; c < kTexelFloats; ++c) to[c] = scale * (parts[c] + parts[kTexelFloats + c]);
}

void sum_taps(const BorderedChain& chain, std::span<const LobeTap> taps, const Tile& tile, int size,
              TileColors& out) {
    const D d;
    TileNormals normals;
    find_normals(tile, size, normals);
    Notes notes;
    Sum sums[kLanes];
    for (int first = 0; first < normals.count; first += kLanes) {
        const Frame frame =
            frame_about({hn::LoadU(d, normals.x + first), hn::LoadU(d, normals.y + first),
                         hn::LoadU(d, normals.z + first)});
        const int used = std::min(kLanes, normals.count - first);
        for (Sum& sum : sums) clear(sum);
        int noted = 0;
        const auto add_up = [&] {
            for (int lane = 0; lane < used; ++lane) {
                add_notes(chain.texels(), notes, lane, noted, kLanes, sums[lane]);
            }
            noted = 0;
        };
        for (const LobeTap& tap : taps) {
            const Place place = place_of(in_world(frame, set(tap.x), set(tap.y), set(tap.z)));
            const BorderedLevel* level = &chain.levels()[static_cast<std::size_t>(tap.level)];
            note(four_around(place, lane_level(level[0]), set(tap.weights[0])), notes, noted);
            noted += kLanes;
            if (tap.weights[1] > 0) {
                note(four_around(place, lane_level(level[1]), set(tap.weights[1])), notes, noted);
                noted += kLanes;
            }
            if (noted > kNotes - 2 * kLanes) add_up();
        }
        add_up();
        for (int lane = 0; lane < used; ++lane) {
            store_sum(sums[lane], 1, out.rgb[first + lane]);
        }
    }
}

// Hammersley (i / count, radical inverse of i).
HWY_INLINE void hammersley_points(VI index, V per_count, V& x, V& y) {
    const DI di;
    const hn::RebindToUnsigned<DI> du;
    x = hn::Mul(hn::ConvertTo(D(), index), per_count);
    auto bits = hn::BitCast(du, index);
    const auto swap = [&](auto a, auto b, std::uint32_t mask) {
        const auto m = hn::Set(du, mask);
        return hn::Or(hn::And(a, m), hn::AndNot(m, b));
    };
    bits = hn::Or(hn::ShiftLeft<16>(bits), hn::ShiftRight<16>(bits));
    bits = swap(hn::ShiftRight<8>(bits), hn::ShiftLeft<8>(bits), 0x00FF00FFU);
    bits = swap(hn::ShiftRight<4>(bits), hn::ShiftLeft<4>(bits), 0x0F0F0F0FU);
    bits = swap(hn::ShiftRight<2>(bits), hn::ShiftLeft<2>(bits), 0x33333333U);
    bits = swap(hn::ShiftRight<1>(bits), hn::ShiftLeft<1>(bits), 0x55555555U);
    y = hn::Mul(hn::ConvertTo(D(), hn::BitCast(di, hn::ShiftRight<8>(bits))), set(0x1p-24F));
}

// ImportanceSampleGGX: the half vector about +Z; its sine^2 as alpha^2 times a quotient, which
// keeps the digits of small angles.
struct Half {
    V x, y, cosine, sine2;
};

HWY_INLINE Half half_vector(V xi_x, V xi_y, V alpha2) {
    const D d;
    const V y_rest = hn::Div(xi_y, hn::NegMulAdd(hn::Sub(set(1), alpha2), xi_y, set(1)));
    Half half;
    half.sine2 = hn::Mul(alpha2, y_rest);
    half.cosine = hn::Sqrt(hn::Max(hn::Sub(set(1), half.sine2), hn::Zero(d)));
    const V sine = hn::Sqrt(half.sine2);
    const V phi = hn::Mul(set(6.28318530717958648F), xi_x);
    half.x = hn::Mul(sine, hn::Cos(d, phi));
    half.y = hn::Mul(sine, hn::Sin(d, phi));
    return half;
}

// Solid angles and levels of FIS.
HWY_INLINE V filtered_level(const Half& half, V alpha2, V samples, V offset, V last) {
    const D d;
    // D (N.H) / (4 V.H) with V = N; D = a^2 / (pi (sin^2 + a^2 cos^2)^2).
    const V q = hn::MulAdd(alpha2, hn::Mul(half.cosine, half.cosine), half.sine2);
    const V density_d = hn::Div(alpha2, hn::Mul(set(3.14159265358979324F), hn::Mul(q, q)));
    const V density = hn::Div(hn::Mul(density_d, half.cosine), hn::Mul(set(4), half.cosine));
    const V sample_sr = hn::Div(set(1), hn::Mul(samples, density));
    const V level = hn::Mul(set(0.5F), hn::Add(hn::Log2(d, sample_sr), offset));
    return hn::Min(hn::Max(level, hn::Zero(d)), last);
}

void run_loop(const BorderedChain& chain, const LobeLoop& loop, const Tile& tile, int size,
              TileColors& out) {
    const D d;
    const DI di;
    TileNormals normals;
    find_normals(tile, size, normals);
    // Levels as lanes look them up.
    constexpr int kMostLevels = 16;
    const int levels = static_cast<int>(chain.levels().size());
    float half_sizes[kMostLevels + 1];
    std::int32_t firsts[kMostLevels + 1];
    for (int k = 0; k <= levels; ++k) {
        const BorderedLevel& level =
            chain.levels()[static_cast<std::size_t>(std::min(k, levels - 1))];
        half_sizes[k] = static_cast<float>(level.size) / 2;
        firsts[k] = static_cast<std::int32_t>(level.first);
    }
    const auto level_of = [&](VI index) {
        LaneLevel level;
        level.half_size = hn::GatherIndex(d, half_sizes, index);
        level.first = hn::GatherIndex(di, firsts, index);
        level.stride = hn::ConvertTo(di, hn::MulAdd(set(2), level.half_size, set(2)));
        level.face_stride = hn::Mul(level.stride, level.stride);
        return level;
    };
    const LaneLevel base = lane_level(chain.levels()[0]);
    const V alpha2 = set(loop.alpha * loop.alpha);
    const V samples = set(static_cast<float>(loop.samples));
    const V per_sample = hn::Div(set(1), samples);
    const V last_level = set(static_cast<float>(levels - 1));

    Notes notes;
    for (int texel = 0; texel < normals.count; ++texel) {
        const Frame frame =
            frame_about({set(normals.x[texel]), set(normals.y[texel]), set(normals.z[texel])});
        Sum sum;
        clear(sum);
        V weight_sum = hn::Zero(d);
        int noted = 0;
        const auto add_up = [&] {
            add_notes(chain.texels(), notes, 0, noted, 1, sum);
            noted = 0;
        };
        for (int first = 0; first < loop.samples; first += kLanes) {
            const VI index = hn::Iota(di, first);
            V xi_x;
            V xi_y;
            hammersley_points(index, per_sample, xi_x, xi_y);
            const Half half = half_vector(xi_x, xi_y, alpha2);
            const Vector3 h = in_world(frame, half.x, half.y, half.cosine);
            // L = 2 (V.H) H - V.
            const Vector3& n = frame.normal;
            const V twice = hn::Mul(set(2), half.cosine);
            const Vector3 light = {hn::MulSub(twice, h.x, n.x), hn::MulSub(twice, h.y, n.y),
                                   hn::MulSub(twice, h.z, n.z)};
            const V cosine =
                hn::MulAdd(n.x, light.x, hn::MulAdd(n.y, light.y, hn::Mul(n.z, light.z)));
            const M valid = hn::And(hn::Gt(cosine, hn::Zero(d)),
                                    hn::RebindMask(d, hn::Lt(index, hn::Set(di, loop.samples))));
            weight_sum = hn::Add(weight_sum, hn::IfThenElseZero(valid, cosine));
            const Place place = place_of(light);
            if (loop.filtered) {
                const V level =
                    filtered_level(half, alpha2, samples, set(loop.level_offset), last_level);
                const VI finer = hn::ConvertTo(di, level);
                const V to_coarser = hn::Mul(cosine, hn::Sub(level, hn::ConvertTo(d, finer)));
                noted += note_some(four_around(place, level_of(finer), hn::Sub(cosine, to_coarser)),
                                   valid, notes, noted);
                noted += note_some(
                    four_around(place, level_of(hn::Add(finer, hn::Set(di, 1))), to_coarser),
                    hn::And(valid, hn::Gt(to_coarser, hn::Zero(d))), notes, noted);
            } else {
                noted += note_some(four_around(place, base, cosine), valid, notes, noted);
            }
            if (noted > kNotes - 2 * kLanes) add_up();
        }
        add_up();
        const float weights = hn::GetLane(hn::SumOfLanes(d, weight_sum));
        store_sum(sum, 1 / weights, out.rgb[texel]);
    }
}

}  // namespace

SamplingKernels make_sampling_kernels() { return {&sum_taps, &run_loop}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_sampling_kernels);
SamplingKernels sampling_kernels() { return HWY_DYNAMIC_DISPATCH(make_sampling_kernels)(); }
}  // namespace aureole::ibl
#endif
