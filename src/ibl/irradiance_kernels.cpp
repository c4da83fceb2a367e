#include "ibl/irradiance_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/irradiance_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "ibl/cut_texel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

// Over a texel of side k about (s, t), with h = 1 + s^2 + t^2, the integral of L dw is (s, t, 1)
// k^2 h^-2, times what the second-order term of the midpoint rule adds, k^2 / 24 times the
// Laplacian. Its solid angle is k^2 h^(-3/2), which need not be better than that: it only scales
// how wide a cut is. Across the texel N.L changes by +-(N - (N.L) L) (k / 2, 0, 0) / sqrt(h), and
// likewise along t.
void add_block(const IrradianceBlock& block, const float (&normal)[3], double (&rgb)[3]) {
    const D d;
    const V ns = set(normal[0]);
    const V nt = set(normal[1]);
    const V na = set(normal[2]);
    const V half = set(block.side / 2);
    const V area = set(block.side * block.side);
    const V bend = hn::Mul(area, set(1.0F / 24));
    alignas(64) float s_lanes[kTileTexels];
    alignas(64) float t_lanes[kTileTexels];
    for (int i = 0; i < kTileTexels; ++i) {
        s_lanes[i] = block.s + block.side * static_cast<float>(i % kTileSide);
        t_lanes[i] = block.t + block.side * static_cast<float>(i / kTileSide);
    }
    V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (int first = 0; first < kTileTexels; first += kLanes) {
        const V s = hn::Load(d, s_lanes + first);
        const V t = hn::Load(d, t_lanes + first);
        const V r = hn::Div(set(1), hn::MulAdd(s, s, hn::MulAdd(t, t, set(1))));  // 1 / h
        const V length = hn::Sqrt(r);
        const auto bent = [&](float linear, float quadratic) {
            const V laplacian = hn::Mul(r, hn::MulAdd(set(quadratic), r, set(linear)));
            return hn::MulAdd(bend, laplacian, set(1));
        };
        const V across = hn::MulAdd(ns, s, hn::Mul(nt, t));
        const V solid_angle = hn::Mul(area, hn::Mul(r, length));
        const V whole = hn::Mul(hn::Mul(area, hn::Mul(r, r)),
                                hn::MulAdd(across, bent(8, -24), hn::Mul(na, bent(16, -24))));
        const V mu = hn::Div(whole, solid_angle);
        const V step = hn::Mul(half, length);
        const V turn = hn::Mul(mu, length);
        const V along_s = hn::Abs(hn::Mul(step, hn::NegMulAdd(turn, s, ns)));
        const V along_t = hn::Abs(hn::Mul(step, hn::NegMulAdd(turn, t, nt)));
        const V cut = hn::Mul(
            solid_angle, mean_above_zero(mu, hn::Max(along_s, along_t), hn::Min(along_s, along_t)));
        const V weight = hn::IfThenElse(hn::Lt(hn::Abs(mu), hn::Add(along_s, along_t)), cut,
                                        hn::Max(whole, hn::Zero(d)));
        for (int c = 0; c < 3; ++c) {
            sum[c] = hn::MulAdd(weight, hn::Load(d, block.radiance[c] + first), sum[c]);
        }
    }
    for (int c = 0; c < 3; ++c) rgb[c] += hn::GetLane(hn::SumOfLanes(d, sum[c]));
}

}  // namespace

AddIrradianceOfBlock make_add_irradiance_of_block() { return &add_block; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_add_irradiance_of_block);
AddIrradianceOfBlock add_irradiance_of_block() {
    static const AddIrradianceOfBlock kernel = HWY_DYNAMIC_DISPATCH(make_add_irradiance_of_block)();
    return kernel;
}
}  // namespace aureole::ibl
#endif
