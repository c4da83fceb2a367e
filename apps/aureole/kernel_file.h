// PSFs as files: EXR kernels that sum to the share of the energy they hold, for other tools and to
// be read back by `aureole glare --psf`.
#pragma once

#include <string>

#include "aureole/image/view.h"
#include "aureole/io/picture.h"
#include "aureole/wave/psf.h"

namespace aureole::app {

// Attributes: aureole:pitch_deg, aureole:projection (perspective or constant-pitch),
// aureole:off_kernel_energy (of the luminance) and aureole:off_kernel_energy_r, _g, _b.
io::Picture picture_of(const wave::Psf& psf);

// A kernel from any picture file, RGB or grey. Written by this program, it must have the view's
// pitch and projection; anyone else's kernel is taken as made for the view and as complete:
// nothing is normalised.
// Throws FileError also for a kernel of even size, for other pixels, or with NaN or infinities.
wave::Psf read_kernel(const std::string& path, const View& view);

// The kernel as people look at it: the logarithm of its density, 0.01 sr^-1 black to 10000 sr^-1
// white, hue kept, display values in [0, 1].
Image logarithmic_picture(const wave::Psf& psf);

}  // namespace aureole::app
