// From a book (flipbook.h) to the PSF of a moment.
#pragma once

#include <memory>

#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/flipbook.h"
#include "aureole/image/image.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// Plays a book for one eye and one kind of picture.
class FlipbookPlayer {
  public:
    // `eye` gives all that a book does not hold: age and the other parameters of the scatter.
    // `grid` is that of the PSFs, of any odd size: beyond the book's raster they are scatter alone.
    // Memory: about 12 floats per pixel of the raster; and for a quarter of the pixels of `grid`
    // one float, or one per texture pupil if the scatter knows the pupil (IJspeert). Throws
    // InvalidArgument if the eye, the pitch or the projection is not that of the book.
    FlipbookPlayer(const Flipbook& book, const Eye& eye, const SpectralSampling& sampling,
                   const wave::KernelGrid& grid);
    ~FlipbookPlayer();
    FlipbookPlayer(FlipbookPlayer&&) noexcept;
    FlipbookPlayer& operator=(FlipbookPlayer&&) noexcept;

    const wave::KernelGrid& grid() const noexcept;

    // The PSF of the eye as it is now: pupil, eyelid, pose, halo and streaks count. Outside the
    // book's range the nearest pose in it serves.
    //   texture: the nearest frame. A vitreous that has turned by (yaw, pitch, roll) steps is at
    //            phase yaw + 2 pitch + 3 roll, rounded each, in a loop over all phases: one
    //            particle pattern is as good as another, and neighbours differ. The lens counts at
    //            phase 0; behind lids its states are further steps of the loop
    //   halo:    between two pupils and two closures of lids
    //   streaks: between two pupils, two closures, and lashes alone and covering lids
    // `psf` must have grid()'s kernel of three channels. Its energy sums to 1, as eye_psf's.
    // Allocates nothing; the same bits on any number of threads; one thread at a time.
    void write(const Eye& now, wave::Psf& psf) noexcept;

    // One term alone, relative to the envelope, over the book's raster: S (T' - 1) / e, H / e or
    // w_e E / e. For measuring errors. `out`: three channels of the raster's size.
    void write_term(Component component, const Eye& now, const ImageView& out) noexcept;
    // e, one channel of the raster's size.
    const Image& envelope() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::eye
