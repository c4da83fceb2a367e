#include "lens/matrix_efficiency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "aureole/lens/glass.h"
#include "lens/matrix_open_area.h"
#include "lens/ray_kernels.h"

namespace aureole::lens {
namespace {

// The beam is its own mirror image in the plane of light and axis: only one half is looked at.
constexpr int kAcross = 32;
constexpr int kAlong = 64;
constexpr double kLost = 1e3;  // of a ray that does not arrive

// One ghost and light, and room for tracing.
struct Beam {
    const MatrixPath& path;
    double tangent;
    std::span<const RayStep> way;
    float sensor_distance_mm;
    std::vector<float> memory = std::vector<float>(5 * kPoints);

    static constexpr std::size_t kPoints = std::size_t{kAlong} * ray_stride(kAcross);
};

// Points of half a rectangle of the iris, in its units; v along the light.
struct Points {
    double low_v, step_v, step_u;
    double u(int i) const { return (i + 0.5) * step_u; }
    double v(int j) const { return low_v + (j + 0.5) * step_v; }
};

Ray ray_through(const Beam& beam, double u, double v) {
    const MatrixPath& path = beam.path;
    return ray_from_light(0, beam.tangent, path.entrance_x * u,
                          path.entrance_y * v - path.entrance_shift_y * beam.tangent);
}

// The largest of distance / radius over all apertures on the way, at each point.
class Clips {
  public:
    Clips(Beam& beam, const Points& points) {
        const Ray first = ray_through(beam, points.u(0), points.v(0));
        RayBundle bundle;
        for (std::size_t k = 0; k < 3; ++k) {
            bundle.direction[k] = static_cast<float>(first.direction[k]);
        }
        bundle.x_mm = static_cast<float>(first.origin[0]);
        bundle.y_mm = static_cast<float>(first.origin[1]);
        bundle.step_x_mm = static_cast<float>(beam.path.entrance_x * points.step_u);
        bundle.step_y_mm = static_cast<float>(beam.path.entrance_y * points.step_v);
        bundle.columns = kAcross;
        bundle.rows = kAlong;
        float* to = beam.memory.data();
        const RayFields fields = {to, to + Beam::kPoints, to + 2 * Beam::kPoints,
                                  to + 3 * Beam::kPoints, to + 4 * Beam::kPoints};
        // The stop is round.
        ray_kernels().trace(beam.way, beam.sensor_distance_mm, bundle, IrisField(), fields);
        for (int j = 0; j < kAlong; ++j) {
            for (int i = 0; i < kAcross; ++i) {
                const auto at = static_cast<std::size_t>(j * ray_stride(kAcross) + i);
                const float clip =
                    std::max(fields.clip[at], std::hypot(fields.u[at], fields.v[at]));
                clips_[index(j, i)] =
                    fields.clip[at] < kLostRay ? std::min<double>(clip, 0.99 * kLost) : kLost;
            }
        }
    }

    bool is_open(int j, int i) const { return clips_[index(j, i)] <= 1; }

    int open_points(int j) const {
        int count = 0;
        for (int i = 0; i < kAcross; ++i) count += is_open(j, i) ? 1 : 0;
        return count;
    }
    // The `wanted`-th of these, from 0.
    int open_point(int j, int wanted) const {
        int i = 0;
        while (!is_open(j, i) || wanted-- > 0) ++i;
        return i;
    }

    // The share of a point's cell that is open: 1 - clip over its change from point to point is the
    // distance from the edge.
    double coverage(int j, int i) const {
        const double here = clips_[index(j, i)];
        if (here >= kLost) return 0;
        const double growth =
            change(here, at(j, i - 1), at(j, i + 1)) + change(here, at(j - 1, i), at(j + 1, i));
        return std::clamp(0.5 + (1 - here) / std::max(growth, 1e-9), 0.0, 1.0);
    }

  private:
    static std::size_t index(int j, int i) { return static_cast<std::size_t>(j * kAcross + i); }
    // Mirrored in the plane of the light; beyond the border nothing is known.
    double at(int j, int i) const {
        if (i < 0) i = 0;
        return i >= kAcross || j < 0 || j >= kAlong ? kLost : clips_[index(j, i)];
    }
    static double change(double here, double before, double after) {
        return std::max(before < kLost ? std::abs(here - before) : 0,
                        after < kLost ? std::abs(here - after) : 0);
    }

