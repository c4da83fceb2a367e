// Direct summation of the Huygens-Fresnel integral: slow, free of approximations other than the
// scalar one, and therefore the oracle for everything that uses a Fourier transform.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "aureole/wave/aperture.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {

// E(x, y, z) = 1/(i lambda) sum E(x', y', 0) exp(i k r)/r (z/r) dx'^2 at each point of the plane
// at distance z behind the aperture, which a plane wave of amplitude 1 lights; |E|^2 is relative
// to the undisturbed intensity. Cost: open samples times points, about 30 ns each.
// The raster must resolve the phase: spacing < lambda r / (2 |x - x'|) for all pairs.
// Throws InvalidArgument if the field is zero everywhere or distance or wavelength are not
// positive.
std::vector<std::complex<double>> huygens_fresnel(const Field& field, double wavelength_nm,
                                                  double distance_mm,
                                                  std::span<const Point> points);

// The same as intensity in the direction of each point seen from the aperture's centre, in sr^-1
// of unit energy like the other propagations: |E|^2 R^2 / (cos(theta) A), R the distance from the
// centre, theta the angle from the axis, A = sum |field|^2 dx^2 the light that passes. (Energy per
// area of the plane is |E|^2 / A, and an area dS is seen under dS cos(theta) / R^2.)
std::vector<double> huygens_fresnel_per_sr(const Field& field, double wavelength_nm,
                                           double distance_mm, std::span<const Point> points);

}  // namespace aureole::wave
