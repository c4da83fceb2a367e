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

void add_block(const IrradianceBlock& block, const float (&radiance)[3][kTileTexels],
               const float (&normal)[3], double (&rgb)[3]) {
    const D d;
    const V n[3] = {set(normal[0]), set(normal[1]), set(normal[2])};
    V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (int first = 0; first < kTileTexels; first += kLanes) {
        const auto along_normal = [&](const float(&vectors)[3][kTileTexels]) {
            return hn::MulAdd(n[0], hn::Load(d, vectors[0] + first),
                              hn::MulAdd(n[1], hn::Load(d, vectors[1] + first),
                                         hn::Mul(n[2], hn::Load(d, vectors[2] + first))));
        };
        const V mu = along_normal(block.mean);
        const V s = hn::Abs(along_normal(block.along_s));
        const V t = hn::Abs(along_normal(block.along_t));
        const V is_cut_below = hn::Add(s, t);
        const V cut = mean_above_zero(mu, hn::Max(s, t), hn::Min(s, t));
        const V whole = hn::Max(mu, hn::Zero(d));
        const V mean = hn::IfThenElse(hn::Lt(hn::Abs(mu), is_cut_below), cut, whole);
        const V weight = hn::Mul(mean, hn::Load(d, block.solid_angle_sr + first));
        for (int c = 0; c < 3; ++c) {
            sum[c] = hn::MulAdd(weight, hn::Load(d, radiance[c] + first), sum[c]);
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
