// Laws of the eye's PSF, on small rasters.
#include "aureole/eye/eye_psf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/units.h"
#include "aureole/color/rgb.h"
#include "eye/corona_texture.h"
#include "eye/ring_statistics.h"

namespace aureole::eye {
namespace {

// 1.66 deg of texture at 568 nm, enough for laws.
EyePsfOptions small() {
    EyePsfOptions options;
    options.aperture = {1024, 10};
    return options;
}

wave::KernelGrid grid_129() { return {129, 129, 0.0345, Projection::kPerspective}; }

double total(const wave::Psf& psf, int c) {
    double sum = psf.off_kernel_energy[static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
        sum += static_cast<double>(psf.kernel.plane(c)[i]);
    }
    return sum;
}

void expect_unit_energy(const wave::Psf& psf, double tolerance = 1e-4) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(total(psf, c), 1, tolerance) << "channel " << c;
}

bool same(const Image& a, const Image& b) {
    return std::memcmp(a.plane(0), b.plane(0), 3 * a.pixels() * sizeof(float)) == 0;
}

double energy_beyond(const wave::Psf& psf, double angle_deg) {
    double inside = 0;
    const View view = psf.grid.view();
    for (int y = 0; y < psf.grid.height; ++y) {
        for (int x = 0; x < psf.grid.width; ++x) {
            if (view.angle_from_axis_deg(x + 0.5, y + 0.5) < angle_deg) {
                inside += static_cast<double>(psf.kernel.at(x, y, 1));
            }
        }
    }
    return 1 - inside;
}

TEST(EyePsf, HasUnitEnergy) {
    for (const auto model : {ScatterModel::kCie, ScatterModel::kIjspeert, ScatterModel::kNone}) {
        for (const auto projection : {Projection::kPerspective, Projection::kConstantPitch}) {
            Eye eye;
            eye.scatter = model;
            eye.pupil_diameter_mm = 6.3;
            eye.eyelid = 0.2;
            const wave::KernelGrid grid = {129, 65, 0.04, projection};
            expect_unit_energy(eye_psf(eye, grid, small()));
        }
    }
}

TEST(EyePsf, LooksConserveEnergyAndRaiseWhatTheyName) {
    Eye eye;
    eye.pupil_diameter_mm = 6;
    const wave::Psf plain = eye_psf(eye, grid_129(), small());
    eye.corona_contrast = 4;
    eye.halo = 3;
    eye.streaks = 2;
    const wave::Psf vivid = eye_psf(eye, grid_129(), small());
    expect_unit_energy(vivid);
    const auto contrast = [](const wave::Psf& psf) {
        const View view = psf.grid.view();
        const Ring ring = ring_statistics(psf.grid, 0.9, 1.1, [&](int x, int y) {
            const double angle = view.angle_from_axis_deg(x + 0.5, y + 0.5);
            return static_cast<double>(psf.kernel.at(x, y, 1)) * std::pow(angle, 2.7);
        });
        return ring.deviation / ring.mean;
    };
    EXPECT_GT(contrast(vivid), 2 * contrast(plain));
}

// What the streaks hold within the kernel is taken from the scatter term, and so from its wings.
TEST(EyePsf, StreaksHoldTheShareOfThePupilThatLashesBlock) {
    Eye eye;
    eye.corona_contrast = 0;
    eye.halo = 0;
    const EyePsfOptions options = small();
    const wave::Mask pupil = draw_pupil(eye, options.aperture);
    const wave::Mask lashes = draw_lashes(eye, options.aperture);
    double open = 0;
    double blocked = 0;
    for (std::size_t i = 0; i < options.aperture.size(); ++i) {
        open += static_cast<double>(pupil.values[i]);
        blocked += static_cast<double>(pupil.values[i] * lashes.values[i]);
    }
    EXPECT_GT(blocked, 0.01 * open);
    const wave::Psf streaks = eye_component(Component::kStreaks, eye, grid_129(), options);
    for (const double scale : {1.0, 2.0}) {
        eye.streaks = scale;
        const wave::Psf with = eye_psf(eye, grid_129(), options);
        eye.streaks = 0;
        const wave::Psf without = eye_psf(eye, grid_129(), options);
        for (std::size_t c = 0; c < 3; ++c) {
            const double taken = 1 - with.off_kernel_energy[c] / without.off_kernel_energy[c];
            const double inside = 1 - streaks.off_kernel_energy[c];
            EXPECT_NEAR(taken, scale * blocked / open * inside, 1e-5);
        }
    }
}

TEST(StreaksPsf, LeavesWhatLashesLetThrough) {
    Eye eye;
    const EyePsfOptions options = small();
    const wave::Psf pattern = eye_component(Component::kStreaks, eye, grid_129(), options);
    for (const double scale : {1.0, 3.0}) {
        eye.streaks = scale;
        const wave::Psf psf = streaks_psf(eye, grid_129(), options);
        expect_unit_energy(psf, 1e-5);
        const double share = psf.off_kernel_energy[1] / pattern.off_kernel_energy[1];
        for (int y = 0; y < 129; ++y) {
            for (int x = 0; x < 129; ++x) {
                const double streak = share * static_cast<double>(pattern.kernel.at(x, y, 1));
                const double stays = x == 64 && y == 64 ? 1 - share : 0;
                ASSERT_NEAR(static_cast<double>(psf.kernel.at(x, y, 1)), stays + streak, 1e-6);
            }
        }
        // What eye_psf() takes from the scatter for them (StreaksHoldTheShareOfThePupil...).
        Eye plain = eye;
        plain.corona_contrast = 0;
        plain.halo = 0;
        const double with = eye_psf(plain, grid_129(), options).off_kernel_energy[1];
        plain.streaks = 0;
        const double without = eye_psf(plain, grid_129(), options).off_kernel_energy[1];
        EXPECT_NEAR(1 - with / without, share * (1 - pattern.off_kernel_energy[1]), 1e-5);
    }
}

TEST(StreaksPsf, WithoutLashesIsThePictureItself) {
    Eye eye;
    eye.eyelashes = 0;
    const wave::Psf psf = streaks_psf(eye, grid_129(), small());
    expect_unit_energy(psf, 0);
    EXPECT_EQ(psf.kernel.at(64, 64, 0), 1);
    eye.eyelashes = 7;
    eye.streaks = 20;  // at most half, whatever is asked for
    EXPECT_NEAR(static_cast<double>(streaks_psf(eye, grid_129(), small()).kernel.at(64, 64, 1)),
                0.5, 0.1);
}

// Principal axis of what lies at (x, y), y upwards, in deg from the x axis, [0, 180).
template <class Weight>
double axis_deg(int width, int height, const Weight& weight) {
    double sum = 0, mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double w = weight(x, y);
            sum += w;
            mx += w * x;
            my -= w * y;
            xx += w * x * x;
            yy += w * y * y;
            xy -= w * x * y;
        }
    }
    mx /= sum;
    my /= sum;
    const double angle =
        0.5 * std::atan2(2 * (xy / sum - mx * my), xx / sum - mx * mx - (yy / sum - my * my));
    return std::fmod(deg_from_rad(angle) + 180, 180);
}

