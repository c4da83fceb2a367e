#include "lens/matrix_sectors.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"
#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/matrix_sectors.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using Vec = hn::Vec<D>;

// The part of each ray that is open, as distances from the middle.
struct Open {
    Vec from;
    Vec to;
};

void cut_by_disc(Open& open, Vec u, Vec v, const MatrixGhost::Clip& clip, float radius) {
    const D d;
    const Vec along = hn::MulAdd(u, hn::Set(d, clip.u0), hn::Mul(v, hn::Set(d, clip.v0)));
    const float beyond = clip.u0 * clip.u0 + clip.v0 * clip.v0 - radius * radius;
    const Vec square = hn::MulSub(along, along, hn::Set(d, beyond));
    const auto met = hn::Gt(square, hn::Zero(d));
    const Vec half = hn::Sqrt(hn::Max(square, hn::Zero(d)));
    open.to = hn::Min(open.to, hn::IfThenElseZero(met, hn::Add(along, half)));
    open.from = hn::Max(open.from, hn::Sub(along, half));
}

void cut_by_blades(Open& open, Vec u, Vec v, const MatrixGhost::Clip& clip,
                   const IrisSectors& iris) {
    const D d;
    const float sign = clip.ru < 0 ? -1.0F : 1.0F;
    for (int b = 0; b < iris.blade_count; ++b) {
        const float nu = sign * iris.blades[b].normal_u;
        const float nv = sign * iris.blades[b].normal_v;
        const Vec towards = hn::MulAdd(u, hn::Set(d, nu), hn::Mul(v, hn::Set(d, nv)));
        const Vec room = hn::Set(d, iris.apothem * std::abs(clip.ru) + nu * clip.u0 + nv * clip.v0);
        // A ray along the edge meets it far away, on the side that tells whether it is inside.
        const Vec tiny = hn::Set(d, 1e-9F);
        const auto leaving = hn::Ge(towards, hn::Zero(d));
        const Vec slope = hn::IfThenElse(hn::Lt(hn::Abs(towards), tiny), tiny, towards);
        const Vec distance = hn::Div(room, slope);
        open.to = hn::IfThenElse(leaving, hn::Min(open.to, distance), open.to);
        open.from = hn::IfThenElse(leaving, open.from, hn::Max(open.from, distance));
    }
}

}  // namespace

// Sums over all rays: of the area beyond that of the whole iris, and of its moments.
void sum_sectors(const IrisSectors& iris, const MatrixGhost::Clip* clips, std::size_t count,
                 float* sums) {
    const D d;
    const auto lanes = hn::Lanes(d);
    Vec area = hn::Zero(d);
    Vec moment_u = area;
    Vec moment_v = area;
    for (std::size_t i = 0; i < IrisSectors::kCount; i += lanes) {
        const Vec u = hn::Load(d, iris.u + i);
        const Vec v = hn::Load(d, iris.v + i);
        const Vec reach = hn::Load(d, iris.reach + i);
        Open open = {hn::Zero(d), reach};
        for (std::size_t k = 0; k < count; ++k) {
            if (clips[k].iris && iris.blade_count > 0) {
                cut_by_blades(open, u, v, clips[k], iris);
            } else {
                cut_by_disc(open, u, v, clips[k], std::abs(clips[k].ru));
            }
        }
        open.to = hn::Max(open.to, open.from);
        const Vec to2 = hn::Mul(open.to, open.to);
        const Vec from2 = hn::Mul(open.from, open.from);
        area = hn::Add(area, hn::Sub(hn::Sub(to2, from2), hn::Mul(reach, reach)));
        const Vec cubes = hn::Sub(hn::Mul(to2, open.to), hn::Mul(from2, open.from));
        moment_u = hn::MulAdd(cubes, u, moment_u);
        moment_v = hn::MulAdd(cubes, v, moment_v);
    }
    sums[0] = hn::GetLane(hn::SumOfLanes(d, area));
    sums[1] = hn::GetLane(hn::SumOfLanes(d, moment_u));
    sums[2] = hn::GetLane(hn::SumOfLanes(d, moment_v));
}

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(sum_sectors);

IrisSectors::IrisSectors(const Iris& iris) {
    for (int i = 0; i < kCount; ++i) {
        const double angle = 2 * kPi * (i + 0.5) / kCount;
        u[i] = static_cast<float>(std::cos(angle));
        v[i] = static_cast<float>(std::sin(angle));
        double low = 0;
        double high = 2 * iris.outer_radius();
        for (int step = 0; step < 40; ++step) {
            const double middle = 0.5 * (low + high);
            const auto scale = static_cast<float>(middle);
            (iris.distance(scale * u[i], scale * v[i]) < 1 ? low : high) = middle;
        }
        reach[i] = static_cast<float>(low);
    }
    if (iris.shape().blades > 0 && iris.blade_radius() == 0) {
        blades = iris.blades();
        blade_count = iris.shape().blades;
        apothem = static_cast<float>(iris.apothem());
    }
}

OpenArea IrisSectors::open_area(std::span<const MatrixGhost::Clip> clips) const noexcept {
    float sums[3];
    HWY_DYNAMIC_DISPATCH(sum_sectors)(*this, clips.data(), clips.size(), sums);
    const double width = 2 * kPi / kCount;
    OpenArea open;
    // The area of the whole iris is known; only what is cut off is summed up.
    open.area = std::max(kPi + 0.5 * width * static_cast<double>(sums[0]), 0.0);
    if (open.area > 0) {
        open.middle_u = width / 3 * static_cast<double>(sums[1]) / open.area;
        open.middle_v = width / 3 * static_cast<double>(sums[2]) / open.area;
    }
    return open;
}

}  // namespace aureole::lens
#endif
