// The fibres of the eye's lens: a radial grating that delays (and may absorb) light. It makes the
// lenticular halo (Ritschel et al. 2009, "Temporal Glare"; Simpson 1953).
//
// The amplitude behind the fibres is
//     t(r, phi) = [1 - opacity w(r) (1 + cos u) / 2] exp(i phase w(r) cos u),
//     u = fibres phi + jitter(phi),
// with w a smooth step from 0 at inner_radius to 1 at full_radius. Each sample gets the *mean* of
// t over its square in closed form: by Jacobi-Anger, exp(i a cos u) = J0(a) + 2 sum_k i^k J_k(a)
// cos(k u), and the mean of cos(k u) over a square is cos(k u) times two sinc factors of the local
// frequency. Harmonics that the raster cannot resolve therefore fade out instead of aliasing.
#pragma once

#include <vector>

#include "aureole/wave/aperture.h"

namespace aureole::wave {

struct RadialGrating {
    double fibres = 1740;          // per turn, > 0; an integer, or the pattern has a seam at -x
    double phase_rad = 0.175;      // amplitude of the phase, in [0, 30]
    double opacity = 0;            // amplitude absorbed by the darkest lines, in [0, 1]
    double inner_radius_mm = 1.8;  // >= 0
    double full_radius_mm = 3.2;   // > inner_radius_mm
    // Displacement of the fibres in radians of u, equally spaced over one turn starting at
    // phi = -pi, periodic, linear in between. Empty: none.
    std::vector<float> jitter_rad;
};

// Multiplies the field by the grating. Samples that are zero are skipped, so draw the pupil first.
// Throws InvalidArgument for values outside the ranges above.
void multiply_radial_grating(Field& field, const RadialGrating& grating);

// The smallest period among the fibres inside radius r is at the inner edge; at radius r it is
// 2 pi r / fibres (mm). A raster resolves it when the period is at least two samples.
double grating_period_mm(double fibres, double radius_mm);

}  // namespace aureole::wave
