#include "lens/ray_kernels.h"

#include "lens/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lens/ray_kernels.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include "lens/ray_iris-inl.h"

HWY_BEFORE_NAMESPACE();
namespace aureole::lens::HWY_NAMESPACE {
namespace {

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
// Square roots and divisions of one ray wait for each other; so several vectors of rays take each
// step together.
constexpr int kTogether = 4;
constexpr int kPerRow = std::min(kTogether, kRayBlock / kLanes);
constexpr int kRowsTogether = kTogether / kPerRow;

V set(float value) { return hn::Set(D(), value); }

struct Rays {
    V x, y, z;     // mm; z from the vertex before
    V dx, dy, dz;  // unit
    M alive;
};

struct Hit {
    V nx, ny, nz;  // unit normal, along the ray
    V cosine;      // of incidence, > 0
};

// 1 / a to float precision.
HWY_INLINE V reciprocal(V a) {
    const V r = hn::ApproximateReciprocal(a);
    return hn::Mul(r, hn::NegMulAdd(a, r, set(2)));
}

HWY_INLINE void go(Rays& rays, V t) {
    rays.x = hn::MulAdd(t, rays.dx, rays.x);
    rays.y = hn::MulAdd(t, rays.dy, rays.y);
}

// The quadric c (x^2 + y^2 + s z^2) = 2 z from the plane of its vertex on (Welford, "Aberrations
// of Optical Systems", 1986, 4.4): stable for any curvature, 0 included.
HWY_INLINE Hit meet_sphere(const RayStep& step, Rays& rays) {
    const V c = set(step.curvature);
    const V f = hn::Mul(c, hn::MulAdd(rays.x, rays.x, hn::Mul(rays.y, rays.y)));
    const V g = hn::NegMulAdd(c, hn::MulAdd(rays.x, rays.dx, hn::Mul(rays.y, rays.dy)), rays.dz);
    const V under_root = hn::NegMulAdd(c, f, hn::Mul(g, g));
    rays.alive = hn::And(rays.alive, hn::Ge(under_root, hn::Zero(D())));
    Hit hit;
    hit.cosine = hn::Sqrt(hn::Max(under_root, hn::Zero(D())));
    const V t = hn::Div(f, hn::Add(g, hit.cosine));
    go(rays, t);
    rays.z = hn::Mul(t, rays.dz);
    hit.nx = hn::Neg(hn::Mul(c, rays.x));
    hit.ny = hn::Neg(hn::Mul(c, rays.y));
    hit.nz = hn::NegMulAdd(c, rays.z, set(1));
    rays.alive = hn::And(rays.alive, hn::Gt(hit.nz, hn::Zero(D())));
    return hit;
}

HWY_INLINE Hit unit_normal(const Rays& rays, V nx, V ny, V nz) {
    const V scale =
        hn::Div(set(1), hn::Sqrt(hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, hn::Mul(nz, nz)))));
    Hit hit{hn::Mul(nx, scale), hn::Mul(ny, scale), hn::Mul(nz, scale), hn::Zero(D())};
    hit.cosine = hn::MulAdd(hit.nx, rays.dx, hn::MulAdd(hit.ny, rays.dy, hn::Mul(hit.nz, rays.dz)));
    return hit;
}

HWY_INLINE Hit meet_conic(const RayStep& step, Rays& rays) {
    const V c = set(step.curvature);
    const V wx = set(step.along_x);
    const V wy = set(step.along_y);
    const V s = set(step.stretch);
    const V wxx = hn::Mul(wx, rays.x);
    const V wyy = hn::Mul(wy, rays.y);
    const V a = hn::Mul(c, hn::MulAdd(hn::Mul(wx, rays.dx), rays.dx,
                                      hn::MulAdd(hn::Mul(wy, rays.dy), rays.dy,
                                                 hn::Mul(hn::Mul(s, rays.dz), rays.dz))));
    const V f = hn::Mul(c, hn::MulAdd(wxx, rays.x, hn::Mul(wyy, rays.y)));
    const V g = hn::NegMulAdd(c, hn::MulAdd(wxx, rays.dx, hn::Mul(wyy, rays.dy)), rays.dz);
    const V under_root = hn::NegMulAdd(a, f, hn::Mul(g, g));
    rays.alive = hn::And(rays.alive, hn::Ge(under_root, hn::Zero(D())));
    const V t = hn::Div(f, hn::Add(g, hn::Sqrt(hn::Max(under_root, hn::Zero(D())))));
    go(rays, t);
    rays.z = hn::Mul(t, rays.dz);
    const V nz = hn::NegMulAdd(hn::Mul(c, s), rays.z, set(1));
    rays.alive = hn::And(rays.alive, hn::Gt(nz, hn::Zero(D())));
    return unit_normal(rays, hn::Neg(hn::Mul(hn::Mul(c, wx), rays.x)),
                       hn::Neg(hn::Mul(hn::Mul(c, wy), rays.y)), nz);
}

