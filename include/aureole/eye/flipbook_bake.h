// Baking a book (flipbook.h), and measuring what it is worth.
#pragma once

#include <cstddef>
#include <vector>

#include "aureole/base/progress.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/flipbook.h"

namespace aureole::eye {

// The bytes of a book: a file, or memory for Flipbook. `raster` is square and odd, one less than an
// even 7-smooth number from 64 to 4096 (511: 0.79 MB per frame); its pitch and projection are those
// of the pictures. Patterns that the raster cuts fade out over the last eighth of its half width,
// and their energy stays in the bloom.
// Pupil, eyelid, pose, halo and streaks of `eye` do not matter. The bytes are the same on any
// number of threads. Takes a PSF component per frame. Throws InvalidArgument for values outside
// their ranges and for ScatterModel::kNone (an Airy pattern has no envelope that is not zero
// somewhere), Cancelled.
std::vector<std::byte> bake_flipbook(const Eye& eye, const wave::KernelGrid& raster,
                                     const FlipbookRange& range = {},
                                     const EyePsfOptions& options = {},
                                     Progress* progress = nullptr);

// Root mean squares of differences from direct computation (eye_psf), over that of what should be,
// in an annulus around the source and relative to the scatter there, all colours together.
struct FlipbookErrors {
    // The annulus. It ends where patterns are no longer whole, if that is nearer than 5 deg: small
    // rasters let them fade out. No pose is measured if nothing is left of it.
    double from_deg = 0.3;
    double to_deg = 5;
    int poses = 0;
    double texture = 0;  // of T' - 1; two patterns that have nothing in common differ by sqrt(2)
    double halo = 0;
    double streaks = 0;
    double psf = 0;         // of the whole PSF
    double worst_ring = 0;  // of the whole PSF, in the worst ring of a tenth of a degree
};

enum class FlipbookLids {
    kOpen,      // they cover nothing, but lashes may come down (Pose::lash_closure)
    kCovering,  // Eye::eyelid; no pose of a book that has open lids only
};

// At frames of the book: each pose has stored frames for all three terms.
FlipbookErrors errors_at_frames(const Flipbook& book, const Eye& eye, const EyePsfOptions& options,
                                FlipbookLids lids, int poses, Progress* progress = nullptr);
// At random poses within its range: any pupil, lens within its span, a vitreous turned by up to a
// degree, lids or lashes closed by up to the largest closure.
FlipbookErrors errors_between_frames(const Flipbook& book, const Eye& eye,
                                     const EyePsfOptions& options, FlipbookLids lids, int poses,
                                     Progress* progress = nullptr);

}  // namespace aureole::eye
