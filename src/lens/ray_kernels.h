// The SIMD part of tracing: bundles of parallel rays along one way through the lens.
//
// A way is a list of small uniform structs, one per crossing; rays are the lanes. The system is
// unfolded: at a reflection z is mirrored, so that light always travels towards +z, every distance
// is positive, and a surface met from behind has the opposite curvature.
#pragma once

#include <cstddef>
#include <span>

namespace aureole::lens {

inline constexpr int kMaxAsphereTerms = 7;

struct RayStep {
    enum class Shape {
        kPlane,
        kSphere,
        kConic,    // and cylinders
        kAsphere,  // by Newton's method
    };
    Shape shape = Shape::kPlane;
    bool reflects = false;
    int stops_left = -1;    // housings: -1; the stop: how often it will be met again
    float distance_mm = 0;  // from the vertex before, or from z = 0
    float curvature = 0;    // 1 / mm, as met
    float stretch = 1;      // 1 + conic constant
    float along_x = 1;      // 1 or 0: is the face curved along x, y
    float along_y = 1;
    float index_ratio = 1;                 // before over after
    float per_semi_aperture;               // 1 / mm; of the stop: 1 / its radius
    float asphere[kMaxAsphereTerms] = {};  // as met
    // Reflectance for s and p light by the cosine of incidence, as met: kReflectanceSamples pairs
    // (s, p); see reflectance_table.h. Only for throughput().
    const float* reflectance = nullptr;
};

// Reflectance at cosines k / (kReflectanceSamples - 1), linear between them.
inline constexpr int kReflectanceSamples = 129;

// Parallel rays that cross the plane of the first vertex on a grid, `columns` x `rows`.
struct RayBundle {
    float direction[3] = {0, 0, 1};  // unit, z > 0
    float x_mm = 0, y_mm = 0;        // of the first ray
    float step_x_mm = 0, step_y_mm = 0;
    int columns = 0;  // trace() follows whole blocks of kRayBlock
    int rows = 0;
};

// Rows of results begin at multiples of this many floats.
inline constexpr int kRayBlock = 32;
constexpr int ray_stride(int columns) { return (columns + kRayBlock - 1) / kRayBlock * kRayBlock; }

// `clip` of a ray that never arrives. (Aureole's canvas is smaller than 1e9 of anything.)
inline constexpr float kLostRay = 1e9F;
// Rays farther outside an aperture than this times its radius count as lost.
inline constexpr float kFarthestClip = 1e6F;

// Arrays of rows * ray_stride(columns) floats.
struct RayFields {
    float* x = nullptr;  // on the sensor: begin_x + scale_x * mm
    float* y = nullptr;
    float* u = nullptr;  // at the last crossing of the stop, in radii of it
    float* v = nullptr;
    float* clip = nullptr;  // largest r / semi-aperture of all housings, and distance of the iris
                            // at the stop's other crossings; kLostRay if it never arrives
    float begin_x = 0, begin_y = 0, scale_x = 1, scale_y = 1;
};

// What distance() of an iris needs; see iris.h.
struct IrisField {
    int blades = 0;                  // 0: round
    const float* normals = nullptr;  // u and v of each blade
    float apothem = 1;
    float blade_radius = 0;  // 0: straight
    float smoothing = 0;
    float offset = 0;  // subtracted from the distance of a round one
};

struct RayKernels {
    // Apertures stop no ray. Are there any that never arrive?
    bool (*trace)(std::span<const RayStep> way, float sensor_distance_mm, const RayBundle& rays,
                  const IrisField& iris, const RayFields& to);
    // The share of energy left on arrival, as Tracer::throughput; 0 for lost rays.
    void (*throughput)(std::span<const RayStep> way, const RayBundle& rays, float* to);
};

const RayKernels& ray_kernels();

}  // namespace aureole::lens
