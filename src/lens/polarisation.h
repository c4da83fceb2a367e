// Incoherent light as a coherency matrix (Born & Wolf 10.9) in two directions across the ray, e and
// d x e; real, since phases between the two are left out. The directions are those of the ray alone
// and serve all wavelengths that take its way.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "aureole/lens/trace.h"

namespace aureole::lens {

class PolarisationFrame {
  public:
    // Cosine and sine of the angle from the old e to the new one.
    struct Turn {
        double cosine = 1;
        double sine = 0;
    };

    explicit PolarisationFrame(const Vector& direction);

    // Makes e the direction across the plane of incidence.
    Turn turn_to_plane(const Vector& direction, const Vector& normal);

  private:
    Vector e_ = {};
};

// Of N wavelengths; starts as unpolarised light of unit energy.
template <class Real, std::size_t N>
class Coherency {
  public:
    using Values = std::array<Real, N>;

    Coherency() {
        ee_.fill(Real(0.5));
        pp_.fill(Real(0.5));
    }

    void turn(const PolarisationFrame::Turn& by) {
        if (by.sine == 0) return;
        const auto cc = static_cast<Real>(by.cosine * by.cosine);
        const auto ss = static_cast<Real>(by.sine * by.sine);
        const auto cs = static_cast<Real>(by.cosine * by.sine);
        for (std::size_t i = 0; i < N; ++i) {
            const Real ee = ee_[i];
            const Real pp = pp_[i];
            const Real cross = 2 * cs * ep_[i];
            ee_[i] = cc * ee + cross + ss * pp;
            pp_[i] = ss * ee - cross + cc * pp;
            ep_[i] = (cc - ss) * ep_[i] + cs * (pp - ee);
        }
    }
    // By reflectances. Both fields are mirrored as near normal incidence does it: seen along the
    // new ray, one of the two changes its sign.
    void reflect(const Values& s, const Values& p) {
        for (std::size_t i = 0; i < N; ++i) scale(i, s[i], p[i], -1);
    }
    void transmit(const Values& s, const Values& p) {
        for (std::size_t i = 0; i < N; ++i) scale(i, 1 - s[i], 1 - p[i], 1);
    }
    Real energy(std::size_t i) const { return ee_[i] + pp_[i]; }

  private:
    void scale(std::size_t i, Real e, Real p, Real sign) {
        ee_[i] *= e;
        pp_[i] *= p;
        ep_[i] *= sign * std::sqrt(e * p);
    }

    Values ee_, pp_, ep_ = {};
};

}  // namespace aureole::lens
