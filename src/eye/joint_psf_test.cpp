// The eye as one aperture: energy, Babinet, and the propagation terms.
#include "aureole/eye/joint_psf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::eye {
namespace {

double energy_within(const wave::Psf& psf, double angle_deg) {
    const View view = psf.grid.view();
    double sum = 0;
    for (int y = 0; y < psf.grid.height; ++y) {
        for (int x = 0; x < psf.grid.width; ++x) {
            if (view.angle_from_axis_deg(x + 0.5, y + 0.5) < angle_deg) {
                sum += static_cast<double>(psf.kernel.at(x, y, 1));
            }
        }
    }
    return sum;
}

Eye bare_eye() {
    Eye eye;
    eye.eyelashes = 0;
    eye.anatomy.gratings.phase_rad = 0;
    eye.anatomy.lens_small.count = eye.anatomy.lens_large.count = 0;
    eye.anatomy.vitreous.count = eye.anatomy.cornea.count = 0;
    return eye;
}

JointPsfOptions small() {
    JointPsfOptions options;
    options.aperture = {1024, 10};
    options.spectral.single_wavelength_nm = 555;
    return options;
}

constexpr wave::KernelGrid kGrid = {101, 101, 0.03, Projection::kPerspective};

TEST(JointPsf, HasUnitEnergyInEveryPropagation) {
    for (const auto propagation :
         {Propagation::kFraunhofer, Propagation::kDefocus, Propagation::kFresnel}) {
        JointPsfOptions options;
        options.aperture = {512, 10};
        options.spectral.bands = 4;
        options.propagation = propagation;
        options.defocus_dioptres = 0.5;
        const wave::Psf psf = joint_psf({}, kGrid, options);
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                sum += static_cast<double>(psf.kernel.plane(static_cast<int>(c))[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-3);  // the kernel reaches beyond the band of every wavelength
            EXPECT_NEAR(sum + psf.off_kernel_energy[c], 1, 1e-6);
        }
    }
}

TEST(JointPsf, LashesTakeTheLightThatTheyBlock) {
    Eye eye = bare_eye();
    const JointPsfOptions options = small();
    const auto light = [&] {
        const wave::Field field = draw_joint_aperture(eye, options);
        double sum = 0;
        for (std::size_t i = 0; i < field.grid.size(); ++i) {
            sum += static_cast<double>(field.re[i]);
        }
        return sum;
    };
    const double open = light();
    eye.eyelashes = 7;
    const wave::Mask pupil = draw_pupil(eye, options.aperture);
    const wave::Mask lashes = draw_lashes(eye, options.aperture);
    double blocked = 0;
    for (std::size_t i = 0; i < pupil.grid.size(); ++i) {
        blocked += static_cast<double>(pupil.values[i] * lashes.values[i]);
    }
    EXPECT_GT(blocked, 0.01 * open);
    EXPECT_NEAR((open - light()) / blocked, 1, 1e-3);
}

TEST(JointPsf, WithoutDefocusIsFraunhofer) {
    JointPsfOptions options = small();
    const wave::Psf focused = joint_psf({}, kGrid, options);
    options.propagation = Propagation::kDefocus;
    options.chromatic_aberration = false;
    const wave::Psf defocus = joint_psf({}, kGrid, options);
    for (const double angle_deg : {0.016, 0.1, 0.3, 1.0}) {
        EXPECT_NEAR(energy_within(focused, angle_deg), energy_within(defocus, angle_deg), 0.02);
    }
    for (int y = 40; y <= 60; ++y) {
        for (int x = 40; x <= 60; ++x) {
            const float expected = focused.kernel.at(x, y, 1);
            ASSERT_NEAR(defocus.kernel.at(x, y, 1) / expected, 1, 0.15);
        }
    }
}

// Geometry: D dioptres blur a point into a disc of radius D a (a in m, in radians).
TEST(JointPsf, DefocusBlursByItsGeometricDisc) {
    Eye eye = bare_eye();
    eye.pupil_diameter_mm = 6;
    JointPsfOptions options = small();
    options.propagation = Propagation::kDefocus;
    options.chromatic_aberration = false;
    options.defocus_dioptres = 3;
    const wave::Psf psf = joint_psf(eye, kGrid, options);
    const double disc_deg = deg_from_rad(3 * 3e-3);  // .516 deg
    EXPECT_GT(energy_within(psf, 1.08 * disc_deg), 0.96);
    EXPECT_NEAR(energy_within(psf, 0.5 * disc_deg), 0.25, 0.04);
}

// Without a lens the retina sees the shadow of the pupil, a / d wide: 3.6 deg for 1.5 mm / 24 mm.
TEST(JointPsf, TheLiteralFresnelTermShowsTheShadowOfThePupil) {
    Eye eye = bare_eye();
    eye.pupil_diameter_mm = 3;
    JointPsfOptions options = small();
    options.aperture = {2048, 10};
    options.spectral.single_wavelength_nm = 700;
    options.propagation = Propagation::kFresnel;
    const wave::KernelGrid grid = {101, 101, 0.1, Projection::kPerspective};
    const wave::Psf psf = joint_psf(eye, grid, options);
    const double shadow_deg = deg_from_rad(1.5 / 24);
    EXPECT_GT(energy_within(psf, 1.1 * shadow_deg), 0.93);
    EXPECT_NEAR(energy_within(psf, 0.5 * shadow_deg), 0.25, 0.04);
}

// Babinet: a transparent particle with a delay of pi changes the amplitude by 2, an opaque one
// by 1, so that it scatters a quarter of the light.
TEST(JointPsf, OpaqueParticlesScatterAQuarterOfWhatPhaseParticlesDo) {
    Eye eye = bare_eye();
    eye.anatomy.pupil_irregularity = 0;
    JointPsfOptions options = small();
    const auto in_ring = [&](const wave::Psf& psf) {
        return energy_within(psf, 1.4) - energy_within(psf, 0.8);
    };
    const double nothing = in_ring(joint_psf(eye, kGrid, options));
    eye.anatomy.lens_large = {3000, 10, 35};
    const double phase = in_ring(joint_psf(eye, kGrid, options)) - nothing;
    options.particles = ParticleOptics::kOpaque;
    const double opaque = in_ring(joint_psf(eye, kGrid, options)) - nothing;
    EXPECT_GT(opaque, 0.5 * nothing);
    EXPECT_NEAR(phase / opaque, 4, 0.4);
}

TEST(JointPsf, SaysWhenTheQuadraticPhaseIsNotResolved) {
    Eye eye;
    JointPsfOptions options;
    EXPECT_EQ(propagation_resolution_note(eye, options), "");
    options.propagation = Propagation::kDefocus;
    EXPECT_EQ(propagation_resolution_note(eye, options), "");
    options.propagation = Propagation::kFresnel;
    EXPECT_NE(propagation_resolution_note(eye, options), "");
    eye.pupil_diameter_mm = 3;
    EXPECT_EQ(propagation_resolution_note(eye, options), "");
}

TEST(JointPsf, RefusesAbsurdInput) {
    JointPsfOptions options = small();
    options.retina_distance_mm = 0;
    EXPECT_THROW(joint_psf({}, kGrid, options), InvalidArgument);
    options = small();
    options.defocus_dioptres = 1e3;
    EXPECT_THROW(joint_psf({}, kGrid, options), InvalidArgument);
    Eye closed;
    closed.eyelid = 1;
    EXPECT_THROW(joint_psf(closed, kGrid, small()), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
