// One ghost in linear optics, as what its light meets on the way seen in iris coordinates.
//
// Crossing k has height a_k p + b_k s, p being the entrance height and s the slope of the light,
// in each meridian. At the stop, (u, v) = height / stop radius. Solving for p there,
//     p   = (R u - b_s s) / a_s                                      (R: the stop's radius)
//     X   = (A R / a_s) u + (B - A b_s / a_s) s                      on the sensor
//     u_k = gamma_k s,  gamma_k = (b_s - a_s b_k / a_k) / R          the centre of housing k, and
//     rho_k = r_k |a_s / a_k| / R                                    its radius,
// so that a light only shifts what is computed here once.
#pragma once

#include <vector>

#include "aureole/lens/ghosts.h"
#include "aureole/lens/iris.h"
#include "lens/film.h"

namespace aureole::lens {

// An aperture other than that of the stop's last crossing.
struct ClipPath {
    double gamma_x = 0, gamma_y = 0;    // centre per slope of the light
    double radius_u = 1, radius_v = 1;  // of an iris signed: < 0 is mirrored
    bool iris = false;                  // one of the first two of three crossings of the stop
    double shift_x = 0, shift_y = 0;    // of its edge in the picture per slope, px

    // Radii of the discs inside and outside its edge.
    double inner(const Iris& shape) const;
    double outer(const Iris& shape) const;
};

struct MatrixPath {
    Bounces bounces;
    double shift_x = 0, shift_y = 0;                    // of the iris in the picture per slope, px
    double u_per_px = 0, v_per_px = 0;                  // picture x to the right, y downwards
    double entrance_x = 0, entrance_y = 0;              // p per iris unit, mm
    double entrance_shift_x = 0, entrance_shift_y = 0;  // p per slope at the iris's centre, mm
    // Of a system that is the same in both meridians: beyond largest_slope all light is blocked,
    // below free_slope nothing but the iris clips, and `clips`, in rising order of gamma, are those
    // that are not inside others at every slope between. Else all clips, and slopes to 80 deg.
    bool round = false;
    double largest_slope = 0;
    double free_slope = 0;
    std::vector<ClipPath> clips;
};

// The largest tangent of a field angle that is placed at all: 80 deg.
inline constexpr double kLargestSlope = 5.671281819617709;

MatrixPath matrix_path(const Lens& lens, const Iris& iris, const Film& film,
                       const Bounces& bounces);

}  // namespace aureole::lens
