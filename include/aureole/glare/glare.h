// Applying a point spread function to pictures.
//
// A PSF of three channels spreads each colour by itself; a matrix (wave/psf.h) also leads light to
// other colours, as diffraction does with the light of a coloured source: kFft at full
// resolution and kDirect, with a dark surround, and grey pictures as if they were white.
//
// The result is linear and unclipped, and adds nothing to the energy:
//     out = in * PSF,
// and with a threshold, a matte or a gain g, for the light that makes glare,
//     light = matte * max(0, in - threshold),   out = in + g (light * PSF - light + b light),
// b the share that a flat field receives from beyond the border if there is light (Surround).
//
// Looks may let a tone curve decide what light is, and add glare without taking it from anywhere:
//     light = matte * max(0, curve(exposure in) - threshold) / exposure,   out = in + g (light *
//     PSF)
//
// Perspective: what is conserved is energy, radiance times the true solid angle W of a pixel, so
//     W(x) out(x) = sum over s of W(s) in(s) k(x - s),
// k being the energy kernel of a central source in true (tan) geometry. A flat field stays flat.
// How far this shift-invariant form is from the exact sum over angles: docs/glare.md.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "aureole/color/tone_curve.h"
#include "aureole/glare/energy.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::glare {

enum class Method {
    kFft,     // pruned Fourier transforms: cost independent of the kernel's content
    kDirect,  // the plain double sum: the oracle; for kernels of a few pixels
    // To within GlareOptions::cluster_error:
    kSprites,  // a kernel drawn for each light or cluster of lights (sprites.h): few lights, dim
               // elsewhere
    kHybrid,   // transforms with the near part of the kernel, sprites of its far part for the light
               // that matters there; or just transforms with a kernel that ends within the error
    kAuto,     // for each picture the one of kFft, kSprites, kHybrid that will be fastest: which
               // one depends on timings, so that results vary within the error between machines
};

// The names used on the command line: fft, direct, sprites, hybrid, auto. Throws InvalidArgument
// for any other.
Method method_from_name(std::string_view name);
std::string_view name_of(Method method) noexcept;

// Of kFft: how finely what lights send far away is computed. The kernel is split smoothly into near
// and far; near, out to 64 pixels or more, is applied to all light at full resolution, whatever is
// chosen here: so small lights and textures are as they are at full resolution. Far goes to a
// raster and back with weights that keep energy and centroid of every light: nothing moves in
// steps. How far the result is from kFull's is measured when the object is made, and is at most
// 1e-3 of the light (in the sense of GlareOptions::cluster_error); kernels for which it would be
// more, or that are too small for a raster to save anything, are applied at full resolution.
// docs/reduced_resolution.md derives it.
enum class Resolution {
    kFull,
    kHalf,     // a raster of 2 pixels
    kQuarter,  // of 4
};

// The names used on the command line: full, half, quarter. Throws InvalidArgument for any other.
Resolution resolution_from_name(std::string_view name);
std::string_view name_of(Resolution resolution) noexcept;

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
    Resolution resolution = Resolution::kFull;  // others: kFft only
    // Pixel values up to here make no glare, per channel and continuously (in the picture's
    // units); 0, the physical default, lets everything through.
    float threshold = 0;
    // Scales the scattered light; 1 conserves energy. >= 0.
    float gain = 1;
    // Whether apply() will be given a matte.
    bool matte = false;
    Surround surround = Surround::kDark;
    // Applied to the picture before the threshold, which is then one of the curve's results (0 to
    // 1): what is beyond the curve's white makes no more glare than white. None: the picture
    // itself.
    std::optional<color::ToneCurve> source_curve;
    float exposure_scale = 1;  // > 0; multiplies the picture before source_curve
    // Glare is added to the picture, and nothing is taken away where it comes from. Needs
    // Surround::kDark: there is nothing to make up for.
    bool added = false;
    // kSprites, kHybrid, kAuto: the error that clusters of lights, ends of sprites and light left
    // out may add up to: the sum over pixels and channels of solid angle times |difference| from
    // kFft, over the sum of that times |light|. In (0, 1).
    double cluster_error = 0.01;
    // Side of the largest clusters, a power of two up to sources::kMaxClusterSide; 1: none (but for
    // the far part of a large kernel).
    int cluster_side = 16;
};

// How the last picture was done.
struct MethodReport {
    enum class Reason {
        kAsked,      // no kAuto
        kNoGain,     // whatever the picture, nothing else can be faster
        kBlocks,     // light in too many places for sprites
        kSample,     // some blocks of pixels show too much of it
        kHistogram,  // all of them do
        kPredicted,  // lights were looked for, and costs compared
    };
    struct Candidate {
        Method method = Method::kFft;
        // kAuto only, corrected by what the last pictures took; of sprites, and of a hybrid with
        // something to plan, looking and planning included; 0: ruled out before.
        double predicted_seconds = 0;
        double actual_seconds = 0;  // when it was used last; 0: never
    };
    Method method = Method::kFft;
    Reason reason = Reason::kAsked;
    std::array<Candidate, 3> candidates = {Candidate{Method::kFft}, Candidate{Method::kSprites},
                                           Candidate{Method::kHybrid}};
    std::size_t sprites = 0;  // far ones included
    // The raster for the far part of the kernel; the same for all pictures.
    struct Raster {
        int scale = 1;        // pixels along a side of it; 1: there is none
        int near_radius = 0;  // pixels: where the near part ends
        double error = 0;     // over the sum of solid angle times |light|
    };
    Raster raster;
    // Both over the sum of solid angle times |light|.
    double error_bound = 0;
    double energy_cut = 0;  // at most, light that ended with sprites
};
std::string_view name_of(MethodReport::Reason reason) noexcept;

// Configured once per picture size, view and PSF; then applied as often as needed.
class Glare {
  public:
    // `channels` is 3 (RGB) or 1 (grey: the luminance of the PSF). The kernel may have any size;
    // what lies beyond it counts as off the picture. The PSF is not kept.
    // Throws InvalidArgument for other channel counts, negative threshold or gain, and when the
    // PSF was made for another pitch or projection than the view's (by more than 0.1 %), for
    // other options out of range, for a reduced resolution with other methods than kFft, and for a
    // matrix with another method, resolution or surround than above. kAuto times the methods for
    // some 100 ms, the first one of a process a little longer.
    Glare(const View& view, int channels, const wave::Psf& psf, const GlareOptions& options = {});
    ~Glare();
    Glare(Glare&&) noexcept;
    Glare& operator=(Glare&&) noexcept;

    // `in` and `out` have the view's size and the channels given; they may be the same memory.
    // `matte`: width * height factors, row-major; required if and only if options.matte.
    // Allocates nothing, except that kSprites, kHybrid and kAuto keep lists of lights, which grow
    // to what the picture with the most of them needs; not to be run from two threads at once.
    void apply(const ConstImageView& in, const ImageView& out,
               const float* matte = nullptr) noexcept;

    // Accounts for a picture and the result that apply() gave for it. Off-picture energy is
    // summed from the kernel itself (share_inside), not from the difference; what the last apply()
    // cut off is added as its bound, so that the balance holds to within error_bound.
    Energy energy(const ConstImageView& in, const ConstImageView& out,
                  const float* matte = nullptr) const;

    const MethodReport& last() const noexcept;

    // Size of the transforms, for reports: of kFft's for kAuto; the picture's own where there are
    // none.
    int padded_width() const noexcept;
    int padded_height() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::glare