// Newton's method on z - sag(r) from where the ray meets the conic.
HWY_INLINE Hit meet_asphere(const RayStep& step, Rays& rays) {
    constexpr int kIterations = 8;
    const V c = set(step.curvature);
    const V wx = set(step.along_x);
    const V wy = set(step.along_y);
    const M alive = rays.alive;
    const Rays before = rays;
    meet_conic(step, rays);
    // Rays that miss the conic may still meet the asphere: these start from the plane.
    const M met = rays.alive;
    rays.x = hn::IfThenElse(met, rays.x, before.x);
    rays.y = hn::IfThenElse(met, rays.y, before.y);
    rays.z = hn::IfThenElse(met, rays.z, hn::Zero(D()));
    rays.alive = alive;
    V nx = hn::Zero(D());
    V ny = hn::Zero(D());
    V move = hn::Zero(D());
    for (int i = 0; i <= kIterations; ++i) {
        const V r2 = hn::MulAdd(hn::Mul(wx, rays.x), rays.x, hn::Mul(hn::Mul(wy, rays.y), rays.y));
        const V under_root = hn::NegMulAdd(hn::Mul(set(step.stretch), hn::Mul(c, c)), r2, set(1));
        const M inside = hn::Gt(under_root, hn::Zero(D()));
        const V root = hn::Sqrt(hn::Max(under_root, set(1e-12F)));
        V height = hn::Div(hn::Mul(c, r2), hn::Add(set(1), root));
        V slope = hn::Div(c, root);  // (dz/dr) / r
        V power = r2;
        for (int k = 0; k < kMaxAsphereTerms; ++k) {
            const V term = hn::Mul(set(step.asphere[k]), power);
            height = hn::MulAdd(term, r2, height);
            slope = hn::MulAdd(set(static_cast<float>(2 * k + 4)), term, slope);
            power = hn::Mul(power, r2);
        }
        nx = hn::Neg(hn::Mul(slope, hn::Mul(wx, rays.x)));
        ny = hn::Neg(hn::Mul(slope, hn::Mul(wy, rays.y)));
        const V across = hn::MulAdd(nx, rays.dx, hn::MulAdd(ny, rays.dy, rays.dz));
        // The last round only finds the normal.
        if (i == kIterations) {
            rays.alive = hn::And(rays.alive, hn::And(inside, hn::Gt(across, hn::Zero(D()))));
            break;
        }
        move = hn::Div(hn::Sub(height, rays.z), across);
        go(rays, move);
        rays.z = hn::MulAdd(move, rays.dz, rays.z);
    }
    // Not yet there: it never will be.
    rays.alive = hn::And(rays.alive, hn::Lt(hn::Abs(move), set(1e-3F)));
    return unit_normal(rays, nx, ny, set(1));
}

// To the face of a step.
template <RayStep::Shape kShape>
HWY_INLINE Hit meet(const RayStep& step, Rays& rays) {
    rays.alive = hn::And(rays.alive, hn::Gt(rays.dz, hn::Zero(D())));
    go(rays, hn::Mul(hn::Sub(set(step.distance_mm), rays.z), reciprocal(rays.dz)));
    if constexpr (kShape == RayStep::Shape::kSphere) return meet_sphere(step, rays);
    if constexpr (kShape == RayStep::Shape::kConic) return meet_conic(step, rays);
    if constexpr (kShape == RayStep::Shape::kAsphere) return meet_asphere(step, rays);
    rays.z = hn::Zero(D());
    return {hn::Zero(D()), hn::Zero(D()), set(1), rays.dz};
}

