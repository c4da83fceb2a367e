// Small squares of a cube face seen from its middle, several at once. Included once per instruction
// set; see radiance_kernels.cpp.
#if defined(AUREOLE_IBL_TEXEL_PATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_IBL_TEXEL_PATCH_INL_H_
#undef AUREOLE_IBL_TEXEL_PATCH_INL_H_
#else
#define AUREOLE_IBL_TEXEL_PATCH_INL_H_
#endif

#include <hwy/highway.h>

#include "ibl/face_frame.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::ibl::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Up to four at once; blocks of four nodes are done in 4 / kFourLanes steps.
using D4 = hn::CappedTag<float, 4>;
using V4 = hn::Vec<D4>;
inline constexpr int kFourLanes = static_cast<int>(hn::MaxLanes(D4()));

HWY_INLINE V4 set4(float value) { return hn::Set(D4(), value); }

struct Patches {
    V4 x, y, z;  // mean direction, not normalised
    V4 moment;   // 1 - |mean|^2
    V4 solid_angle_sr;
};

// Squares of side `side` around (s, t). With h = 1 + s^2 + t^2, P = (s, t, 1) in the face's own
// axes, solid angle has the density h^(-3/2), and its first moment P h^(-2). Their means over the
// square are, to fourth order in the side, the values in the middle plus side^2 / 24 times their
// Laplacians, h^(-7/2) (9 h - 15) and P h^(-4) (8 h - 24) + 8 h^(-3) axis. The moment follows from
// the metric of the projection, whose trace is (h + 1) / h^2.
HWY_INLINE Patches texel_patches(const FaceFrame& frame, V4 s, V4 t, float side) {
    const V4 one = set4(1);
    const V4 curve = set4(side * side / 24);
    const V4 h = hn::MulAdd(s, s, hn::MulAdd(t, t, one));
    const V4 ih = hn::Div(one, h);
    const V4 root = hn::Sqrt(ih);
    const V4 curve_ih2 = hn::Mul(curve, hn::Mul(ih, ih));
    const V4 density = hn::MulAdd(curve_ih2, hn::MulSub(set4(9), h, set4(15)), one);
    const V4 scale = hn::Div(root, density);
    const V4 along = hn::Mul(scale, hn::MulAdd(curve_ih2, hn::MulSub(set4(8), h, set4(24)), one));
    const V4 inwards = hn::Mul(hn::Mul(scale, curve), hn::Mul(set4(8), ih));
    const V4 on_axis = hn::Add(along, inwards);
    const V4 along_s = hn::Mul(along, s);
    const V4 along_t = hn::Mul(along, t);
    const auto component = [&](int i) {
        return hn::MulAdd(
            on_axis, set4(frame.axis[i]),
            hn::MulAdd(along_s, set4(frame.right[i]), hn::Mul(along_t, set4(frame.down[i]))));
    };
    Patches patches;
    patches.x = component(0);
    patches.y = component(1);
    patches.z = component(2);
    patches.moment = hn::Mul(set4(side * side / 12), hn::Mul(hn::Add(h, one), hn::Mul(ih, ih)));
    patches.solid_angle_sr = hn::Mul(hn::Mul(set4(side * side), density), hn::Mul(ih, root));
    return patches;
}

}  // namespace aureole::ibl::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
