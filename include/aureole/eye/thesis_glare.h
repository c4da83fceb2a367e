// The glare of the thesis (Delavennat 2021, "Physically-based Real-time Glare"): a look, not
// physics. Four parts of the eye, each drawn alone, white on black; their diffraction patterns in
// colour; a tone curve for each pattern; and their weighted sum:
//
//     g = 1 bloom + .75 halo + .5 streaks + 1 corona                                  (eq. 3.4)
//     each = factor max(0, I^power - threshold),   I = mean over wavelengths of
//            colour |F{mask}|^2 / N^4 scaled by 575 nm / wavelength                   (section 3.1)
//
// What of the picture makes glare, and how it is added, is in glare::GlareOptions.
// docs/thesis_look.md follows the document stage by stage.
#pragma once

#include <cstdint>

#include "aureole/base/progress.h"
#include "aureole/color/rgb.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/eye/thesis_frames.h"
#include "aureole/image/image.h"
#include "aureole/image/view.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// From a pattern to a part of the glare.
struct ThesisTone {
    double power = 1;      // > 0
    double threshold = 0;  // >= 0, subtracted after the power
    double factor = 1;     // >= 0
};
double apply(const ThesisTone& tone, double value) noexcept;

// Of the source stage and of the result.
inline constexpr double kThesisThreshold = 0.9;       // eq. 3.2
inline constexpr double kThesisSourceFactor = 10000;  // eq. 3.2
inline constexpr double kThesisFinalGain = 10;        // section 3.1

struct ThesisLook {
    // Fig. 3.9.
    ThesisTone bloom = {0.45, 0.00010, 2000};
    ThesisTone halo = {0.45, 0.00010, 1000};
    ThesisTone corona = {0.42, 0.00017, 2000};
    ThesisTone streaks = {0.36, 0.00025, 500};
    // Eq. 3.4. >= 0, not all 0.
    double bloom_weight = 1;
    double halo_weight = 0.75;
    double streaks_weight = 0.5;
    double corona_weight = 1;

    int gratings = 200;   // section 2.4; 1 to 1000
    int particles = 750;  // section 2.4; 0 to 20000
    int eyelashes = 7;    // section 2.4: 4 to 8; 0 to 100
    // Wavelengths, evenly spaced from 380 to 770 nm; 2 to 1024. The thesis has 32, which leaves
    // dots where needles should be.
    int wavelengths = 96;
    // How far closed lids bend the streaks: the ends of the texture are displaced by bend sin(1) of
    // half its height (fig. 3.7). 0 to 2.
    double bend = 0.6;
    // The angle that the thesis's texture of 512 samples spans: the height of a 16:9 picture 60 deg
    // wide. 1 to 120.
    double height_deg = 36;
    std::uint64_t seed = 1;  // another seed is another person
};
// Throws InvalidArgument that names the first value outside the ranges above.
void check(const ThesisLook& look);

struct ThesisGlare {
    wave::Psf psf;  // of unit energy in every colour
    // What the kernel of the thesis sums to, mean of the three colours: light spreads by `energy`
    // times `psf`. Pixels are weighted by their area, so that it is the same at any resolution.
    double energy = 0;
};

// The glare of a picture seen as `view`; the kernel is as large as the glare, and at most what any
// pixel of the picture can see of it. A pure function: the same arguments give the same bits, on
// any number of threads. About a second; 100 MB. Throws InvalidArgument, Cancelled.
ThesisGlare thesis_glare(const ThesisLook& look, const ThesisFrames& frames, const View& view,
                         Progress* progress = nullptr);

// ---- Its stages ----

// One wavelength as section 2.3 colours it: CIE 1931, sRGB with its transfer function, clamped.
color::Rgb thesis_wavelength_rgb(double wavelength_nm);

// Side of the square textures below, whose central pixel is the source; a pixel is a sample of the
// pattern at 575 nm, of which the thesis's texture has 512.
inline constexpr int kThesisTextureSide = 675;
inline constexpr int kThesisSamples = 512;

// A part of the glare before weights: tone-mapped, faded towards the texture's edge. 3 channels.
Image thesis_texture(Component component, const ThesisLook& look, const ThesisFrames& frames);

// The place (x, y) of the straight texture that is seen at (x, y): right and up from the centre,
// +-1 at a height of 512 samples. Lids that are closed by `closure` bend by bend * closure.
struct TexturePoint {
    double x = 0;
    double y = 0;
};
TexturePoint thesis_bend(TexturePoint at, double bend, double closure) noexcept;

}  // namespace aureole::eye
