// Kernels in which every light has the spectrum of its own colour, on small rasters.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/color/illuminant.h"
#include "aureole/color/primary_spectra.h"
#include "aureole/color/rgb.h"
#include "aureole/color/spectrum.h"
#include "aureole/eye/eye_psf.h"

namespace aureole::eye {
namespace {

EyePsfOptions small(bool by_color) {
    EyePsfOptions options;
    options.aperture = {1024, 10};
    options.spectral.by_color = by_color;
    return options;
}

wave::KernelGrid grid_101() { return {101, 101, 0.01, Projection::kPerspective}; }

Eye dark_adapted_eye() {
    Eye eye;
    eye.pupil_diameter_mm = 7;
    return eye;
}

double sum_over_lights(const wave::Psf& psf, int x, int y, int c) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) sum += static_cast<double>(psf.kernel.at(x, y, 3 * j + c));
    return sum;
}

double channel_sum(const wave::Psf& psf, int channel) {
    double sum = 0;
    for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
        sum += static_cast<double>(psf.kernel.plane(channel)[i]);
    }
    return sum;
}

class ColorPsf : public testing::TestWithParam<ScatterModel> {};

TEST_P(ColorPsf, WhiteSeesTheKernelOfDaylight) {
    Eye eye = dark_adapted_eye();
    eye.scatter = GetParam();
    for (const double contrast : {1.0, 2.5}) {
        eye.corona_contrast = contrast;
        const wave::Psf matrix = eye_psf(eye, grid_101(), small(true));
        const wave::Psf white = eye_psf(eye, grid_101(), small(false));
        ASSERT_EQ(matrix.kernel.channels(), 9);
        double error = 0;
        double energy = 0;
        for (int y = 0; y < 101; ++y) {
            for (int x = 0; x < 101; ++x) {
                if (x == 50 && y == 50) continue;
                for (int c = 0; c < 3; ++c) {
                    const auto value = static_cast<double>(white.kernel.at(x, y, c));
                    error += std::abs(sum_over_lights(matrix, x, y, c) - value);
                    energy += std::abs(value);
                }
            }
        }
        EXPECT_LE(error, 1e-3 * energy) << contrast;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(matrix.off_kernel_energy[c], white.off_kernel_energy[c], 1e-5);
        }
    }
}

// The light of a primary keeps its colour in sum: what leaves the kernel is dim and all but white.
TEST_P(ColorPsf, LightKeepsItsColourInSum) {
    Eye eye = dark_adapted_eye();
    eye.scatter = GetParam();
    const wave::Psf psf = eye_psf(eye, grid_101(), small(true));
    for (int j = 0; j < 3; ++j) {
        for (int c = 0; c < 3; ++c) {
            const double outside = psf.off_kernel_energy[static_cast<std::size_t>(c)];
            EXPECT_NEAR(channel_sum(psf, 3 * j + c), j == c ? 1 - outside : 0, 2e-3) << j << c;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scatter, ColorPsf,
                         testing::Values(ScatterModel::kCie, ScatterModel::kNone));

// The Airy pattern of an orange light against the sum of those of its wavelengths, one by one.
TEST(ColorPsfRings, AreTheSumOverTheSpectrumOfTheLight) {
    Eye eye;
    eye.pupil_diameter_mm = 2;
    eye.eyelashes = 0;
    EyePsfOptions options = small(true);
    options.aperture = {512, 10};
    const wave::KernelGrid grid = {81, 81, 0.002, Projection::kPerspective};
    const color::Rgb orange = {1, 0.25, 0.02};
    const wave::Psf psf = eye_component(Component::kBloom, eye, grid, options);

    std::vector<color::Rgb> expected(psf.kernel.pixels());
    color::Xyz white{};
    options.spectral.by_color = false;
    constexpr double kStepNm = 6.5;
    for (double nm = 380 + kStepNm / 2; nm < 770; nm += kStepNm) {
        options.spectral.single_wavelength_nm = nm;
        const wave::Psf one = eye_component(Component::kBloom, eye, grid, options);
        const color::Rgb share = color::primary_shares(nm);
        double light = 0;
        for (std::size_t j = 0; j < 3; ++j) light += orange[j] * share[j];
        color::Xyz xyz = color::cie_1931_observer(nm);
        for (std::size_t c = 0; c < 3; ++c) {
            xyz[c] *= color::relative_power(color::Illuminant::kD65, nm);
            white[c] += xyz[c];
        }
        const color::Rgb rgb = color::rgb_from_xyz(xyz);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const double energy = light * static_cast<double>(one.kernel.plane(0)[i]);
            for (std::size_t c = 0; c < 3; ++c) expected[i][c] += energy * rgb[c];
        }
    }
    const color::Rgb scale = color::rgb_from_xyz(white);
    double error = 0;
    double sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            double actual = 0;
            for (std::size_t j = 0; j < 3; ++j) {
                actual += orange[j] *
                          static_cast<double>(psf.kernel.plane(static_cast<int>(3 * j + c))[i]);
            }
            error += std::abs(actual - expected[i][c] / scale[c]);
            sum += std::abs(expected[i][c] / scale[c]);
        }
    }
    EXPECT_LE(error, 0.01 * sum);
}

TEST(ColorPsfRings, NeedDaylight) {
    EyePsfOptions options = small(true);
    options.spectral.illuminant = color::Illuminant::kSodium;
    EXPECT_THROW(eye_psf(Eye(), grid_101(), options), InvalidArgument);
}

}  // namespace
}  // namespace aureole::eye