// What the face does to the rays.
HWY_INLINE void turn(const RayStep& step, const Hit& hit, Rays& rays) {
    if (step.reflects) {
        const V twice = hn::Mul(set(-2), hit.cosine);
        rays.dx = hn::MulAdd(twice, hit.nx, rays.dx);
        rays.dy = hn::MulAdd(twice, hit.ny, rays.dy);
        rays.dz = hn::Neg(hn::MulAdd(twice, hit.nz, rays.dz));
        rays.z = hn::Neg(rays.z);
    } else if (step.index_ratio != 1) {
        const V ratio = set(step.index_ratio);
        const V sine2 = hn::NegMulAdd(hit.cosine, hit.cosine, set(1));
        const V cos2 = hn::NegMulAdd(hn::Mul(ratio, ratio), sine2, set(1));
        rays.alive = hn::And(rays.alive, hn::Ge(cos2, hn::Zero(D())));
        const V bend = hn::NegMulAdd(ratio, hit.cosine, hn::Sqrt(hn::Max(cos2, hn::Zero(D()))));
        rays.dx = hn::MulAdd(bend, hit.nx, hn::Mul(ratio, rays.dx));
        rays.dy = hn::MulAdd(bend, hit.ny, hn::Mul(ratio, rays.dy));
        rays.dz = hn::MulAdd(bend, hit.nz, hn::Mul(ratio, rays.dz));
    }
}

// Calls visit(Shape constant) for the shape of a step: one branch for all rays.
template <class Visit>
HWY_INLINE void with_shape(const RayStep& step, Visit&& visit) {
    using Shape = RayStep::Shape;
    switch (step.shape) {
        case Shape::kPlane:
            visit(std::integral_constant<Shape, Shape::kPlane>());
            break;
        case Shape::kSphere:
            visit(std::integral_constant<Shape, Shape::kSphere>());
            break;
        case Shape::kConic:
            visit(std::integral_constant<Shape, Shape::kConic>());
            break;
        case Shape::kAsphere:
            visit(std::integral_constant<Shape, Shape::kAsphere>());
            break;
    }
}

HWY_INLINE Rays start(const RayBundle& bundle, int column, int row) {
    const D d;
    Rays rays;
    rays.x = hn::MulAdd(hn::Iota(d, static_cast<float>(column)), set(bundle.step_x_mm),
                        set(bundle.x_mm));
    rays.y = set(bundle.y_mm + static_cast<float>(row) * bundle.step_y_mm);
    rays.z = hn::Zero(d);
    rays.dx = set(bundle.direction[0]);
    rays.dy = set(bundle.direction[1]);
    rays.dz = set(bundle.direction[2]);
    rays.alive = hn::Eq(rays.dz, rays.dz);
    return rays;
}

// kPerRow vectors in each of kRows rows.
template <int kRows>
bool trace_block(std::span<const RayStep> way, float sensor_distance_mm, const RayBundle& bundle,
                 const IrisField& iris, int column, int row, const RayFields& to) {
    constexpr int kVectors = kPerRow * kRows;
    const D d;
    Rays rays[kVectors];
    V clip2[kVectors];  // squared
    V other[kVectors];  // distance of the iris at earlier crossings
    V u[kVectors];
    V v[kVectors];
    for (int k = 0; k < kVectors; ++k) {
        rays[k] = start(bundle, column + (k % kPerRow) * kLanes, row + k / kPerRow);
        clip2[k] = other[k] = u[k] = v[k] = hn::Zero(d);
    }
    for (const RayStep& step : way) {
        with_shape(step, [&](auto shape) {
            for (int k = 0; k < kVectors; ++k) {
                const Hit hit = meet<decltype(shape)::value>(step, rays[k]);
                const V scale = set(step.per_semi_aperture);
                const V relative_x = hn::Mul(rays[k].x, scale);
                const V relative_y = hn::Mul(rays[k].y, scale);
                if (step.stops_left < 0) {
                    clip2[k] = hn::Max(clip2[k], hn::MulAdd(relative_x, relative_x,
                                                            hn::Mul(relative_y, relative_y)));
                } else if (step.stops_left == 0) {
                    u[k] = relative_x;
                    v[k] = relative_y;
                } else {
                    other[k] = hn::Max(other[k], iris_distance(d, iris, relative_x, relative_y));
                }
                turn(step, hit, rays[k]);
            }
        });
    }
    const int stride = ray_stride(bundle.columns);
    M all = hn::Eq(hn::Zero(d), hn::Zero(d));
    for (int k = 0; k < kVectors; ++k) {
        const std::ptrdiff_t at =
            static_cast<std::ptrdiff_t>(row + k / kPerRow) * stride + column + k % kPerRow * kLanes;
        Rays& r = rays[k];
        M alive = hn::And(r.alive, hn::Gt(r.dz, hn::Zero(d)));
        go(r, hn::Div(hn::Sub(set(sensor_distance_mm), r.z), r.dz));
        const V farthest = set(kFarthestClip);
        const V clip = hn::Max(hn::Sqrt(clip2[k]), other[k]);
        alive = hn::And(alive, hn::Lt(clip, farthest));
        alive = hn::And(alive, hn::Lt(hn::MulAdd(u[k], u[k], hn::Mul(v[k], v[k])),
                                      hn::Mul(farthest, farthest)));
        alive = hn::And(alive, hn::Lt(hn::Max(hn::Abs(r.x), hn::Abs(r.y)), farthest));
        all = hn::And(all, alive);
        const V x = hn::IfThenElseZero(alive, r.x);
        const V y = hn::IfThenElseZero(alive, r.y);
        hn::StoreU(hn::MulAdd(set(to.scale_x), x, set(to.begin_x)), d, to.x + at);
        hn::StoreU(hn::MulAdd(set(to.scale_y), y, set(to.begin_y)), d, to.y + at);
        hn::StoreU(hn::IfThenElseZero(alive, u[k]), d, to.u + at);
        hn::StoreU(hn::IfThenElseZero(alive, v[k]), d, to.v + at);
        hn::StoreU(hn::IfThenElse(alive, clip, set(kLostRay)), d, to.clip + at);
    }
    return !hn::AllTrue(d, all);
}

