// The corona in layers: which scatterers make which needles, and how far a light's needles are
// seen. docs/corona.md has the equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/eye/anatomy.h"
#include "aureole/eye/eye_psf.h"
#include "aureole/fourier/fft.h"
#include "aureole/wave/diffraction.h"
#include "eye/ring_statistics.h"

namespace aureole::eye {
namespace {

constexpr wave::ApertureGrid kAperture = {2048, 10};  // 3.3 deg at 568 nm
constexpr double kWavelengthMm = 568e-6;

enum class Size { kSmall, kLarge };

Eye with_only(Size size, std::uint64_t seed) {
    Eye eye;
    eye.seed = seed;
    eye.pupil_diameter_mm = 6;
    if (size == Size::kSmall) {
        eye.anatomy.lens_large.count = eye.anatomy.cornea.count = 0;
    } else {
        eye.anatomy.lens_small.count = eye.anatomy.vitreous.count = 0;
    }
    return eye;
}

// |F{P (C - mean)}|^2 of an eye's particles, mean over each ring.
std::vector<double> ring_means_of(const Eye& eye) {
    const wave::Mask pupil = draw_pupil(eye, kAperture);
    wave::Mask covered(kAperture);
    for (const auto layer :
         {ParticleLayer::kLens, ParticleLayer::kVitreous, ParticleLayer::kCornea}) {
        add_particles(eye, layer, covered);
    }
    const auto overlap = [&] {
        for (std::size_t i = 0; i < kAperture.size(); ++i) covered.values[i] *= pupil.values[i];
        return wave::area_mm2(covered) / wave::area_mm2(pupil);
    };
    const auto mean = static_cast<float>(overlap());
    for (std::size_t i = 0; i < kAperture.size(); ++i) {
        covered.values[i] -= mean * pupil.values[i];
    }
    wave::Field field = wave::field_from(covered);
    fourier::Fft2d fft(kAperture.samples, kAperture.samples);
    wave::transform(field, fft);
    return wave::ring_means(field);
}

// n times the mean over log-uniform radii a of |pi a^2 2 J1(x) / x|^2, x = 2 pi a theta / lambda.
double expected(const Particles& particles, double angle_deg) {
    constexpr int kSteps = 2000;
    const double ratio = std::log(particles.max_radius_um / particles.min_radius_um);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double radius_mm =
            mm_from_um(particles.min_radius_um * std::exp(ratio * (i + 0.5) / kSteps));
        const double x = 2 * kPi * radius_mm * std::sin(rad_from_deg(angle_deg)) / kWavelengthMm;
        sum += std::pow(kPi * radius_mm * radius_mm * 2 * std::cyl_bessel_j(1.0, x) / x, 2);
    }
    return particles.count * sum / kSteps;
}

double share_of_large(const Anatomy& anatomy, double angle_deg) {
    const double large =
        expected(anatomy.lens_large, angle_deg) + expected(anatomy.cornea, angle_deg);
    const double small =
        expected(anatomy.lens_small, angle_deg) + expected(anatomy.vitreous, angle_deg);
    return large / (large + small);
}

wave::Psf corona_of(const Eye& eye) {
    EyePsfOptions options;
    options.aperture = kAperture;
    options.spectral.single_wavelength_nm = 568;
    return eye_component(Component::kCorona, eye, {201, 201, 0.03, Projection::kPerspective},
                         options);
}

// Correlation of two textures over a ring: kernels relative to the smooth one.
double correlation(const wave::Psf& a, const wave::Psf& b, const wave::Psf& smooth, double from_deg,
                   double to_deg) {
    const auto texture = [&](const wave::Psf& psf, int x, int y) {
        return static_cast<double>(psf.kernel.at(x, y, 1) / smooth.kernel.at(x, y, 1)) - 1;
    };
    const auto moment = [&](const wave::Psf& p, const wave::Psf& q) {
        return ring_statistics(a.grid, from_deg, to_deg,
                               [&](int x, int y) { return texture(p, x, y) * texture(q, x, y); })
            .mean;
    };
    return moment(a, b) / std::sqrt(moment(a, a) * moment(b, b));
}

TEST(CoronaLayers, EachSizeHasTheEnvelopeOfItsDiscs) {
    constexpr int kPeople = 4;
    const Anatomy anatomy;
    std::array<std::vector<double>, 2> sums;
    for (const Size size : {Size::kSmall, Size::kLarge}) {
        auto& sum = sums[static_cast<std::size_t>(size)];
        for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
            const auto means = ring_means_of(with_only(size, seed));
            sum.resize(means.size());
            std::transform(means.begin(), means.end(), sum.begin(), sum.begin(), std::plus<>());
        }
    }
    for (const double angle_deg : {0.25, 0.5, 0.75, 1.5, 2.5}) {
        const auto ring = static_cast<std::ptrdiff_t>(
            std::lround(std::sin(rad_from_deg(angle_deg)) * kAperture.extent_mm / kWavelengthMm));
        const auto around = [&](const std::vector<double>& sum) {
            return std::accumulate(sum.begin() + ring - 2, sum.begin() + ring + 3, 0.0);
        };
        const double share = around(sums[1]) / (around(sums[0]) + around(sums[1]));
        EXPECT_NEAR(share, share_of_large(anatomy, angle_deg), 0.05) << angle_deg;
    }
    EXPECT_GT(share_of_large(anatomy, 0.25), 0.9);
    EXPECT_LT(share_of_large(anatomy, 2.5), 0.5);
}

