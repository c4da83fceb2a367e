// The terms of an eye's PSF, as flipbooks store them: relative to an envelope.
#pragma once

#include "aureole/eye/eye_psf.h"
#include "aureole/eye/flipbook.h"
#include "aureole/image/image.h"
#include "eye/scatter_pixels.h"

namespace aureole::eye {

// The eye of a frame.
Eye eye_at(const Eye& eye, const FlipbookFrame& frame);

// The angle from the source up to which a book has whole patterns; farther out they fade, or the
// raster has corners only.
double flipbook_whole_to_deg(const wave::KernelGrid& raster, const wave::ApertureGrid& aperture);

// e: the scatter of the book's middle pupil, one channel; within 2 pixels of the source as 2 pixels
// away from it. There the scatter holds most of all energy: it would make a loss of energy of what
// rounding leaves.
Image flipbook_envelope(const Eye& eye, const FlipbookRange& range, const wave::KernelGrid& raster);

struct FlipbookTerm {
    Image relative;  // S (T' - 1) / e, H / e or w_e E / e; empty if weight is 0
    double weight = 0;
};
// kCorona, kHalo or kStreaks; halo and streaks of the eye do not matter.
FlipbookTerm flipbook_term(Component component, const Eye& eye, const Image& envelope,
                           const wave::KernelGrid& raster, const EyePsfOptions& options);

}  // namespace aureole::eye
