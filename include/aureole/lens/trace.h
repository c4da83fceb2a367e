// Exact rays through a lens: the reference for everything faster.
//
// Refraction and reflection in vector form at the exact intersection with sphere, plane, conic,
// even asphere (Newton from the conic) or cylinder; double precision. Apertures do not end a ray:
// it goes on, and how far outside it was is reported, so that boundaries can be found between rays.
#pragma once

#include <array>
#include <vector>

#include "aureole/lens/ghosts.h"
#include "aureole/lens/lens.h"

namespace aureole::lens {

using Vector = std::array<double, 3>;  // x, y, z; mm or a unit direction

struct Ray {
    Vector origin = {};            // mm
    Vector direction = {0, 0, 1};  // unit
};

// The ray of a light at infinity in direction (tan_x, tan_y) that crosses the plane of the first
// vertex (z = 0) at (x, y).
Ray ray_from_light(double tan_x, double tan_y, double x_mm, double y_mm);

enum class Fate {
    kArrived,          // at the plane of the sensor, whatever apertures were in the way
    kMissed,           // never met a surface of its way, or met it from the wrong side
    kTotalReflection,  // where it should have been refracted
    kTurned,           // travels away from the sensor or the next face
};

struct TracedRay {
    Fate fate = Fate::kMissed;
    int failed_face = -1;       // where, unless it arrived
    double x_mm = 0, y_mm = 0;  // on the sensor
    Vector direction = {};      // there
    // At the stop, last crossing, in mm.
    double stop_x_mm = 0, stop_y_mm = 0;
    // The largest of r / semi_aperture over all crossings of faces other than the stop, and of the
    // stop's crossings as a circle: at most 1 for a ray that passes.
    double housing_clip = 0;
    double stop_clip = 0;
    bool passes() const { return fate == Fate::kArrived && housing_clip <= 1 && stop_clip <= 1; }
};

// What a ray meets at one face.
struct Incidence {
    Step step;
    Vector point = {};      // z from the first vertex
    Vector normal = {};     // unit, of the surface
    Vector direction = {};  // in which light arrives
    double cosine = 1;      // of the angle of incidence, >= 0
};

class Tracer {
  public:
    // Keeps a copy of what it needs.
    Tracer(const Lens& lens, double wavelength_nm);

    // The way of `bounces` from the given ray. `path`, if given, receives the points at the faces
    // and on the sensor, the origin first; of a ray that ends before, up to where it was refused.
    TracedRay trace(const Bounces& bounces, const Ray& ray,
                    std::vector<Vector>* path = nullptr) const;
    // The same; `incidences` receives what it meets at each crossing up to where it ends.
    TracedRay trace(const Bounces& bounces, const Ray& ray,
                    std::vector<Incidence>& incidences) const;
    // The share of energy that is left of a ray of unpolarised light when it arrives: the product
    // of R or T = 1 - R at the real angles of all crossings, R at the two bounces; both
    // polarisations are carried through the turning planes of incidence of a skew ray (without
    // the phase between them). 0 for a ray that does not arrive; apertures play no part.
    double throughput(const Bounces& bounces, const Ray& ray) const;

  private:
    // Calls `visit` at every crossing (trace.cpp).
    template <class Visit>
    TracedRay follow(const Bounces& bounces, const Ray& ray, Visit&& visit) const;

    std::vector<Face> faces_;
    std::vector<double> indices_;
    double sensor_z_mm_ = 0;
    double wavelength_nm_ = 0;
};

}  // namespace aureole::lens
