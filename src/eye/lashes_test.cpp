// Lashes of lids that close: they bend, come together, and are joined by those that curled away.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kGrid = {1024, 10};

// Share of the open pupil that lashes block.
double blocked_share(const Eye& eye) {
    const wave::Mask pupil = draw_pupil(eye, kGrid);
    wave::Mask lashes = draw_lashes(eye, kGrid);
    for (std::size_t i = 0; i < kGrid.size(); ++i) lashes.values[i] *= pupil.values[i];
    return wave::area_mm2(lashes) / wave::area_mm2(pupil);
}

// |mean of exp(2 i azimuth)| of the streaks between .4 and 1.2 deg: 1 for one line, 0 for a disc.
double alignment(const Eye& eye) {
    EyePsfOptions options;
    options.aperture = kGrid;
    options.spectral.single_wavelength_nm = 568;
    const wave::Psf psf = eye_component(Component::kStreaks, eye,
                                        {81, 81, 0.0345, Projection::kPerspective}, options);
    std::complex<double> sum = 0;
    double energy = 0;
    for (int y = 0; y < 81; ++y) {
        for (int x = 0; x < 81; ++x) {
            const double rho_deg = 0.0345 * std::hypot(x - 40, y - 40);
            if (rho_deg < 0.4 || rho_deg > 1.2) continue;
            const auto value = static_cast<double>(psf.kernel.at(x, y, 1));
            sum += value * std::polar(1.0, 2 * std::atan2(y - 40, x - 40));
            energy += value;
        }
    }
    return std::abs(sum) / energy;
}

double area_between_mm2(const wave::Mask& a, const wave::Mask& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.grid.size(); ++i) {
        sum += static_cast<double>(std::abs(a.values[i] - b.values[i]));
    }
    return sum * a.grid.spacing_mm() * a.grid.spacing_mm();
}

TEST(LashesThatClose, WidenTheFanOfStreaks) {
    constexpr int kPeople = 8;
    double narrower = 1;
    for (const double closure : {0.0, 0.3, 0.6, 0.9}) {
        double sum = 0;
        for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
            Eye eye;
            eye.seed = seed;
            eye.eyelid = closure;
            sum += alignment(eye);
        }
        EXPECT_LT(sum / kPeople, narrower - 0.03) << closure;
        narrower = sum / kPeople;
    }
    EXPECT_LT(narrower, 0.6);
}

TEST(LashesThatClose, AreMoreThanTheOpenEyeShows) {
    double open = 0;
    double half = 0;
    double almost = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Eye eye;
        eye.seed = seed;
        open += blocked_share(eye) / 8;
        eye.eyelid = 0.5;
        half += blocked_share(eye) / 8;
        eye.eyelid = 0.9;
        almost += blocked_share(eye) / 8;
    }
    EXPECT_GT(half, 2 * open);
    EXPECT_GT(almost, 1.5 * half);
    EXPECT_LT(almost, 0.9);
    // Nobody else is there while the eye is open.
    Eye eye;
    const double with = blocked_share(eye);
    eye.anatomy.lashes.curled_per_mm = 0;
    EXPECT_EQ(blocked_share(eye), with);
    eye.anatomy.lashes.curled_per_mm = 2.8;
    eye.eyelashes = 0;
    eye.eyelid = 0.8;
    EXPECT_EQ(blocked_share(eye), 0);
}

// Nothing pops: what a step changes is small everywhere, and halves with the step.
TEST(LashesThatClose, MoveContinuously) {
    Eye eye;
    const wave::Mask pupil = draw_pupil(eye, kGrid);
    const auto at = [&](double closure) {
        eye.pose.lash_closure = closure;
        wave::Mask lashes = draw_lashes(eye, kGrid);
        for (std::size_t i = 0; i < kGrid.size(); ++i) lashes.values[i] *= pupil.values[i];
        return lashes;
    };
    constexpr double kStep = 0.004;
    for (int i = 0; i < 50; ++i) {
        const double closure = 0.02 * i;
        const wave::Mask here = at(closure);
        const double whole = area_between_mm2(here, at(closure + kStep));
        const double part = area_between_mm2(here, at(closure + kStep / 16));
        EXPECT_LT(whole, 0.6) << closure;  // of 20 mm^2 of pupil
        EXPECT_LT(part, whole / 8 + 1e-3) << closure;
    }
    // A pupil that trembles does not move them from tuft to tuft.
    eye.pose.lash_closure = 0.8;
    const wave::Mask here = draw_lashes(eye, kGrid);
    eye.pupil_diameter_mm = 5.001;
    EXPECT_LT(area_between_mm2(here, draw_lashes(eye, kGrid)), 0.05);
}

TEST(LashesThatClose, KeepTheEnergyOfThePsf) {
    for (const double closure : {0.4, 0.8, 0.95}) {
        Eye eye;
        eye.eyelid = closure;
        EyePsfOptions options;
        options.aperture = kGrid;
        const wave::Psf psf = eye_psf(eye, {129, 65, 0.0345, Projection::kPerspective}, options);
        for (int c = 0; c < 3; ++c) {
            double sum = psf.off_kernel_energy[static_cast<std::size_t>(c)];
            for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                sum += static_cast<double>(psf.kernel.plane(c)[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-4) << closure;
        }
    }
}

}  // namespace
}  // namespace aureole::eye
