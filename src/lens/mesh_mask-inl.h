// Light through apertures in SIMD. Included once per instruction set.
#if defined(AUREOLE_LENS_MESH_MASK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef AUREOLE_LENS_MESH_MASK_INL_H_
#undef AUREOLE_LENS_MESH_MASK_INL_H_
#else
#define AUREOLE_LENS_MESH_MASK_INL_H_
#endif

#include "lens/mesh_mask.h"
#include "lens/mesh_vectors-inl.h"
#include "lens/ray_iris-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

// A field at a place, and its changes over the place in two directions.
struct MaskField {
    V value, along, across;
};

struct MaskPlace {
    MaskField u, v, clip;
    V entrance_x, entrance_y;  // only for MeshMask::extra
    float entrance_width = 0;
};

// How much of a place is inside, from a distance that is 1 on the edge.
HWY_INLINE V inside(const MaskField& distance) {
    const V width = hn::Max(hn::Add(hn::Abs(distance.along), hn::Abs(distance.across)), set(1e-6F));
    const V covered = hn::Add(hn::Div(hn::Sub(set(1), distance.value), width), set(0.5F));
    return hn::Min(hn::Max(covered, hn::Zero(D())), set(1));
}

HWY_INLINE V light_at(const MeshMask& mask, const MaskPlace& at) {
    const D d;
    V light = inside(at.clip);
    if (!mask.open) {
        const V distance = iris_distance(d, mask.iris, at.u.value, at.v.value);
        const auto beside = [&](V du, V dv) {
            const V there =
                iris_distance(d, mask.iris, hn::Add(at.u.value, du), hn::Add(at.v.value, dv));
            return hn::Sub(there, distance);
        };
        light = hn::Mul(light, inside({distance, beside(at.u.along, at.v.along),
                                       beside(at.u.across, at.v.across)}));
    }
    if (mask.extra == nullptr) return light;
    HWY_ALIGN float fields[6][kLanes];
    hn::Store(at.u.value, d, fields[0]);
    hn::Store(at.v.value, d, fields[1]);
    // The side of a square as large as the place is in the iris.
    const V area = hn::MulSub(at.u.along, at.v.across, hn::Mul(at.u.across, at.v.along));
    hn::Store(hn::Sqrt(hn::Abs(area)), d, fields[2]);
    hn::Store(at.entrance_x, d, fields[3]);
    hn::Store(at.entrance_y, d, fields[4]);
    hn::Store(light, d, fields[5]);
    mask.extra(mask.context, fields[0], fields[1], fields[2], fields[3], fields[4],
               at.entrance_width, kLanes, fields[5]);
    return hn::Load(d, fields[5]);
}

}  // namespace
}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
