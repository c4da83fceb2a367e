// Applying a point spread function to pictures.
//
// The result is linear and unclipped, and adds nothing to the energy:
//     out = in * PSF,
// and with a threshold, a matte or a gain g, for the light that makes glare,
//     light = matte * max(0, in - threshold),   out = in + g (light * PSF - light + b light),
// b the share that a flat field receives from beyond the border if there is light (Surround).
//
// Perspective: what is conserved is energy, radiance times the true solid angle W of a pixel, so
//     W(x) out(x) = sum over s of W(s) in(s) k(x - s),
// k being the energy kernel of a central source in true (tan) geometry. A flat field stays flat.
// How far this shift-invariant form is from the exact sum over angles: docs/glare.md.
#pragma once

#include <memory>
#include <string_view>

#include "aureole/glare/energy.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::glare {

enum class Method {
    kFft,     // pruned Fourier transforms: cost independent of the kernel's content
    kDirect,  // the plain double sum: the oracle; for kernels of a few pixels
};

// The names used on the command line: fft, direct. Throws InvalidArgument for any other.
Method method_from_name(std::string_view name);

// What lies beyond the picture's border.
enum class Surround {
    kDark,  // nothing: the physics of a picture that is all there is. Pixels at the border lose
            // light and receive none
    kSame,  // for each pixel, surroundings as bright as itself: what a flat field would receive
            // from beyond the border, (1 - flat * PSF) light, is added. Borders do not darken, and
            // lights are not repeated
};

// The names used on the command line: dark, same. Throws InvalidArgument for any other.
Surround surround_from_name(std::string_view name);

struct GlareOptions {
    Method method = Method::kFft;
    // Pixel values up to here make no glare, per channel and continuously (in the picture's
    // units); 0, the physical default, lets everything through.
    float threshold = 0;
    // Scales the scattered light; 1 conserves energy. >= 0.
    float gain = 1;
    // Whether apply() will be given a matte.
    bool matte = false;
    Surround surround = Surround::kDark;
};

// Configured once per picture size, view and PSF; then applied as often as needed.
class Glare {
  public:
    // `channels` is 3 (RGB) or 1 (grey: the luminance of the PSF). The kernel may have any size;
    // what lies beyond it counts as off the picture. The PSF is not kept.
    // Throws InvalidArgument for other channel counts, negative threshold or gain, and when the
    // PSF was made for another pitch or projection than the view's (by more than 0.1 %).
    Glare(const View& view, int channels, const wave::Psf& psf, const GlareOptions& options = {});
    ~Glare();
    Glare(Glare&&) noexcept;
    Glare& operator=(Glare&&) noexcept;

    // `in` and `out` have the view's size and the channels given; they may be the same memory.
    // `matte`: width * height factors, row-major; required if and only if options.matte.
    // Allocates nothing; not to be run from two threads at once.
    void apply(const ConstImageView& in, const ImageView& out,
               const float* matte = nullptr) noexcept;

    // Accounts for a picture and the result that apply() gave for it. Off-picture energy is
    // summed from the kernel itself (share_inside), not from the difference.
    Energy energy(const ConstImageView& in, const ConstImageView& out,
                  const float* matte = nullptr) const;

    // Size of the transforms, for reports; the picture's own for Method::kDirect.
    int padded_width() const noexcept;
    int padded_height() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::glare
