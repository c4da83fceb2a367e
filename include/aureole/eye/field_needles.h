// Needles that differ from place to place.
//
// Particles of cornea, lens and vitreous lie at different depths: light from elsewhere meets them
// displaced against each other, and its corona has other needles. In a picture of one PSF all stars
// look alike; here each takes the needles of the region it is in (the thesis on real-time glare
// asks for it in 5.1). docs/field_varying.md says how fast they change in an eye.
#pragma once

#include "aureole/base/progress.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/image/image.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::eye {

struct FieldNeedlesOptions {
    EyePsfOptions psf;  // those that psf.base was made with
    // Regions have the needles of their middles and are about this wide; one shades into the next
    // over a third of it. 2 to 60.
    double region_deg = 8;
    double reach_deg = 4;  // farther from a light its needles are those of the axis. 0.5 to 10
};

// S T', the energy in the needles of a light at `field` by pixels; the pixel of the light, which
// has none, is 0. Of unit energy if the grid, which is centred on the light, had no end.
// Throws InvalidArgument for an eye without a corona (no scatter, no particles, contrast 0).
Image needles_at(const Eye& eye, const FieldPosition& field, const wave::KernelGrid& grid,
                 const EyePsfOptions& options = {});

// Gives psf needles that differ. Its base must be the eye_psf() of the eye, with streaks or
// without, on KernelGrid::full_reach(psf.view); parts that psf has, like the streaks of
// eye_field_psf(), stay, and what they hold is taken from the needles as from all the rest. Every
// source pixel keeps unit energy. Takes 0.1 s a region on two cores.
// Throws as needles_at() does, for options outside their ranges, for light by colour and for a
// view wider or higher than 160 deg; Cancelled.
void vary_needles(wave::VaryingPsf& psf, const Eye& eye, const FieldNeedlesOptions& options = {},
                  Progress* progress = nullptr);

}  // namespace aureole::eye
