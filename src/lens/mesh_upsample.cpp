#include "lens/mesh_upsample.h"

#include <cmath>

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_upsample.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// Weights of four vertices between the middle two.
struct Weights {
    float cubic[4];
    float linear[2];
    explicit Weights(float t) : linear{1 - t, t} {
        const float t2 = t * t;
        const float t3 = t2 * t;
        cubic[0] = 0.5F * (2 * t2 - t - t3);
        cubic[1] = 0.5F * (3 * t3 - 5 * t2 + 2);
        cubic[2] = 0.5F * (4 * t2 + t - 3 * t3);
        cubic[3] = 0.5F * (t3 - t2);
    }
};

// One value between rows or columns `step` apart, from the vertex before on.
template <bool kCubic>
HWY_INLINE V between(const float* from, std::ptrdiff_t step, const Weights& w) {
    if constexpr (kCubic) {
        V sum = hn::Mul(set(w.cubic[0]), load(from));
        sum = hn::MulAdd(set(w.cubic[1]), load(from + step), sum);
        sum = hn::MulAdd(set(w.cubic[2]), load(from + 2 * step), sum);
        return hn::MulAdd(set(w.cubic[3]), load(from + 3 * step), sum);
    } else {
        return hn::MulAdd(set(w.linear[0]), load(from + step),
                          hn::Mul(set(w.linear[1]), load(from + 2 * step)));
    }
}

// One row of a field, `count` cells of `factor` vertices each, from a line of values at coarse
// vertices that begins at the vertex before the first cell.
template <bool kCubic>
void refine_row(const float* line, int count, int factor, const Weights* weights, float* to) {
    const D d;
    for (int i = 0; i < count; i += kLanes, to += factor * kLanes) {
        const V first = load(line + i + 1);
        const auto at = [&](int k) { return between<kCubic>(line + i, 1, weights[k]); };
        switch (factor) {
            case 2:
                hn::StoreInterleaved2(first, at(1), d, to);
                break;
            case 3:
                hn::StoreInterleaved3(first, at(1), at(2), d, to);
                break;
            default:
                hn::StoreInterleaved4(first, at(1), at(2), at(3), d, to);
                break;
        }
    }
}

// A field of the mesh; `line` holds a row of `from`.
template <bool kCubic>
void refine_field(const Mesh& from, const float* field, int factor, const Weights* weights,
                  const Mesh& to, float* result, float* line) {
    const D d;
    // Fine row 1 + j * factor is coarse row 1 + j; the rim before it is interpolated between coarse
    // rows 0 and 1, that behind the last cell between the last two.
    for (int row = 0; row < to.rows; ++row) {
        const int at = row - 1 + factor;  // in fine steps, from coarse row 0 on
        const int cell = std::min(at / factor, from.rows - 2);
        const Weights& w = weights[at - cell * factor];
        const bool inner = cell >= 1 && cell + 2 < from.rows;
        for (int i = 0; i < from.stride; i += kLanes) {
            const float* upper = field + cell * from.stride + i;
            const V value = kCubic && inner
                                ? between<true>(upper - from.stride, from.stride, w)
                                : hn::MulAdd(set(w.linear[0]), load(upper),
                                             hn::Mul(set(w.linear[1]), load(upper + from.stride)));
            hn::StoreU(value, d, line + i);
        }
        float* out = result + row * to.stride;
        refine_row<kCubic>(line, from.columns - 3, factor, weights, out + 1);
        // The rim on both sides.
        const auto mixed = [&](int i, float t) { return line[i] + t * (line[i + 1] - line[i]); };
        const float part = 1 - 1 / static_cast<float>(factor);
        out[0] = mixed(0, part);
        out[to.columns - 2] = line[from.columns - 2];
        out[to.columns - 1] = mixed(from.columns - 2, 1 - part);
    }
}

void refine_mesh(const Mesh& from, int factor, Mesh& to) {
    const auto part = [&](int k) {
        return Weights(static_cast<float>(k) / static_cast<float>(factor));
    };
    const Weights at[kMostUpsampling] = {part(0), part(1), part(2), part(3)};
    // Not yet in use at this time.
    float* line = to.share;
    refine_field<true>(from, from.x, factor, at, to, to.x, line);
    refine_field<true>(from, from.y, factor, at, to, to.y, line);
    refine_field<true>(from, from.power, factor, at, to, to.power, line);
    refine_field<false>(from, from.u, factor, at, to, to.u, line);
    refine_field<false>(from, from.v, factor, at, to, to.v, line);
    refine_field<false>(from, from.clip, factor, at, to, to.clip, line);
    // Any share of a lost ray is far above what other rays have, as the smallest weight is 1 / 16.
    const D d;
    const V per_part = set(1 / static_cast<float>(factor * factor));
    for (std::ptrdiff_t k = 0; k < to.stride * to.rows; k += kLanes) {
        const V power = hn::Max(hn::Mul(load(to.power + k), per_part), hn::Zero(d));
        hn::StoreU(power, d, to.power + k);
        const V clip = load(to.clip + k);
        const M lost = hn::Gt(clip, set(2 * kFarthestClip));
        hn::StoreU(hn::IfThenElse(lost, set(kLostRay), clip), d, to.clip + k);
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(refine_mesh);

void upsample(const Mesh& from, int factor, Mesh& to) {
    HWY_DYNAMIC_DISPATCH(refine_mesh)(from, factor, to);
    to.entrance_step_x = from.entrance_step_x / static_cast<float>(factor);
    to.entrance_step_y = from.entrance_step_y / static_cast<float>(factor);
    to.entrance_x = from.entrance_x + from.entrance_step_x - to.entrance_step_x;
    to.entrance_y = from.entrance_y + from.entrance_step_y - to.entrance_step_y;
    for (int row = 0; row < to.rows; ++row) {
        const int parent_row = std::clamp((row - 1 + factor) / factor, 0, from.rows - 1);
        std::uint8_t* states = to.state + static_cast<std::ptrdiff_t>(row) * to.columns;
        const std::uint8_t* parents =
            from.state + static_cast<std::ptrdiff_t>(parent_row) * from.columns;
        // The rim, whole cells, the rim.
        states[0] = parents[0];
        std::uint8_t* state = states + 1;
        for (int cell = 1; cell + 2 < from.columns; ++cell) {
            for (int k = 0; k < factor; ++k) *state++ = parents[cell];
        }
        state[0] = state[1] = parents[from.columns - 2];
    }
}
}  // namespace aureole::lens
#endif
