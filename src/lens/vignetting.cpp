#include "aureole/lens/vignetting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/trace.h"
#include "lens/sag.h"

namespace aureole::lens {
namespace {

constexpr double kBlocked = std::numeric_limits<double>::infinity();

// Light at infinity, `up` above the axis and `aside` from the plane of y and z, in radians.
struct Direction {
    double up = 0;
    double aside = 0;
    Ray ray(double x_mm, double y_mm) const {
        return ray_from_light(std::tan(aside) / std::cos(up), std::tan(up), x_mm, y_mm);
    }
};

// A part of the entrance plane, symmetric in x.
struct Box {
    double half_x = 0;
    double low_y = 0, high_y = 0;
};

// How far out a ray is at the worst aperture; 1: at its edge.
double clip(const Tracer& tracer, const Ray& ray) {
    const TracedRay traced = tracer.trace(Bounces{}, ray);
    if (traced.fate != Fate::kArrived) return kBlocked;
    return std::max(traced.housing_clip, traced.stop_clip);
}

// All of the entrance plane through which the front element is reached.
Box front_element(const Lens& lens, double up) {
    const Face& front = lens.faces().front();
    const double a = front.semi_aperture_mm;
    // A ray that meets the front at height z crosses the entrance plane z tan(up) higher. A front
    // that ends at its equator has no normal there, and is as deep as it is wide.
    const auto rim = intersect(front, {a, 0, 0}, {0, 0, 1});
    const double depth = rim ? rim->point[2] : std::copysign(a, front.curvature_per_mm);
    const double shift = depth * std::tan(up);
    return {a, -a + std::min(0.0, shift), a + std::max(0.0, shift)};
}

// Narrows a box down to the light that passes; nullopt if none does. Stopped down, the beam may be
// narrower than the distance of the first rays: then the one that passes best leads on.
std::optional<Box> beam_box(const Tracer& tracer, const Direction& light, Box box) {
    constexpr int kSide = 32;
    constexpr int kRounds = 24;
    for (int round = 0; round < kRounds; ++round) {
        const double dx = box.half_x / kSide;
        const double dy = (box.high_y - box.low_y) / kSide;
        Box passing{-1, HUGE_VAL, -HUGE_VAL};
        double best = kBlocked;
        double best_x = 0, best_y = 0;
        for (int j = 0; j <= kSide; ++j) {
            for (int i = 0; i <= kSide; ++i) {
                const double x = i * dx;
                const double y = box.low_y + j * dy;
                const double out = clip(tracer, light.ray(x, y));
                if (out < best) {
                    best = out;
                    best_x = x;
                    best_y = y;
                }
                if (out > 1) continue;
                passing.half_x = std::max(passing.half_x, x);
                passing.low_y = std::min(passing.low_y, y);
                passing.high_y = std::max(passing.high_y, y);
            }
        }
        if (best == kBlocked) return std::nullopt;
        if (best > 1) {
            box = {best_x + 2 * dx, best_y - 2 * dy, best_y + 2 * dy};
            continue;
        }
        const Box next{passing.half_x + dx, passing.low_y - dy, passing.high_y + dy};
        const bool settled = next.half_x > 0.5 * box.half_x &&
                             next.high_y - next.low_y > 0.5 * (box.high_y - box.low_y);
        box = next;
        if (settled) return box;
    }
    return std::nullopt;
}

struct Beam {
    double area_mm2 = 0;      // in the entrance plane
    double middle_y_mm = 0;   // there
    double transmission = 0;  // mean
};

// Rows of rays from the middle outwards; where a row leaves the beam is interpolated between its
// rays. Transmission, which changes slowly, is sampled by some of them.
Beam measure(const Tracer& tracer, const Direction& light, const Box& box, int rays_per_side) {
    const int columns = (rays_per_side + 1) / 2;
    const double dx = box.half_x / (columns - 1);
    const double dy = (box.high_y - box.low_y) / rays_per_side;
    constexpr int kEvery = 4;
    Beam beam;
    int samples = 0;
    for (int j = 0; j < rays_per_side; ++j) {
        const double y = box.low_y + (j + 0.5) * dy;
        double last_out = kBlocked;
        for (int i = 0; i < columns; ++i) {
            const Ray ray = light.ray(i * dx, y);
            const double out = clip(tracer, ray);
            if (out <= 1 && i % kEvery == 0 && j % kEvery == 0) {
                // The rays in the middle stand for one column, all others for two.
                const int weight = i == 0 ? 1 : 2;
                beam.transmission += weight * tracer.throughput(Bounces{}, ray);
                samples += weight;
            }
            const double inner = std::min(out, last_out);
            const double outer = std::max(out, last_out);
            if (i > 0 && inner <= 1) {
                double length = dx;
                if (outer == kBlocked) {
                    length = 0.5 * dx;
                } else if (outer > 1) {
                    length = dx * (1 - inner) / (outer - inner);
                }
                beam.area_mm2 += length;
                beam.middle_y_mm += length * y;
            }
            last_out = out;
        }
    }
    if (beam.area_mm2 > 0) {
        beam.middle_y_mm /= beam.area_mm2;
        beam.transmission = samples > 0
                                ? beam.transmission / samples
                                : tracer.throughput(Bounces{}, light.ray(0, beam.middle_y_mm));
    }
    beam.area_mm2 *= 2 * dy;  // both halves
    return beam;
}

using Point = std::array<double, 2>;

// Where light from `light` arrives that crosses the stop at `stop`; Newton's method from the point
// `start` of the entrance plane.
std::optional<Point> image_through(const Tracer& tracer, const Direction& light, Point start,
                                   const Point& stop) {
    constexpr double kNudgeMm = 1e-4;
    constexpr int kIterations = 8;
    const auto at = [&](double x, double y) { return tracer.trace(Bounces{}, light.ray(x, y)); };
    for (int i = 0;; ++i) {
        const TracedRay ray = at(start[0], start[1]);
        if (ray.fate != Fate::kArrived) return std::nullopt;
        if (i == kIterations) return Point{ray.x_mm, ray.y_mm};
        const TracedRay in_x = at(start[0] + kNudgeMm, start[1]);
        const TracedRay in_y = at(start[0], start[1] + kNudgeMm);
        if (in_x.fate != Fate::kArrived || in_y.fate != Fate::kArrived) return std::nullopt;
        const double xx = in_x.stop_x_mm - ray.stop_x_mm;
        const double yx = in_x.stop_y_mm - ray.stop_y_mm;
        const double xy = in_y.stop_x_mm - ray.stop_x_mm;
        const double yy = in_y.stop_y_mm - ray.stop_y_mm;
        const double det = xx * yy - xy * yx;
        if (det == 0) return std::nullopt;
        const double ex = stop[0] - ray.stop_x_mm;
        const double ey = stop[1] - ray.stop_y_mm;
        start[0] += kNudgeMm * (yy * ex - xy * ey) / det;
        start[1] += kNudgeMm * (xx * ey - yx * ex) / det;
    }
}

// Area on the sensor per solid angle of the scene, mm^2 / sr, around the image of `up`.
std::optional<double> area_per_solid_angle(const Tracer& tracer, double up, const Point& start,
                                           const Point& stop) {
    constexpr double kStep = 1e-4;  // radians; the error goes with its square
    const auto at = [&](double d_up, double d_aside) {
        return image_through(tracer, {up + d_up, d_aside}, start, stop);
    };
    const auto above = at(kStep, 0);
    const auto below = at(-kStep, 0);
    const auto right = at(0, kStep);
    const auto left = at(0, -kStep);
    if (!above || !below || !right || !left) return std::nullopt;
    const Point by_up = {(*above)[0] - (*below)[0], (*above)[1] - (*below)[1]};
    const Point by_aside = {(*right)[0] - (*left)[0], (*right)[1] - (*left)[1]};
    return std::abs(by_up[0] * by_aside[1] - by_up[1] * by_aside[0]) / (4 * kStep * kStep);
}

// One angle, without what is relative to the axis; `illumination` is the irradiance on the sensor
// over the radiance of the scene.
FieldPoint look_at(const Lens& lens, const Tracer& tracer, double angle_deg, double efl_mm,
                   int rays_per_side, double& illumination) {
    FieldPoint field;
    field.angle_deg = angle_deg;
    illumination = 0;
    const Direction light{rad_from_deg(angle_deg), 0};
    const auto box = beam_box(tracer, light, front_element(lens, light.up));
    if (!box) return field;
    const Beam beam = measure(tracer, light, *box, rays_per_side);
    field.open_area_mm2 = beam.area_mm2 * std::cos(light.up);
    field.transmission = beam.transmission;
    const TracedRay chief = tracer.trace(Bounces{}, light.ray(0, beam.middle_y_mm));
    if (chief.fate != Fate::kArrived) return field;
    // The image stands on its head.
    field.image_height_mm = -chief.y_mm;
    if (angle_deg > 0) field.distortion = field.image_height_mm / (efl_mm * std::tan(light.up)) - 1;
    const auto spread = area_per_solid_angle(tracer, light.up, {0, beam.middle_y_mm},
                                             {chief.stop_x_mm, chief.stop_y_mm});
    if (spread && *spread > 0) {
        illumination = field.open_area_mm2 * field.transmission / *spread;
    }
    return field;
}

}  // namespace

std::vector<FieldPoint> field_sweep(const Lens& lens, std::span<const double> angles_deg,
                                    double wavelength_nm, int rays_per_side) {
    for (const double angle : angles_deg) {
        if (angle >= 0 && angle < 90) continue;
        throw InvalidArgument("angle_deg", fmt::format("{}", angle), "must be in [0, 90)");
    }
    if (rays_per_side < 8 || rays_per_side > 4096) {
        throw InvalidArgument("rays_per_side", fmt::format("{}", rays_per_side),
                              "must be in [8, 4096]");
    }
    const Tracer tracer(lens, wavelength_nm);
    // In the plane of the angles, which for cylinders is not that of Lens::efl_mm().
    const double efl_mm = -1 / ghost_matrices(lens, Bounces{}, wavelength_nm).to_sensor.y.c;
    // The axis last: all else is relative to it.
    const std::size_t count = angles_deg.size();
    std::vector<FieldPoint> fields(count + 1);
    std::vector<double> illumination(count + 1);
    parallel_for(count + 1, [&](std::size_t i, int) {
        fields[i] = look_at(lens, tracer, i < count ? angles_deg[i] : 0, efl_mm, rays_per_side,
                            illumination[i]);
    });
    const double axis_area = fields[count].open_area_mm2;
    const double axis_illumination = illumination[count];
    fields.pop_back();
    for (std::size_t i = 0; i < count; ++i) {
        if (axis_area > 0) fields[i].relative_area = fields[i].open_area_mm2 / axis_area;
        if (axis_illumination > 0) {
            fields[i].relative_illumination = illumination[i] / axis_illumination;
        }
    }
    return fields;
}

}  // namespace aureole::lens
