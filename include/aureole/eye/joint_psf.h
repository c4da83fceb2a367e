// The eye as one aperture: everything that light passes drawn into a single complex mask, and the
// mask's diffraction pattern taken as the PSF, as in Ritschel et al. 2009 ("Temporal Glare") and
// the thesis. Nothing is calibrated: all energy follows from the shapes. Interference between
// components, which eye_psf() leaves out, is in; scatter that no raster can draw is not, so that
// the veil beyond a degree is too weak by 1.1 to 40 times, depending on the particles.
// Use eye_psf() for pictures, this to compare with, and for the looks of the thesis.
#pragma once

#include <string>

#include "aureole/base/progress.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/psf.h"

namespace aureole::eye {

enum class Propagation {
    kFraunhofer,  // a focused eye: one transform serves all wavelengths
    kDefocus,     // residual defocus, one transform per wavelength
    kFresnel,     // the literal term of the thesis (eq. 2.12), exp(i pi r^2 / (lambda d)): an eye
                  // without a lens whose retina is d away; one transform per wavelength
};

enum class ParticleOptics {
    kPhase,   // transparent, delayed by particle_phase_rad
    kOpaque,  // as in the thesis
};

struct JointPsfOptions {
    // |FFT|^2 needs an extent of twice the pupil for patterns finer than lambda / extent.
    // 64 to 16384 samples; extent 10 to 100 mm. Memory: 16 bytes per sample, 28 with a transform
    // per wavelength.
    wave::ApertureGrid aperture = {4096, 10};
    SpectralSampling spectral;  // with a transform per wavelength, 0 bands means 32
    Propagation propagation = Propagation::kFraunhofer;
    double defocus_dioptres = 0;       // kDefocus; -20 to 20
    bool chromatic_aberration = true;  // kDefocus: adds Thibos et al. 1992, 0 at 580 nm
    double retina_distance_mm = 24;    // kFresnel; 1 to 1000
    ParticleOptics particles = ParticleOptics::kPhase;
    double particle_phase_rad = 3.14159265358979323846;  // -10 to 10
};

// The complex amplitude behind everything: pupil and lid, lashes, particles, fibres of the lens.
wave::Field draw_joint_aperture(const Eye& eye, const JointPsfOptions& options);

// Unit energy: sum(kernel) + off_kernel_energy is 1 in every colour. The looks, the age and the
// scatter model of the eye play no part. Throws InvalidArgument, Cancelled.
wave::Psf joint_psf(const Eye& eye, const wave::KernelGrid& grid,
                    const JointPsfOptions& options = {}, Progress* progress = nullptr);

// Empty if the raster samples the quadratic phase of kDefocus or kFresnel across the whole pupil
// at all wavelengths (spacing <= lambda / (2 |D| r)), else a sentence that names the number of
// samples that would.
std::string propagation_resolution_note(const Eye& eye, const JointPsfOptions& options);

}  // namespace aureole::eye
