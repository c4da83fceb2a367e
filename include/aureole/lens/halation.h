// Halation: the bloom of a film, or of a sensor behind its cover glass.
//
// Light that the sensitive layer scatters into the clear layer beside it (the base of a film, the
// cover glass of a sensor) meets the far face of that layer, which returns some of it: little up
// to the critical angle, all beyond. It comes back around the point, at r = 2 d tan theta for a
// layer of thickness d (Cornu 1890). With the light of a Lambertian scatterer, 2 sin theta cos
// theta d theta, and t = r / 2d, the returned light per area is
//
//     H(r) = R(theta) / (4 pi d^2 (1 + t^2)^2) / R_mean
//     R    = F + (1 - F)^2 b / (1 - F b)
//
// F being Fresnel's reflectance from within and b that of what the layer lies on, such as the
// pressure plate of a camera (all reflections between the two summed up). b = 0 leaves a ring at
// the critical angle with a dark middle, b = 1 no ring: 1 / (1 + t^2)^2.
#pragma once

#include "aureole/wave/psf.h"

namespace aureole::lens {

struct HalationOptions {
    double share = 0.1;      // of the light that comes back around its point; [0, 1]
    double layer_mm = 0.13;  // thickness of the layer: .1 to .2 for films, .5 to 1 for glass;
                             // (0, 100]
    double refractive_index = 1.49;  // of the layer: cellulose acetate 1.48, glass 1.52; (1, 4]
    double backing = 0.5;            // reflectance of what it lies on; [0, 1]. 0: air, black
};

// (1 - share) delta + share H, of unit energy: sum(kernel) + off_kernel_energy is 1. Grey: the
// three channels are equal. `efl_mm`: focal length, from angles to distances on the film.
// Throws InvalidArgument for options out of range, a focal length that is not positive, a grid of
// even size or without pitch.
wave::Psf halation_psf(const HalationOptions& options, double efl_mm, const wave::KernelGrid& grid);

// Share of diffuse light that comes back, R_mean: .596 for n = 1.5 in air.
double diffuse_reflectance(double refractive_index, double backing = 0);

}  // namespace aureole::lens
