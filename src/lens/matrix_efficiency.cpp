#include "lens/matrix_efficiency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lens/matrix_open_area.h"

namespace aureole::lens {
namespace {

// The beam is its own mirror image in the plane of light and axis: only one half is looked at.
constexpr int kAcross = 11;
constexpr int kAlong = 22;
constexpr double kLost = 1e3;  // of a ray that does not arrive

// Points of half a rectangle of the iris, in its units; v along the light.
struct Points {
    double low_v, step_v, step_u;
    double u(int i) const { return (i + 0.5) * step_u; }
    double v(int j) const { return low_v + (j + 0.5) * step_v; }
};

Ray ray_through(const MatrixPath& path, double tangent, double u, double v) {
    return ray_from_light(0, tangent, path.entrance_x * u,
                          path.entrance_y * v - path.entrance_shift_y * tangent);
}

// The largest of distance / radius over all apertures on the way, at each point.
class Clips {
  public:
    Clips(const Tracer& tracer, const MatrixPath& path, double tangent, const Points& points) {
        for (int j = 0; j < kAlong; ++j) {
            for (int i = 0; i < kAcross; ++i) {
                const TracedRay ray = tracer.trace(
                    path.bounces, ray_through(path, tangent, points.u(i), points.v(j)));
                const double clip = std::max(ray.housing_clip, ray.stop_clip);
                clips_[index(j, i)] =
                    ray.fate == Fate::kArrived ? std::min(clip, 0.99 * kLost) : kLost;
            }
        }
    }

    bool is_open(int j, int i) const { return clips_[index(j, i)] <= 1; }

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

}  // namespace

ExactBeam exact_beam(const Tracer& tracer, const MatrixPath& path, double tangent) {
    ExactBeam beam;
    const double slope = -tangent;
    double low = -1;
    double high = 1;
    for (const ClipPath& clip : path.clips) {
        low = std::max(low, clip.gamma_y * slope - std::abs(clip.radius_v));
        high = std::min(high, clip.gamma_y * slope + std::abs(clip.radius_v));
    }
    if (!(low < high)) return beam;
    // Rays may pass far outside of what linear optics expects: first a look around.
    constexpr double kReach = 2.5;
    const double half = kReach * (high - low);
    const Points around = {0.5 * (low + high) - half, 2 * half / kAlong, half / kAcross};
    Points points = around_open(Clips(tracer, path, tangent, around), around);
    if (points.step_v == 0) return beam;
    // Coarse cells are wide; a second look puts the points closer to the edge.
    points = around_open(Clips(tracer, path, tangent, points), points);
    if (points.step_v == 0) return beam;
    const Clips clips(tracer, path, tangent, points);
    double open = 0;
    int inside = 0;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            open += clips.coverage(j, i);
            inside += clips.is_open(j, i) ? 1 : 0;
        }
    }
    beam.area_mm2 =
        2 * open * points.step_u * points.step_v * std::abs(path.entrance_x * path.entrance_y);
    // The middles of as many runs of equal length, row by row.
    int seen = 0;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            if (!clips.is_open(j, i)) continue;
            const int due = std::min(inside, ExactBeam::kRays);
            const int wanted = (2 * beam.ray_count + 1) * inside / (2 * due);
            if (seen++ != wanted || beam.ray_count == due) continue;
            beam.rays[beam.ray_count++] = ray_through(path, tangent, points.u(i), points.v(j));
        }
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