// Babinet: a lash diffracts like the slit of its shape, at right angles to itself.
TEST(StreaksPsf, LieAcrossEachLash) {
    const EyePsfOptions options = small();
    int seen = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Eye eye;
        eye.seed = seed;
        eye.eyelashes = 1;
        const wave::Mask pupil = draw_pupil(eye, options.aperture);
        const wave::Mask lash = draw_lashes(eye, options.aperture);
        const int n = options.aperture.samples;
        double blocked = 0;
        const auto before_pupil = [&](int x, int y) {
            // Rows of a mask run upwards, those of a picture downwards.
            return static_cast<double>(lash.row(n - 1 - y)[x] * pupil.row(n - 1 - y)[x]);
        };
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) blocked += before_pupil(x, y);
        }
        if (blocked < 2000) continue;  // a lash too short to have a direction
        ++seen;
        const double lash_deg = axis_deg(n, n, before_pupil);
        const wave::Psf streak = eye_component(Component::kStreaks, eye, grid_129(), options);
        const double streak_deg = axis_deg(129, 129, [&](int x, int y) {
            return std::max(0.0, static_cast<double>(streak.kernel.at(x, y, 1)));
        });
        const double apart = std::abs(streak_deg - lash_deg);
        EXPECT_NEAR(apart, 90, 3) << "seed " << seed << ", lash at " << lash_deg;
    }
    EXPECT_GE(seen, 4);
}

