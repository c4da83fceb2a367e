// The parts of the eye as the thesis draws them: each alone, white on black (section 3.3,
// "Rendering Anatomy Components Separately"), with exact coverage where it says supersampling.
#pragma once

#include "aureole/eye/thesis_glare.h"
#include "aureole/wave/aperture.h"

namespace aureole::eye {

// Twice the widest pupil, 9 mm (eq. 2.13): |FFT|^2 needs that much. The thesis has 512 samples and
// ends where its pattern does; twice as many let each wavelength reach the end of the texture.
inline constexpr wave::ApertureGrid kThesisAperture = {1024, 18};

wave::Mask thesis_mask(Component component, const ThesisLook& look, const ThesisFrames& frames);

}  // namespace aureole::eye
