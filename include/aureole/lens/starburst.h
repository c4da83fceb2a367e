// The star that an iris makes of a bright point: the PSF of a camera.
//
// Fraunhofer diffraction of the iris at the size of the entrance pupil, D = f / N, by the same code
// as the eye's (wave/diffraction.h, wave/spectral_psf.h): seen as angles in the scene, the pattern
// of an opening of width D has its first zero about lambda / D away from the source.
// docs/starburst.md derives it.
#pragma once

#include "aureole/base/progress.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/iris.h"
#include "aureole/wave/psf.h"

namespace aureole::lens {

struct StarburstOptions {
    int samples = 4096;  // of the aperture raster, per side; 256 to 16384, 7-smooth and even
    int bands = 0;       // of the spectrum; 0: as many as keep neighbouring bands a pixel apart
    color::Illuminant illuminant = color::Illuminant::kD65;
};

// Unit energy: sum(kernel) + off_kernel_energy is 1 in every colour. Beyond the reach of the raster
// (a quarter of lambda samples / extent of the raster, about 400 pixels at most) the pattern is
// continued by its own law for apertures with edges, energy per solid angle ~ theta^-3 along every
// direction; spikes of straight blades keep their width. `occluder` may be null: dirt on the front
// element, of which the entrance pupil sees its middle. Pictures of irises and of dirt are taken as
// transmission of amplitude: 0 and 1 mean the same either way, .5 lets a quarter of the energy
// through.
// 4096 samples need about 210 MB beside the kernel.
// Throws InvalidArgument (pupil diameter not positive, a grid of even size or without pitch,
// options, nothing open), Cancelled.
wave::Psf starburst_psf(const Iris& iris, double pupil_diameter_mm, const wave::KernelGrid& grid,
                        const StarburstOptions& options = {}, const Occluder* occluder = nullptr,
                        Progress* progress = nullptr);

}  // namespace aureole::lens