// Light of one wavelength behind many particles is fully developed speckle: its intensity is
// exponentially distributed, with a deviation equal to its mean (Goodman, "Speckle Phenomena in
// Optics", section 3.2). Pixels as fine as the samples of the transform average nothing away.
TEST(EyePsf, CoronaOfOneWavelengthIsFullyDevelopedSpeckle) {
    Eye eye;
    eye.halo = 0;
    eye.streaks = 0;
    EyePsfOptions options = small();
    options.spectral.single_wavelength_nm = 555;
    const double pitch_deg = deg_from_rad(555e-6 / options.aperture.extent_mm);
    const wave::KernelGrid grid = {257, 257, pitch_deg, Projection::kPerspective};
    const wave::Psf psf = eye_psf(eye, grid, options);
    eye.corona_contrast = 0;
    const wave::Psf smooth = eye_psf(eye, grid, options);
    const Ring texture = ring_statistics(grid, 0.2, 0.4, [&](int x, int y) {
        return static_cast<double>(psf.kernel.at(x, y, 1) / smooth.kernel.at(x, y, 1));
    });
    EXPECT_NEAR(texture.mean, 1, 0.01);
    EXPECT_NEAR(texture.deviation, 1, 0.08);
}

TEST(EyePsf, GivesAtMostHalfOfTheLightToHaloAndStreaks) {
    Eye eye;
    eye.pupil_diameter_mm = 3;
    eye.eyelashes = 60;
    eye.streaks = 20;
    const wave::Psf psf = eye_psf(eye, grid_129(), small());
    expect_unit_energy(psf);
    const Ring centre = ring_statistics(psf.grid, 0, 0.02, [&](int x, int y) {
        return static_cast<double>(psf.kernel.at(x, y, 0));
    });
    EXPECT_GT(centre.mean, 0);
}

TEST(EyePsf, IsTheSameOnAnyNumberOfThreads) {
    Eye eye;
    eye.pupil_diameter_mm = 6;
    const wave::Psf many = eye_psf(eye, grid_129(), small());
    const ThreadLimit one(1);
    EXPECT_TRUE(same(many.kernel, eye_psf(eye, grid_129(), small()).kernel));
}

TEST(EyePsf, AnotherSeedIsAnotherPersonWithTheSameVeil) {
    Eye eye;
    eye.eyelashes = 0;
    const wave::Psf a = eye_psf(eye, grid_129(), small());
    eye.seed = 2;
    const wave::Psf b = eye_psf(eye, grid_129(), small());
    EXPECT_FALSE(same(a.kernel, b.kernel));
    EXPECT_NEAR(energy_beyond(a, 1) / energy_beyond(b, 1), 1, 0.01);
}

// Without halo and streaks, whatever the texture does, ring means are those of the scatter model.
TEST(EyePsf, RingMeansFollowTheScatterModelAtAnyContrast) {
    for (const double contrast : {0.0, 1.0, 4.0}) {
        Eye eye;
        eye.corona_contrast = contrast;
        eye.halo = 0;
        eye.streaks = 0;
        eye.age_years = 60;
        const wave::Psf psf = eye_psf(eye, grid_129(), small());
        const ScatterPsf model(eye.scatter, eye.age_years, eye.pigmentation, eye.pupil_diameter_mm);
        const View view = psf.grid.view();
        for (const double from_deg : {0.25, 0.5, 1.0, 1.6}) {
            const auto ratio = [&](int x, int y) {
                const double angle = view.angle_from_axis_deg(x + 0.5, y + 0.5);
                return static_cast<double>(psf.kernel.at(x, y, 2)) /
                       (model.per_sr(angle) * view.pixel_solid_angle_sr(x, y));
            };
            EXPECT_NEAR(ring_statistics(psf.grid, from_deg, from_deg * 1.2, ratio).mean, 1, 0.03)
                << contrast << " at " << from_deg;
        }
    }
}

TEST(EyePsf, AWhiteSourceHasWhiteGlare) {
    Eye eye;
    eye.eyelashes = 7;
    const wave::Psf psf = eye_psf(eye, grid_129(), small());
    color::Rgb glare = {};
    for (int c = 0; c < 3; ++c) {
        glare[static_cast<std::size_t>(c)] =
            total(psf, c) - static_cast<double>(psf.kernel.at(64, 64, c));
    }
    const auto xy = color::chromaticity(glare);
    EXPECT_NEAR(xy[0], 0.3127, 0.002);
    EXPECT_NEAR(xy[1], 0.3290, 0.002);
}