bool trace(std::span<const RayStep> way, float sensor_distance_mm, const RayBundle& rays,
           const IrisField& iris, const RayFields& to) {
    const int stride = ray_stride(rays.columns);
    bool lost = false;
    int row = 0;
    for (; row + kRowsTogether <= rays.rows; row += kRowsTogether) {
        for (int column = 0; column < stride; column += kPerRow * kLanes) {
            lost |=
                trace_block<kRowsTogether>(way, sensor_distance_mm, rays, iris, column, row, to);
        }
    }
    for (; row < rays.rows; ++row) {
        for (int column = 0; column < stride; column += kPerRow * kLanes) {
            lost |= trace_block<1>(way, sensor_distance_mm, rays, iris, column, row, to);
        }
    }
    return lost;
}

// Unpolarised light as a real coherency matrix (Born & Wolf 10.9) in the directions e, across the
// ray, and d x e; as Tracer::throughput has it.
struct Polarisation {
    V ex, ey, ez;
    V ee, pp, ep;
};

HWY_INLINE void polarise(const RayStep& step, const Hit& hit, const Rays& rays, Polarisation& p) {
    const D d;
    // s = d x n, and d x e.
    const V sx = hn::MulSub(rays.dy, hit.nz, hn::Mul(rays.dz, hit.ny));
    const V sy = hn::MulSub(rays.dz, hit.nx, hn::Mul(rays.dx, hit.nz));
    const V sz = hn::MulSub(rays.dx, hit.ny, hn::Mul(rays.dy, hit.nx));
    const V length2 = hn::MulAdd(sx, sx, hn::MulAdd(sy, sy, hn::Mul(sz, sz)));
    // Nearly along the normal s and p are the same, and the plane of incidence is noise.
    const M tilted = hn::Gt(length2, set(1e-10F));
    const V scale = hn::Div(set(1), hn::Sqrt(hn::Max(length2, set(1e-20F))));
    const V tx = hn::MulSub(rays.dy, p.ez, hn::Mul(rays.dz, p.ey));
    const V ty = hn::MulSub(rays.dz, p.ex, hn::Mul(rays.dx, p.ez));
    const V tz = hn::MulSub(rays.dx, p.ey, hn::Mul(rays.dy, p.ex));
    const auto dot = [&](V ax, V ay, V az) {
        return hn::Mul(scale, hn::MulAdd(ax, sx, hn::MulAdd(ay, sy, hn::Mul(az, sz))));
    };
    const V cosine = hn::IfThenElse(tilted, dot(p.ex, p.ey, p.ez), set(1));
    const V sine = hn::IfThenElseZero(tilted, dot(tx, ty, tz));
    const V cc = hn::Mul(cosine, cosine);
    const V ss = hn::Mul(sine, sine);
    const V cs = hn::Mul(cosine, sine);
    const V cross = hn::Mul(hn::Add(cs, cs), p.ep);
    const V ee = hn::MulAdd(cc, p.ee, hn::MulAdd(ss, p.pp, cross));
    const V pp = hn::MulAdd(ss, p.ee, hn::MulSub(cc, p.pp, cross));
    const V ep = hn::MulAdd(hn::Sub(cc, ss), p.ep, hn::Mul(cs, hn::Sub(p.pp, p.ee)));
    p.ex = hn::IfThenElse(tilted, hn::Mul(sx, scale), p.ex);
    p.ey = hn::IfThenElse(tilted, hn::Mul(sy, scale), p.ey);
    p.ez = hn::IfThenElse(tilted, hn::Mul(sz, scale), p.ez);
    // From the table.
    const V last = set(kReflectanceSamples - 1);
    const V position = hn::Min(hn::Max(hn::Mul(hit.cosine, last), hn::Zero(d)), last);
    const V whole = hn::Min(hn::Floor(position), set(kReflectanceSamples - 2));
    const V part = hn::Sub(position, whole);
    const hn::Rebind<int32_t, D> di;
    const auto index = hn::ConvertTo(di, hn::Add(whole, whole));
    const float* table = step.reflectance;
    const V s0 = hn::GatherIndex(d, table, index);
    const V p0 = hn::GatherIndex(d, table + 1, index);
    const V s1 = hn::GatherIndex(d, table + 2, index);
    const V p1 = hn::GatherIndex(d, table + 3, index);
    V rs = hn::MulAdd(part, hn::Sub(s1, s0), s0);
    V rp = hn::MulAdd(part, hn::Sub(p1, p0), p0);
    if (step.reflects) {
        // The z of fields is mirrored with the ray; that undoes the change of sign of one of them.
        p.ez = hn::Neg(p.ez);
    } else {
        rs = hn::Sub(set(1), rs);
        rp = hn::Sub(set(1), rp);
    }
    p.ee = hn::Mul(ee, rs);
    p.pp = hn::Mul(pp, rp);
    p.ep = hn::Mul(ep, hn::Sqrt(hn::Max(hn::Mul(rs, rp), hn::Zero(d))));
}