// Needles near a light are those of the large scatterers; take the small ones away and they stay.
TEST(CoronaLayers, InnerNeedlesAreOfLargeScatterersOuterOnesOfSmall) {
    double inner_large = 0;
    double inner_small = 0;
    double outer_large = 0;
    double outer_small = 0;
    constexpr int kPeople = 4;
    for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
        Eye eye;
        eye.seed = seed;
        eye.pupil_diameter_mm = 6;
        const wave::Psf all = corona_of(eye);
        const wave::Psf large = corona_of(with_only(Size::kLarge, seed));
        const wave::Psf small = corona_of(with_only(Size::kSmall, seed));
        eye.corona_contrast = 0;
        const wave::Psf smooth = corona_of(eye);
        inner_large += correlation(all, large, smooth, 0.2, 0.5) / kPeople;
        inner_small += correlation(all, small, smooth, 0.2, 0.5) / kPeople;
        outer_large += correlation(all, large, smooth, 2.2, 2.6) / kPeople;
        outer_small += correlation(all, small, smooth, 2.2, 2.6) / kPeople;
    }
    EXPECT_GT(inner_large, 0.9);
    EXPECT_LT(inner_small, 0.1);
    EXPECT_GT(outer_small, outer_large + 0.1);
}

// A light of 100 times the illuminance shows needles several times as far out. Nothing in the
// kernel knows about brightness: what a faint star lacks is below the contrast that is seen.
TEST(CoronaLayers, FaintLightsShowInnerNeedlesOnly) {
    constexpr double kBackground = 0.01;  // cd/m2
    constexpr double kContrast = 0.02;    // that is just seen
    Eye eye;
    eye.pupil_diameter_mm = 6;
    EyePsfOptions options;
    options.aperture = kAperture;
    const wave::Psf psf = eye_component(Component::kCorona, eye,
                                        {181, 181, 0.0345, Projection::kPerspective}, options);
    const double pixel_sr = std::pow(rad_from_deg(psf.grid.pitch_deg), 2);
    // Up to where the needles of a light of so many lux at the eye stand out.
    const auto visible_deg = [&](double illuminance_lx) {
        double angle_deg = 0.1;
        for (; angle_deg < 3; angle_deg *= 1.05) {
            const Ring ring =
                ring_statistics(psf.grid, angle_deg, angle_deg + 0.05, [&](int x, int y) {
                    return illuminance_lx / pixel_sr * static_cast<double>(psf.kernel.at(x, y, 1));
                });
            if (ring.deviation < kContrast * (kBackground + ring.mean)) break;
        }
        return angle_deg;
    };
    double nearer = 0.15;
    for (const double illuminance_lx : {1e-5, 1e-4, 1e-3}) {
        const double reach_deg = visible_deg(illuminance_lx);
        EXPECT_GT(reach_deg, 1.4 * nearer) << illuminance_lx;
        nearer = reach_deg;
    }
    EXPECT_LT(visible_deg(1e-5), 0.6);
    EXPECT_GT(visible_deg(1e-2), 2.5);
}

}  // namespace
}  // namespace aureole::eye