    std::array<double, kAlong * kAcross> clips_;
};

// Cells around those that are open, by one more; none: step_v 0.
Points around_open(const Clips& clips, const Points& points) {
    int first = kAlong;
    int last = -1;
    int widest = -1;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            if (!clips.is_open(j, i)) continue;
            first = std::min(first, j);
            last = std::max(last, j);
            widest = std::max(widest, i);
        }
    }
    if (last < 0) return {0, 0, 0};
    return {points.low_v + (first - 1) * points.step_v, (last - first + 3) * points.step_v / kAlong,
            (widest + 2) * points.step_u / kAcross};
}

std::vector<Bounces> bounces_of(std::span<const MatrixPath> paths) {
    std::vector<Bounces> bounces;
    for (const MatrixPath& path : paths) bounces.push_back(path.bounces);
    return bounces;
}

}  // namespace

ExactBeams::ExactBeams(const Lens& lens, std::span<const MatrixPath> paths)
    : ways_(lens, bounces_of(paths), std::array{kLineDNm}) {}

ExactBeam ExactBeams::find(std::size_t ghost, const MatrixPath& path, double tangent) const {
    ExactBeam beam;
    const double slope = -tangent;
    double low = -1;
    double high = 1;
    for (const ClipPath& clip : path.clips) {
        low = std::max(low, clip.gamma_y * slope - std::abs(clip.radius_v));
        high = std::min(high, clip.gamma_y * slope + std::abs(clip.radius_v));
    }
    if (!(low < high)) return beam;
    std::vector<RayStep> steps = ways_.scratch();
    Beam light = {path, tangent, ways_.way(static_cast<int>(ghost), 0, steps),
                  ways_.sensor_distance_mm()};
    // Rays may pass far outside of what linear optics expects: first a look around.
    constexpr double kReach = 2.5;
    const double half = kReach * (high - low);
    const Points around = {0.5 * (low + high) - half, 2 * half / kAlong, half / kAcross};
    Points points = around_open(Clips(light, around), around);
    if (points.step_v == 0) return beam;
    // Coarse cells are wide; a second look puts the points closer to the edge.
    points = around_open(Clips(light, points), points);
    if (points.step_v == 0) return beam;
    const Clips clips(light, points);
    double open = 0;
    int inside = 0;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            open += clips.coverage(j, i);
        }
        inside += clips.open_points(j);
    }
    beam.area_mm2 =
        2 * open * points.step_u * points.step_v * std::abs(path.entrance_x * path.entrance_y);
    // As many rays per row as it holds of the area, each at another part of it.
    constexpr double kGoldenRatio = 0.6180339887498949;
    int before = 0;  // open points of earlier rows
    for (int j = 0; j < kAlong; ++j) {
        const int here = clips.open_points(j);
        while (beam.ray_count < ExactBeam::kRays &&
               (2 * beam.ray_count + 1) * inside < 2 * ExactBeam::kRays * (before + here)) {
            double whole = 0;
            const double part = std::modf((beam.ray_count + 0.5) * kGoldenRatio, &whole);
            const int i = clips.open_point(j, static_cast<int>(part * here));
            beam.rays[beam.ray_count++] = ray_through(light, points.u(i), points.v(j));
        }
        before += here;
    }
    return beam;
}

double linear_beam(const MatrixPath& path, double tangent) {
    std::vector<MatrixGhost::Clip> clips;
    for (const ClipPath& clip : path.clips) {
        clips.push_back({0, static_cast<float>(-clip.gamma_y * tangent),
                         static_cast<float>(clip.radius_u), static_cast<float>(clip.radius_v),
                         false, 0});
    }
    const Iris round;
    const Pupil pupil = {&round, nullptr, nullptr};
    return open_area(pupil, {}, clips).area * std::abs(path.entrance_x * path.entrance_y);
}

}  // namespace aureole::lens
