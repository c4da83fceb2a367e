#include "aureole/lens/trace.h"

#include <algorithm>
#include <cmath>

#include "lens/polarisation.h"
#include "lens/sag.h"
#include "lens/steps.h"

namespace aureole::lens {
namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector scaled(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector unit(const Vector& v) { return scaled(v, 1 / std::sqrt(dot(v, v))); }

// What happens to a ray at one face.
struct Crossing : Incidence {
    const Face& face;
    double index_before = 1, index_after = 1;
};

// Layers and indices are those from the front. A lossless stack reflects the same share of light
// that comes from behind at the angle that it refracts to (reciprocity).
Reflectance reflectance_at(const Crossing& at, double wavelength_nm) {
    double cosine = at.cosine;
    double front = at.index_before;
    double back = at.index_after;
    if (at.step.backwards) {
        const double sine = at.index_before / at.index_after;
        const double cos2 = 1 - sine * sine * (1 - cosine * cosine);
        if (cos2 < 0) return {1, 1};
        cosine = std::sqrt(cos2);
        std::swap(front, back);
    }
    return reflectance(front, back, at.face.coating, wavelength_nm, cosine);
}

}  // namespace

PolarisationFrame::PolarisationFrame(const Vector& direction) {
    const Vector least =
        std::abs(direction[0]) < std::abs(direction[1]) ? Vector{1, 0, 0} : Vector{0, 1, 0};
    e_ = unit(cross(direction, least));
}

PolarisationFrame::Turn PolarisationFrame::turn_to_plane(const Vector& direction,
                                                         const Vector& normal) {
    const Vector across = cross(direction, normal);
    const double length = std::sqrt(dot(across, across));
    // At normal incidence s and p are the same.
    if (length < 1e-12) return {};
    const Vector s = scaled(across, 1 / length);
    const Turn turn = {dot(e_, s), dot(cross(direction, e_), s)};
    e_ = s;
    return turn;
}

Ray ray_from_light(double tan_x, double tan_y, double x_mm, double y_mm) {
    return {{x_mm, y_mm, 0}, unit({-tan_x, -tan_y, 1})};
}

Tracer::Tracer(const Lens& lens, double wavelength_nm)
    : faces_(lens.faces().begin(), lens.faces().end()),
      indices_(lens.indices(wavelength_nm)),
      sensor_z_mm_(lens.sensor_z_mm()),
      wavelength_nm_(wavelength_nm) {}

template <class Visit>
TracedRay Tracer::follow(const Bounces& bounces, const Ray& ray, Visit&& visit) const {
    const int count = static_cast<int>(faces_.size());
    validate_bounces(count, bounces);
    TracedRay result;
    result.fate = Fate::kArrived;
    Vector point = ray.origin;
    Vector direction = ray.direction;
    const auto end = [&](const Step& step, Fate fate) {
        result.fate = fate;
        result.failed_face = step.face;
        return false;
    };
    visit_steps(count, bounces, [&](const Step& step) {
        const auto k = static_cast<std::size_t>(step.face);
        const Face& face = faces_[k];
        if (step.backwards ? direction[2] >= 0 : direction[2] <= 0) return end(step, Fate::kTurned);
        const auto hit = intersect(face, {point[0], point[1], point[2] - face.z_mm}, direction);
        if (!hit) return end(step, Fate::kMissed);
        point = {hit->point[0], hit->point[1], hit->point[2] + face.z_mm};
        const double clip =
            std::sqrt(point[0] * point[0] + point[1] * point[1]) / face.semi_aperture_mm;
        if (face.stop) {
            result.stop_x_mm = point[0];
            result.stop_y_mm = point[1];
            result.stop_clip = std::max(result.stop_clip, clip);
        } else {
            result.housing_clip = std::max(result.housing_clip, clip);
        }
        const double along_normal = dot(direction, hit->normal);
        const Crossing at{{step, point, hit->normal, direction, std::abs(along_normal)},
                          face,
                          indices_[step.backwards ? k + 1 : k],
                          indices_[step.backwards ? k : k + 1]};
        visit(at);
        if (step.reflects) {
            direction = sum(direction, scaled(hit->normal, -2 * along_normal));
        } else if (at.index_before != at.index_after) {
            // Snell's law in vectors (Welford 1986, 4.3).
            const double ratio = at.index_before / at.index_after;
            const double cos2 = 1 - ratio * ratio * (1 - along_normal * along_normal);
            if (cos2 < 0) return end(step, Fate::kTotalReflection);
            const double refracted = std::copysign(std::sqrt(cos2), along_normal);
            direction = sum(scaled(direction, ratio),
                            scaled(hit->normal, refracted - ratio * along_normal));
        }
        return true;
    });
    if (result.fate != Fate::kArrived) return result;
    if (direction[2] <= 0) {
        result.fate = Fate::kTurned;
        result.failed_face = count - 1;
        return result;
    }
    const double t = (sensor_z_mm_ - point[2]) / direction[2];
    result.x_mm = point[0] + t * direction[0];
    result.y_mm = point[1] + t * direction[1];
    result.direction = direction;
    return result;
}

TracedRay Tracer::trace(const Bounces& bounces, const Ray& ray, std::vector<Vector>* path) const {
    if (!path) return follow(bounces, ray, [](const Crossing&) {});
    path->assign(1, ray.origin);
    const TracedRay result =
        follow(bounces, ray, [&](const Crossing& at) { path->push_back(at.point); });
    if (result.fate == Fate::kArrived) path->push_back({result.x_mm, result.y_mm, sensor_z_mm_});
    return result;
}

TracedRay Tracer::trace(const Bounces& bounces, const Ray& ray,
                        std::vector<Incidence>& incidences) const {
    incidences.clear();
    return follow(bounces, ray, [&](const Crossing& at) { incidences.push_back(at); });
}

double Tracer::throughput(const Bounces& bounces, const Ray& ray) const {
    PolarisationFrame frame(ray.direction);
    Coherency<double, 1> light;
    const TracedRay result = follow(bounces, ray, [&](const Crossing& at) {
        const Reflectance r = reflectance_at(at, wavelength_nm_);
        light.turn(frame.turn_to_plane(at.direction, at.normal));
        at.step.reflects ? light.reflect({r.s}, {r.p}) : light.transmit({r.s}, {r.p});
    });
    return result.fate == Fate::kArrived ? light.energy(0) : 0;
}

}  // namespace aureole::lens