// kVectors side by side.
template <int kVectors>
void throughput_block(std::span<const RayStep> way, const RayBundle& bundle, int column, int row,
                      float* to) {
    const D d;
    // Any direction across the light will do.
    const float* direction = bundle.direction;
    const float length = std::sqrt(direction[0] * direction[0] + direction[2] * direction[2]);
    Rays rays[kVectors];
    Polarisation p[kVectors];
    for (int k = 0; k < kVectors; ++k) {
        rays[k] = start(bundle, column + k * kLanes, row);
        p[k] = {set(direction[2] / length),
                hn::Zero(d),
                set(-direction[0] / length),
                set(0.5F),
                set(0.5F),
                hn::Zero(d)};
    }
    for (const RayStep& step : way) {
        with_shape(step, [&](auto shape) {
            for (int k = 0; k < kVectors; ++k) {
                const Hit hit = meet<decltype(shape)::value>(step, rays[k]);
                if (step.reflectance) polarise(step, hit, rays[k], p[k]);
                turn(step, hit, rays[k]);
            }
        });
    }
    for (int k = 0; k < kVectors; ++k) {
        const M alive = hn::And(rays[k].alive, hn::Gt(rays[k].dz, hn::Zero(d)));
        hn::StoreU(hn::IfThenElseZero(alive, hn::Add(p[k].ee, p[k].pp)), d, to + k * kLanes);
    }
}

void throughput(std::span<const RayStep> way, const RayBundle& bundle, float* to) {
    const int stride = ray_stride(bundle.columns);
    for (int row = 0; row < bundle.rows; ++row, to += stride) {
        for (int column = 0; column < bundle.columns;) {
            const bool two = column + kLanes < bundle.columns;
            (two ? throughput_block<2> : throughput_block<1>)(way, bundle, column, row,
                                                              to + column);
            column += two ? 2 * kLanes : kLanes;
        }
    }
}

}  // namespace

RayKernels make_ray_kernels() { return {&trace, &throughput}; }

}  // namespace aureole::lens::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace aureole::lens {
HWY_EXPORT(make_ray_kernels);
const RayKernels& ray_kernels() {
    static const RayKernels kernels = HWY_DYNAMIC_DISPATCH(make_ray_kernels)();
    return kernels;
}
}  // namespace aureole::lens
#endif
