// What the spectrum of a source does to the eye's PSF, on small rasters.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "aureole/color/illuminant.h"
#include "aureole/color/rgb.h"
#include "aureole/color/spectrum.h"
#include "aureole/eye/eye_psf.h"

namespace aureole::eye {
namespace {

using color::Illuminant;

EyePsfOptions small(Illuminant illuminant) {
    EyePsfOptions options;
    options.aperture = {1024, 10};
    options.spectral.illuminant = illuminant;
    return options;
}

wave::KernelGrid grid_101() { return {101, 101, 0.01, Projection::kPerspective}; }

Eye dark_adapted_eye() {
    Eye eye;
    eye.pupil_diameter_mm = 7;
    return eye;
}

// The light of a lamp in every ring of a kernel, one pixel wide; rings without light left out.
std::vector<color::Rgb> lit_rings(const wave::Psf& psf, const color::Rgb& lamp) {
    std::vector<color::Rgb> rings(static_cast<std::size_t>(psf.grid.width / 2 + 1));
    for (int y = 0; y < psf.grid.height; ++y) {
        for (int x = 0; x < psf.grid.width; ++x) {
            const auto ring = static_cast<std::size_t>(
                std::lround(std::hypot(x - psf.grid.width / 2, y - psf.grid.height / 2)));
            if (ring >= rings.size()) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                rings[ring][c] += lamp[c] * psf.kernel.at(x, y, static_cast<int>(c));
            }
        }
    }
    std::erase_if(rings, [](const color::Rgb& rgb) { return color::luminance(rgb) < 1e-9; });
    return rings;
}

// The largest distance in xy between a ring's colour and the lamp's.
double largest_departure(Component component, Illuminant illuminant) {
    const color::Rgb lamp = color::rgb_from_xyz(color::tristimulus(illuminant));
    const auto xy = color::chromaticity(lamp);
    const wave::Psf psf =
        eye_component(component, dark_adapted_eye(), grid_101(), small(illuminant));
    double largest = 0;
    const auto rings = lit_rings(psf, lamp);
    EXPECT_GT(rings.size(), 5U);
    for (const color::Rgb& ring : rings) {
        const auto ring_xy = color::chromaticity(ring);
        largest = std::max({largest, std::abs(ring_xy[0] - xy[0]), std::abs(ring_xy[1] - xy[1])});
    }
    return largest;
}

TEST(SourceSpectrum, RingsOfSodiumHaveTheColourOfTheLamp) {
    for (const Component component : {Component::kBloom, Component::kStreaks}) {
        EXPECT_LT(largest_departure(component, Illuminant::kSodium), 1e-3);
        EXPECT_GT(largest_departure(component, Illuminant::kD65), 0.03);
        EXPECT_GT(largest_departure(component, Illuminant::kMercury), 0.03);
    }
}

TEST(SourceSpectrum, EveryLampConservesEnergyInEveryColour) {
    for (const Illuminant illuminant :
         {Illuminant::kTungsten, Illuminant::kSodium, Illuminant::kHighPressureSodium,
          Illuminant::kMercury, Illuminant::kLed}) {
        const wave::Psf psf = eye_psf(dark_adapted_eye(), grid_101(), small(illuminant));
        for (int c = 0; c < 3; ++c) {
            double sum = psf.off_kernel_energy[static_cast<std::size_t>(c)];
            for (std::size_t i = 0; i < psf.kernel.pixels(); ++i) {
                sum += static_cast<double>(psf.kernel.plane(c)[i]);
            }
            EXPECT_NEAR(sum, 1, 1e-4) << color::name_of(illuminant) << ", channel " << c;
        }
    }
}

// Lines are not sampled: the kernel is the weighted sum of the kernels of each alone.
TEST(SourceSpectrum, SodiumIsTheSumOfItsLines) {
    const wave::Psf both = eye_component(Component::kBloom, dark_adapted_eye(), grid_101(),
                                         small(Illuminant::kSodium));
    const auto bands =
        color::sample_spectrum(8, color::WavelengthSpacing::kLogarithmic, Illuminant::kSodium);
    std::vector<wave::Psf> alone;
    for (const color::SpectralBand& band : bands) {
        EyePsfOptions options = small(Illuminant::kSodium);
        options.spectral.single_wavelength_nm = band.wavelength_nm;
        alone.push_back(eye_component(Component::kBloom, dark_adapted_eye(), grid_101(), options));
    }
    ASSERT_EQ(alone.size(), 2U);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < both.kernel.pixels(); ++i) {
            double sum = 0;
            for (std::size_t b = 0; b < 2; ++b) {
                sum += bands[b].rgb[static_cast<std::size_t>(c)] *
                       static_cast<double>(alone[b].kernel.plane(c)[i]);
            }
            ASSERT_NEAR(static_cast<double>(both.kernel.plane(c)[i]), sum, 1e-6);
        }
    }
}

}  // namespace
}  // namespace aureole::eye
