// The point spread function of an eye, built by components:
//
//     K = (1 - c) S T' + w_h H + w_e E
//
// S  scatter model (scatter.h), integrated over each pixel: the bloom and the veil
// T' texture of the ciliary corona, from diffraction at the particles of lens, vitreous and
//    cornea; its mean over every ring is 1, so that S keeps its energy at every angle
// H  lenticular halo, from diffraction at the fibres of the lens
// E  streaks, from diffraction at the eyelashes
// c  energy of w_h H + w_e E inside the kernel, per colour, taken from the scatter term
//
// docs/eye.md derives each term and says why components are calibrated one by one: particles
// alone are not the whole scatter of an eye, and a joint pattern forced onto the scatter model
// ring by ring loses its halo, which is itself a ring.
#pragma once

#include "aureole/base/progress.h"
#include "aureole/color/spectrum.h"
#include "aureole/eye/anatomy.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

// How the visible spectrum is cut into bands.
struct SpectralSampling {
    // 0: as many logarithmic bands as the radius needs, so that neighbouring wavelengths smear a
    // ray by about a pixel at most: 32 within 14 pixels of the source, 64 within 27, 128 within
    // 260 (9 deg in 1080p at 60 deg), more beyond. n > 0: n bands everywhere.
    int bands = 0;  // 0 to 4096
    // Of a fixed number of bands. The thesis: 32, kLinear.
    color::WavelengthSpacing spacing = color::WavelengthSpacing::kLogarithmic;
    // Spectrum of the source, whose lines are bands of their own (illuminant.h). Weights are
    // relative to its colour: docs/spectral_sources.md.
    color::Illuminant illuminant = color::Illuminant::kD65;
    // Every light has the spectrum of its own colour (color/primary_spectra.h), white that of
    // kD65: the kernel is a matrix of nine channels (wave/psf.h). Of eye_psf() with kD65 only.
    bool by_color = false;
    // > 0: one wavelength (nm, 380 to 770), equal in all three channels; the rest is ignored.
    double single_wavelength_nm = 0;
};

struct EyePsfOptions {
    // The raster of the diffraction patterns. They reach asin(lambda samples / (2 extent)), 6.6 deg
    // for 568 nm; coarser rasters alias: 2048 samples are 65 % too bright at 3 deg.
    // 64 to 16384 samples (even, 7-smooth); extent 10 to 100 mm.
    wave::ApertureGrid aperture = {4096, 10};
    SpectralSampling spectral;
};

// Where the time went, in seconds.
struct EyePsfTimings {
    double draw = 0;       // masks
    double transform = 0;  // Fourier transforms
    double pattern = 0;    // rings and summed-area tables
    double spectral = 0;   // bands onto pixels
    double scatter = 0;    // scatter model onto pixels, and the sum of everything
};

// Energy: sum(kernel) + off_kernel_energy is 1 in every colour; off_kernel_energy is integrated
// from the scatter model, not inferred from the kernel. A source with the illuminant's spectrum
// keeps its colour in sum. The same arguments give the same bits on any number of threads.
// By colour, white light sees the kernel of kD65 (to within the clamp of dark needles), and the
// light of any colour keeps it in sum.
// With ScatterModel::kNone, S is the Airy pattern of the pupil and T' is 1.
// At most half of the energy goes into halo and streaks, whatever the looks ask for.
// Memory: about 350 MB at 4096 samples, beside the kernel.
// Throws InvalidArgument for an eye or options outside their ranges, and by colour for another
// illuminant than kD65; Cancelled.
wave::Psf eye_psf(const Eye& eye, const wave::KernelGrid& grid, const EyePsfOptions& options = {},
                  Progress* progress = nullptr, EyePsfTimings* timings = nullptr);

// What lashes do to light before it gets into the eye, alone:
//
//     (1 - w_e) delta + w_e E
//
// of unit energy, for effects that take streaks and bloom one after the other. Applied before the
// eye_psf() of the same eye without lashes, it makes of a point the streaks and the veil around
// them: where eye_psf() adds E, this way E is scattered as well. w_e is at most half.
// Only the source's own pixel is lit if no lash lies before the pupil.
wave::Psf streaks_psf(const Eye& eye, const wave::KernelGrid& grid,
                      const EyePsfOptions& options = {}, Progress* progress = nullptr);

// One component alone, of unit energy over all directions.
enum class Component {
    kBloom,    // Airy pattern of the pupil (and lid): what diffraction alone does
    kCorona,   // S T'
    kHalo,     // H; InvalidArgument if the pupil hides the fibres of the lens
    kStreaks,  // E; InvalidArgument if no lash lies before the pupil
};
wave::Psf eye_component(Component component, const Eye& eye, const wave::KernelGrid& grid,
                        const EyePsfOptions& options = {}, Progress* progress = nullptr);

// Energy of the halo, w_h: 0 up to a pupil of 3 mm (the iris covers the fibres), then .0005 at 5,
// .0030 at 6, .0062 from 7 mm on, linear between, times eye.halo. Of a pupil that is not round
// every sector counts as that of a round one of its radius: it uncovers the same fibres.
double halo_weight(const Eye& eye);

}  // namespace aureole::eye
