#include "ibl/radiance_kernels.h"

#include "ibl/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ibl/radiance_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "ibl/texel_patch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {
namespace {

// The four leaves of a block, three channels.
struct Texels {
    alignas(16) float value[3][4];
};

RowLight make_leaves(const CubeMap& environment, int subdivision, int face, int y, int nodes,
                     RadianceBlock* row) {
    const D4 d;
    const float side = 2 / static_cast<float>(nodes);
    const FaceFrame& frame = kFaceFrames[static_cast<std::size_t>(face)];
    const int y0 = 2 * y;
    const int y1 = 2 * y + 1 < nodes ? 2 * y + 1 : y0;
    const float* rows[2][3];
    for (int c = 0; c < 3; ++c) {
        rows[0][c] = environment.row(face, y0 / subdivision, c);
        rows[1][c] = environment.row(face, y1 / subdivision, c);
    }
    const auto centre = [side](int i) { return (static_cast<float>(i) + 0.5F) * side - 1; };
    alignas(16) float s[4];
    alignas(16) const float t[4] = {centre(y0), centre(y0), centre(y0 + 1), centre(y0 + 1)};
    V4 light[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (int block = 0; 2 * block < nodes; ++block) {
        const int x0 = 2 * block;
        const int x1 = x0 + 1 < nodes ? x0 + 1 : x0;
        const int from0 = subdivision == 1 ? x0 : x0 / subdivision;
        const int from1 = subdivision == 1 ? x1 : x1 / subdivision;
        Texels texels;
        for (int c = 0; c < 3; ++c) {
            texels.value[c][0] = rows[0][c][from0];
            texels.value[c][1] = rows[0][c][from1];
            texels.value[c][2] = rows[1][c][from0];
            texels.value[c][3] = rows[1][c][from1];
        }
        s[0] = s[2] = centre(x0);
        s[1] = s[3] = centre(x0 + 1);
        RadianceBlock& out = row[block];
        for (int i = 0; i < 4; i += kFourLanes) {
            const Patches p = texel_patches(frame, hn::Load(d, s + i), hn::Load(d, t + i), side);
            hn::Store(p.x, d, out.x + i);
            hn::Store(p.y, d, out.y + i);
            hn::Store(p.z, d, out.z + i);
            hn::Store(p.moment, d, out.moment + i);
            hn::Store(p.solid_angle_sr, d, out.solid_angle_sr + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[0] + i)), d, out.r + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[1] + i)), d, out.g + i);
            hn::Store(hn::Mul(p.solid_angle_sr, hn::Load(d, texels.value[2] + i)), d, out.b + i);
        }
        for (int i = 0; i < 4; ++i) {
            if (x0 + i % 2 < nodes && y0 + i / 2 < nodes) continue;
            out.r[i] = out.g[i] = out.b[i] = out.solid_angle_sr[i] = 0;
        }
        for (int i = 0; i < 4; i += kFourLanes) {
            light[0] = hn::Add(light[0], hn::Abs(hn::Load(d, out.r + i)));
            light[1] = hn::Add(light[1], hn::Abs(hn::Load(d, out.g + i)));
            light[2] = hn::Add(light[2], hn::Abs(hn::Load(d, out.b + i)));
        }
    }
    return {hn::GetLane(hn::SumOfLanes(d, light[0])), hn::GetLane(hn::SumOfLanes(d, light[1])),
            hn::GetLane(hn::SumOfLanes(d, light[2]))};
}

}  // namespace

RadianceKernels make_radiance_kernels() { return {&make_leaves}; }

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::ibl {
HWY_EXPORT(make_radiance_kernels);
const RadianceKernels& radiance_kernels() {
    static const RadianceKernels kernels = HWY_DYNAMIC_DISPATCH(make_radiance_kernels)();
    return kernels;
}
}  // namespace aureole::ibl
#endif