TEST(EyePsf, AgeAndPigmentationMakeTheVeil) {
    Eye eye;
    eye.eyelashes = 0;
    const auto veil = [&] { return energy_beyond(eye_psf(eye, grid_129(), small()), 2); };
    const double young = veil();
    eye.age_years = 70;
    const double old = veil();
    EXPECT_GT(old, 1.4 * young);
    eye.age_years = 30;
    eye.pigmentation = Pigmentation::kBlue;
    EXPECT_GT(veil(), 1.1 * young);
}

TEST(EyePsf, HaloWeightGrowsWithThePupil) {
    Eye eye;
    const struct {
        double pupil_mm;
        double weight;
    } expected[] = {{2, 0},      {3, 0},        {4, 0.00025}, {5, 0.0005},
                    {6, 0.0030}, {6.5, 0.0046}, {7, 0.0062},  {8, 0.0062}};
    for (const auto& row : expected) {
        eye.pupil_diameter_mm = row.pupil_mm;
        EXPECT_NEAR(halo_weight(eye), row.weight, 1e-12) << row.pupil_mm;
    }
    eye.halo = 2;
    EXPECT_NEAR(halo_weight(eye), 2 * 0.0062, 1e-12);
}

// A pixel far finer than a sample of the transform: interpolation, not holes.
TEST(EyePsf, WorksForATelescope) {
    Eye eye;
    const wave::KernelGrid grid = {65, 65, 0.0003, Projection::kPerspective};
    const wave::Psf psf = eye_psf(eye, grid, small());
    expect_unit_energy(psf);
    for (std::size_t i = 0; i < 3 * psf.kernel.pixels(); ++i) {
        ASSERT_TRUE(std::isfinite(psf.kernel.plane(0)[i]));
    }
}

TEST(EyePsf, OnePixelHoldsWhatDoesNotMissIt) {
    const wave::Psf psf = eye_psf({}, {1, 1, 0.0345, Projection::kConstantPitch}, small());
    expect_unit_energy(psf);
    EXPECT_GT(psf.kernel.at(0, 0, 0), 0.1F);
}

TEST(EyePsf, SpectralSamplingCanBeFixed) {
    EyePsfOptions options = small();
    options.spectral.bands = 32;
    options.spectral.spacing = color::WavelengthSpacing::kLinear;
    expect_unit_energy(eye_psf({}, grid_129(), options));
    options.spectral.single_wavelength_nm = 555;
    const wave::Psf mono = eye_psf({}, grid_129(), options);
    expect_unit_energy(mono);
    for (std::size_t i = 0; i < mono.kernel.pixels(); ++i) {
        ASSERT_NEAR(mono.kernel.plane(0)[i], mono.kernel.plane(2)[i], 1e-6);
    }
    options.spectral.single_wavelength_nm = 200;
    EXPECT_THROW(eye_psf({}, grid_129(), options), InvalidArgument);
    options.spectral = {};
    options.spectral.bands = -1;
    EXPECT_THROW(eye_psf({}, grid_129(), options), InvalidArgument);
}

// Encircled energy of an Airy disc: .8378 within 1.2197 lambda / D.
TEST(EyeComponent, BloomIsTheAiryPatternOfThePupil) {
    Eye eye;
    eye.pupil_diameter_mm = 3;
    eye.anatomy.pupil_irregularity = 0;
    EyePsfOptions options;
    options.aperture = {1024, 24};
    options.spectral.single_wavelength_nm = 555;
    const wave::KernelGrid grid = {201, 201, 0.0005, Projection::kPerspective};
    const wave::Psf bloom = eye_component(Component::kBloom, eye, grid, options);
    expect_unit_energy(bloom);
    const double zero_deg = deg_from_rad(1.21967 * 555e-6 / 3);
    EXPECT_NEAR(1 - energy_beyond(bloom, zero_deg), 0.8378, 0.006);
}

