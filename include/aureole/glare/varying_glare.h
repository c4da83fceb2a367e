// Applying a point spread function that changes over the picture:
//
//     out(x) = sum over s of K_s(x - s) in(s),
//
// weighted by solid angles in perspective as glare.h says, with the kernel K_s of each source pixel
// (wave/varying_psf.h): one convolution of (1 - e) in with the part that is the same everywhere,
// and one by nodes with the part that changes. Linear, without threshold; energy is conserved.
#pragma once

#include <memory>

#include "aureole/glare/energy.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::glare {

// Configured once per PSF; then applied as often as needed.
class VaryingGlare {
  public:
    // For pictures as large as psf.view. `channels` is 3 (RGB) or 1 (grey: the luminance of the
    // PSF). Throws InvalidArgument for other channel counts, for a base that was made for another
    // pitch or projection than the view's (by more than 0.1 %), and as VaryingConvolver does.
    VaryingGlare(int channels, const wave::VaryingPsf& psf);
    ~VaryingGlare();
    VaryingGlare(VaryingGlare&&) noexcept;
    VaryingGlare& operator=(VaryingGlare&&) noexcept;

    // `in` and `out` have the view's size and the channels given; they may be the same memory.
    // Allocates nothing; not to be run from two threads at once.
    void apply(const ConstImageView& in, const ImageView& out) noexcept;

    // Accounts for a picture and the result that apply() gave for it. Off-picture energy is summed
    // from the kernels of all nodes, not from the difference.
    Energy energy(const ConstImageView& in, const ConstImageView& out) const;

    // Size of the transforms of the part that is the same everywhere, for reports.
    int padded_width() const noexcept;
    int padded_height() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::glare
