#include "aureole/lens/trace.h"

#include <algorithm>
#include <cmath>

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
struct Crossing {
    const Step& step;
    const Face& face;
    Vector point;  // z from the first vertex
    Vector normal;
    Vector direction;  // in which light arrives
    double index_before = 1, index_after = 1;
    double cos_incidence = 1;
};

// Layers and indices are those from the front. A lossless stack reflects the same share of light
// that comes from behind at the angle that it refracts to (reciprocity).
Reflectance reflectance_at(const Crossing& at, double wavelength_nm) {
    double cosine = at.cos_incidence;
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

// Incoherent light as a coherency matrix (Born & Wolf 10.9) in the directions e and d x e across
// the ray; real, since phases between the two are left out.
class Polarisation {
  public:
    explicit Polarisation(const Vector& direction) {
        const Vector least =
            std::abs(direction[0]) < std::abs(direction[1]) ? Vector{1, 0, 0} : Vector{0, 1, 0};
        e_ = unit(cross(direction, least));
    }

    void cross_face(const Crossing& at, const Reflectance& r) {
        turn_to_plane(at);
        if (at.step.reflects) {
            // Both fields are mirrored as near normal incidence does it: seen along the new ray,
            // one of the two changes its sign.
            scale(r.s, r.p);
            ep_ = -ep_;
        } else {
            scale(1 - r.s, 1 - r.p);
        }
    }

    double energy() const { return ee_ + pp_; }

  private:
    // Makes e the direction across the plane of incidence.
    void turn_to_plane(const Crossing& at) {
        const Vector across = cross(at.direction, at.normal);
        const double length = std::sqrt(dot(across, across));
        // At normal incidence s and p are the same.
        if (length < 1e-12) return;
        const Vector s = scaled(across, 1 / length);
        const double cosine = dot(e_, s);
        const double sine = dot(cross(at.direction, e_), s);
        const double ee = cosine * cosine * ee_ + 2 * cosine * sine * ep_ + sine * sine * pp_;
        const double pp = sine * sine * ee_ - 2 * cosine * sine * ep_ + cosine * cosine * pp_;
        const double ep = (cosine * cosine - sine * sine) * ep_ + cosine * sine * (pp_ - ee_);
        e_ = s;
        ee_ = ee;
        pp_ = pp;
        ep_ = ep;
    }

    void scale(double e, double p) {
        ee_ *= e;
        pp_ *= p;
        ep_ *= std::sqrt(e * p);
    }

    Vector e_ = {};
    double ee_ = 0.5, pp_ = 0.5, ep_ = 0;
};

}  // namespace

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
        const double clip = std::hypot(point[0], point[1]) / face.semi_aperture_mm;
        if (face.stop) {
            result.stop_x_mm = point[0];
            result.stop_y_mm = point[1];
            result.stop_clip = std::max(result.stop_clip, clip);
        } else {
            result.housing_clip = std::max(result.housing_clip, clip);
        }
        Crossing at{.step = step,
                    .face = face,
                    .point = point,
                    .normal = hit->normal,
                    .direction = direction};
        at.index_before = indices_[step.backwards ? k + 1 : k];
        at.index_after = indices_[step.backwards ? k : k + 1];
        const double along_normal = dot(direction, hit->normal);
        at.cos_incidence = std::abs(along_normal);
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

double Tracer::throughput(const Bounces& bounces, const Ray& ray) const {
    Polarisation light(ray.direction);
    const TracedRay result = follow(bounces, ray, [&](const Crossing& at) {
        light.cross_face(at, reflectance_at(at, wavelength_nm_));
    });
    return result.fate == Fate::kArrived ? light.energy() : 0;
}

}  // namespace aureole::lens