TEST(EyeComponent, EachHasUnitEnergy) {
    Eye eye;
    eye.pupil_diameter_mm = 7;
    const wave::KernelGrid grid = {257, 257, 0.0345, Projection::kPerspective};
    for (const auto component :
         {Component::kBloom, Component::kCorona, Component::kHalo, Component::kStreaks}) {
        const wave::Psf psf = eye_component(component, eye, grid, small());
        expect_unit_energy(psf);
        EXPECT_GT(1 - psf.off_kernel_energy[1], 0.2);
    }
}

TEST(EyeComponent, SaysWhenThereIsNothingToSee) {
    Eye eye;
    eye.pupil_diameter_mm = 3;
    EXPECT_THROW(eye_component(Component::kHalo, eye, grid_129(), small()), InvalidArgument);
    eye.eyelashes = 0;
    EXPECT_THROW(eye_component(Component::kStreaks, eye, grid_129(), small()), InvalidArgument);
}

TEST(EyePsf, WorksWithoutParticlesAndLashes) {
    Eye eye;
    eye.eyelashes = 0;
    eye.anatomy.lens_small.count = eye.anatomy.lens_large.count = 0;
    eye.anatomy.vitreous.count = eye.anatomy.cornea.count = 0;
    expect_unit_energy(eye_psf(eye, grid_129(), small()));
}

TEST(EyePsf, RefusesAbsurdInput) {
    EyePsfOptions options = small();
    EXPECT_THROW(eye_psf({}, {0, 1, 0.03, Projection::kPerspective}, options), InvalidArgument);
    EXPECT_THROW(eye_psf({}, {64, 65, 0.03, Projection::kPerspective}, options), InvalidArgument);
    EXPECT_THROW(eye_psf({}, {65, 65, 0, Projection::kPerspective}, options), InvalidArgument);
    Eye eye;
    eye.pupil_diameter_mm = 20;
    EXPECT_THROW(eye_psf(eye, grid_129(), options), InvalidArgument);
    options.aperture.samples = 1000003;
    EXPECT_THROW(eye_psf({}, grid_129(), options), InvalidArgument);
    options.aperture = {1024, 5};
    EXPECT_THROW(eye_psf({}, grid_129(), options), InvalidArgument);
}

TEST(EyePsf, CanBeCancelled) {
    class Stop : public Progress {
      public:
        bool cancelled() const override { return true; }
    } stop;
    EXPECT_THROW(eye_psf({}, grid_129(), small(), &stop), Cancelled);
}

TEST(EyePsf, ProgressOnlyGrows) {
    class Watch : public Progress {
      public:
        void report(std::string_view, double fraction) override {
            EXPECT_GE(fraction, last);
            last = fraction;
        }
        double last = 0;
    } watch;
    Eye eye;
    eye.scatter = ScatterModel::kNone;
    eye.pupil_diameter_mm = 6;
    eye_psf(eye, grid_129(), small(), &watch);
    EXPECT_EQ(watch.last, 1);
}

TEST(CoronaTexture, KeepsTheEnergyOfEveryRing) {
    const int n = 41;
    Image corona(n, n, 3);
    Image scatter(n, n, 1);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const double r = std::hypot(x - n / 2, y - n / 2);
            scatter.at(x, y) = static_cast<float>(1 / (1 + r * r * r));
            for (int c = 0; c < 3; ++c) {
                corona.at(x, y, c) = static_cast<float>(1 + 0.9 * std::sin(7.0 * x + 3.0 * y + c));
            }
        }
    }
    const Image texture = corona_texture(corona, scatter, 3);
    EXPECT_EQ(texture.at(n / 2, n / 2, 0), 1);
    EXPECT_NEAR(texture.at(n / 2 + 1, n / 2, 1), 1, 1e-6);
    for (int c = 0; c < 3; ++c) {
        std::vector<double> with(60);
        std::vector<double> without(60);
        double spread = 0;
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                const auto ring =
                    static_cast<std::size_t>(std::lround(std::hypot(x - n / 2, y - n / 2)));
                const auto s = static_cast<double>(scatter.at(x, y));
                with[ring] += s * static_cast<double>(texture.at(x, y, c));
                without[ring] += s;
                spread = std::max(spread, static_cast<double>(texture.at(x, y, c)));
            }
        }
        for (std::size_t r = 0; r < with.size(); ++r) {
            EXPECT_NEAR(with[r], without[r], 1e-6 + 1e-5 * without[r]) << r;
        }
        EXPECT_GT(spread, 1.5);
    }
}

}  // namespace
}  // namespace aureole::eye
