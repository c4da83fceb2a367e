// Environments as a few coefficients of real spherical harmonics.
//
// Basis (as in Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment
// Maps", and most engines): orthonormal over the sphere, without the Condon-Shortley phase, polar
// axis z, so that with (x, y, z) the unit vector
//
//     Y_0,0 = .282095,   Y_1,-1 = .488603 y,   Y_1,0 = .488603 z,   Y_1,1 = .488603 x,
//     Y_2,-2 = 1.092548 xy,   Y_2,-1 = 1.092548 yz,   Y_2,0 = .315392 (3 z^2 - 1),
//     Y_2,1 = 1.092548 xz,   Y_2,2 = .546274 (x^2 - y^2)
//
// and so on. x, y, z are those of cube_map.h, where +Y is up: the basis does not know. Coefficient
// l^2 + l + m belongs to Y_l,m. Bands l = 0 to 4: 1, 4, 9, 16 or 25 coefficients for 1 to 5 bands.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

inline constexpr int kMostShBands = 5;
inline constexpr int kMostShCoefficients = kMostShBands * kMostShBands;

// Y of every coefficient in the direction of a unit vector; those of the first n bands are its
// first n^2 values.
std::array<double, kMostShCoefficients> sh_basis(const Direction& unit);

// A function over the sphere: the sum of coefficients times Y.
struct SphericalHarmonics {
    int bands = 0;
    std::vector<std::array<double, 3>> coefficients;  // R, G, B; bands^2 of them
};

// Coefficients of the radiance of an environment: the integrals of radiance times Y over all
// texels, to about 1e-6 of the environment's mean. Throws InvalidArgument for an empty environment
// and unless bands is in [1, 5].
SphericalHarmonics project_to_sh(const CubeMap& environment, int bands);

// Coefficients of the irradiance E under a radiance: band l times A_l = pi, 2 pi / 3, pi / 4, 0,
// -pi / 24 (Ramamoorthi & Hanrahan 2001, eq. 8). Not divided by pi; see irradiance.h. With three
// bands E is within .5 % of its largest value under an overcast sky, and 6 to 9 % in rooms with
// small lights and under a sun.
SphericalHarmonics irradiance_of_sh(const SphericalHarmonics& radiance);

// The value in the direction of a unit vector, R, G, B. May be negative: a sun rings.
std::array<double, 3> evaluate_sh(const SphericalHarmonics& sh, const Direction& unit) noexcept;

// Windows that weaken higher bands, against ringing (Sloan 2008, "Stupid Spherical Harmonics (SH)
// Tricks"). Both give 1 at l = 0 and nothing from l = cutoff on:
enum class ShWindow {
    kNone,
    kHann,     // (1 + cos(pi l / cutoff)) / 2
    kLanczos,  // sin(pi l / cutoff) / (pi l / cutoff)
};
inline constexpr std::array<std::string_view, 3> kShWindowNames = {"none", "hann", "lanczos"};

// Throws InvalidArgument unless cutoff > 0; it may be fractional. About the number of bands is
// usual, more is weaker. kNone ignores it.
SphericalHarmonics windowed(const SphericalHarmonics& sh, ShWindow window, double cutoff);

// The largest cutoff, up to 16 times the number of bands, with which `sh` is nowhere negative in
// any channel, to three digits: the weakest window that removes ringing below zero (after Sloan
// 2017, "Deringing Spherical Harmonics"). Without need, that is 16 times the number of bands. The
// mean over the sphere of every channel must be >= 0. Throws InvalidArgument for kNone.
double deringing_cutoff(const SphericalHarmonics& sh, ShWindow window);

}  // namespace aureole::ibl
