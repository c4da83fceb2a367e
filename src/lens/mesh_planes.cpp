#include "lens/mesh_planes.h"

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/mesh_planes.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/mesh_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

void flush(float* sums, int count, const float weight[3], float* const planes[3]) {
    const D d;
    const V r = set(weight[0]);
    const V g = set(weight[1]);
    const V b = set(weight[2]);
    int x = 0;
    for (; x + kLanes <= count; x += kLanes) {
        const V sum = load(sums + x);
        hn::StoreU(hn::MulAdd(r, sum, load(planes[0] + x)), d, planes[0] + x);
        hn::StoreU(hn::MulAdd(g, sum, load(planes[1] + x)), d, planes[1] + x);
        hn::StoreU(hn::MulAdd(b, sum, load(planes[2] + x)), d, planes[2] + x);
        hn::StoreU(hn::Zero(d), d, sums + x);
    }
    for (; x < count; ++x) {
        for (int c = 0; c < 3; ++c) planes[c][x] += weight[c] * sums[x];
        sums[x] = 0;
    }
}

void blur(const float* from, const float* weights, int taps, int count, float* to) {
    const D d;
    int x = 0;
    for (; x + 4 * kLanes <= count; x += 4 * kLanes) {
        V sum[4];
        for (int k = 0; k < 4; ++k) sum[k] = load(to + x + k * kLanes);
        for (int t = 0; t < taps; ++t) {
            const V w = set(weights[t]);
            for (int k = 0; k < 4; ++k) {
                sum[k] = hn::MulAdd(w, load(from + x + t + k * kLanes), sum[k]);
            }
        }
        for (int k = 0; k < 4; ++k) hn::StoreU(sum[k], d, to + x + k * kLanes);
    }
    for (; x < count; ++x) {
        for (int t = 0; t < taps; ++t) to[x] += weights[t] * from[x + t];
    }
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(flush);
HWY_EXPORT(blur);
void flush_row(float* sums, int count, const float weight[3], float* const planes[3]) {
    HWY_DYNAMIC_DISPATCH(flush)(sums, count, weight, planes);
}
void blur_row(const float* from, const float* weights, int taps, int count, float* to) {
    HWY_DYNAMIC_DISPATCH(blur)(from, weights, taps, count, to);
}
}  // namespace aureole::lens
#endif
