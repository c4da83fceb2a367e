// The streaks of one eye for many lights, two at a time: lashes and lids are real masks, so that
// one complex transform carries those of two positions.
#pragma once

#include <span>
#include <vector>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/fourier/fft.h"
#include "aureole/image/image.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"
#include "eye/spectral_levels.h"

namespace aureole::eye {

class FieldStreaks {
  public:
    FieldStreaks(const Eye& eye, const wave::KernelGrid& grid, const wave::ApertureGrid& raster,
                 const SpectralSampling& sampling);

    struct Streaks {
        Image kernel;      // of the grid's size, of energy `share` over the raster's band
        double share = 0;  // of the light, in streaks
    };
    // At one or two positions. All 0 where no lash lies before the pupil.
    std::vector<Streaks> at(std::span<const FieldPosition> fields);

  private:
    // The part of lashes before the pupil.
    struct Blocked {
        wave::Mask mask;
        double share = 0;  // of the pupil's area
    };
    Blocked blocked(const FieldPosition& field) const;
    Image onto_pixels(const wave::Field& amplitude, double share) const;

    const Eye& eye_;
    wave::KernelGrid grid_;
    wave::ApertureGrid raster_;
    std::vector<SpectralLevel> levels_;
    fourier::Fft2d fft_;
    wave::Field amplitude_;  // its imaginary part stays 0
};

// The smallest raster, of at least this band and at most that of `most`, whose pattern is right
// when it is summed over pixels of the grid: a transform of extent L gives the correlation of the
// mask with itself at distances above L - D too strong (D: diameter of the pupil), but in pixels of
// width p nothing is left of distances well above lambda / p.
wave::ApertureGrid streak_raster(const Eye& eye, const wave::KernelGrid& grid, double reach_deg,
                                 const wave::ApertureGrid& most);

}  // namespace aureole::eye
