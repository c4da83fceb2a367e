#include "aureole/wave/spectral_psf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/wave/diffraction.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

std::vector<float> random_pattern(int samples) {
    Random random(11);
    std::vector<float> values(static_cast<std::size_t>(samples * samples));
    for (float& v : values) v = static_cast<float>(random.uniform(-0.2, 1));
    return values;
}

// Overlap of [low, high] with the unit interval around `centre`.
double overlap(double low, double high, double centre) {
    return std::max(0.0, std::min(high, centre + 0.5) - std::max(low, centre - 0.5));
}

double direct_sum(const std::vector<float>& pattern, int n, double u0, double u1, double v0,
                  double v1) {
    double sum = 0;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            sum += static_cast<double>(pattern[static_cast<std::size_t>(j * n + i)]) *
                   overlap(u0, u1, i - n / 2) * overlap(v0, v1, j - n / 2);
        }
    }
    return sum;
}

TEST(PatternIntegral, AnyRectangleIsTheSumOfItsOverlaps) {
    for (const int n : {2, 70, 96}) {  // blocks of 32 rows: within one, several, a rest
        const auto pattern = random_pattern(n);
        const PatternIntegral integral(pattern.data(), n);
        Random random(5);
        for (int trial = 0; trial < 200; ++trial) {
            // Some reach outside the pattern.
            double u[2] = {random.uniform(-0.7 * n, 0.7 * n), random.uniform(-0.7 * n, 0.7 * n)};
            double v[2] = {random.uniform(-0.7 * n, 0.7 * n), random.uniform(-0.7 * n, 0.7 * n)};
            std::sort(u, u + 2);
            std::sort(v, v + 2);
            ASSERT_NEAR(integral.sum(u[0], u[1], v[0], v[1]),
                        direct_sum(pattern, n, u[0], u[1], v[0], v[1]), 1e-9)
                << u[0] << " " << u[1] << " " << v[0] << " " << v[1];
        }
        EXPECT_NEAR(integral.total(), direct_sum(pattern, n, -n, n, -n, n), 1e-9);
    }
}

Field transformed(const ApertureGrid& grid, double* norm = nullptr) {
    Mask mask(grid);
    draw(mask, regular_polygon(5, grid.extent_mm * 0.15, 20, 0, {0.01, 0.02}));
    Field field = field_from(mask);
    fourier::Fft2d fft(grid.samples, grid.samples);
    const double value = transform(field, fft);
    if (norm != nullptr) *norm = value;
    return field;
}

TEST(PatternIntegral, OfATransformIsThatOfItsPattern) {
    const ApertureGrid grid{120, 2};
    double norm = 0;
    const Field field = transformed(grid, &norm);
    Mask mask(grid);
    draw(mask, regular_polygon(5, grid.extent_mm * 0.15, 20, 0, {0.01, 0.02}));
    Field again = field_from(mask);
    fourier::Fft2d fft(120, 120);
    const Pattern pattern = fraunhofer(again, fft);
    const PatternIntegral want(pattern.energy.data(), 120);
    const PatternIntegral plain = PatternIntegral::from_transform(field, 1 / norm);
    EXPECT_NEAR(plain.total(), 1, 0.02);  // a coarse raster: many edge samples

    // Per ring: twice the energy, less a hundredth per sample, up to ring 30.
    RingWeights weights;
    weights.scale.assign(31, static_cast<float>(2 / norm));
    weights.offset.assign(31, -0.01F);
    const PatternIntegral rings = PatternIntegral::from_transform(field, weights);
    for (int l = -60; l < 60; l += 3) {
        for (int k = -60; k < 60; k += 3) {
            const auto sample = [&](const PatternIntegral& p) {
                return p.sum(k - 0.5, k + 0.5, l - 0.5, l + 0.5);
            };
            const double energy = sample(plain);
            ASSERT_NEAR(energy / plain.total(), sample(want), 1e-7) << k << ", " << l;
            const bool inside = std::lround(std::hypot(k, l)) <= 30;
            ASSERT_NEAR(sample(rings), inside ? 2 * energy - 0.01 : 0, 1e-6) << k << ", " << l;
        }
    }
    weights.offset.pop_back();
    EXPECT_THROW(PatternIntegral::from_transform(field, weights), InvalidArgument);
}

TEST(PatternIntegral, FlattenedByItsRingMeansHasMeanOne) {
    const Field field = transformed({120, 2});
    RingWeights weights;
    for (const double mean : ring_means(field)) {
        weights.scale.push_back(static_cast<float>(1 / mean));
    }
    EXPECT_NEAR(PatternIntegral::from_transform(field, weights).total() / (120 * 120), 1, 1e-5);
}

KernelGrid kernel(int size, double pitch_deg, Projection projection) {
    return {size, size, pitch_deg, projection};
}

double plane_sum(const Image& image, int c) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) sum += static_cast<double>(image.plane(c)[i]);
    return sum;
}

TEST(AddSpectral, EnergyIsConservedOverAKernelThatHoldsTheBand) {
    // Band edge: 48 samples of 1/100 in direction cosine: 29 deg at 1 um per 100 um.
    std::vector<float> pattern = random_pattern(96);
    double total = 0;
    for (float& v : pattern) total += static_cast<double>(v += 0.3F);
    const PatternIntegral integral(pattern.data(), 96);
    const std::vector<color::SpectralBand> bands = {{1000, {0.25, 0.5, -0.5}, 0},
                                                    {700, {0.75, 0.5, 1.5}, 0}};
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const KernelGrid grid = kernel(301, 0.35, projection);
        Image out(301, 301, 3);
        add_spectral(integral, 0.1, PixelRule::kEnergy, bands, grid, {}, out);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(plane_sum(out, c) / total, 1, 2e-3) << c;
    }
}

TEST(AddSpectral, WhiteStaysWhite) {
    const PatternIntegral integral(random_pattern(96).data(), 96);
    // The whole band of every wavelength in one pixel and in many.
    for (const int size : {1, 201}) {
        const KernelGrid grid = kernel(size, size == 1 ? 5 : 0.025, Projection::kConstantPitch);
        Image out(size, size, 3);
        add_spectral(integral, 10, PixelRule::kEnergy, color::sample_spectrum(16), grid, {}, out);
        const double red = plane_sum(out, 0);
        EXPECT_NEAR(plane_sum(out, 1) / red, 1, 1e-4);
        EXPECT_NEAR(plane_sum(out, 2) / red, 1, 1e-4);
    }
}

// PSF_l(theta) = (l0/l)^2 PSF_l0(theta l0/l): energies of pixels of equal solid angle.
TEST(AddSpectral, DensityScalesWithTheSquareOfTheWavelength) {
    const PatternIntegral integral(random_pattern(96).data(), 96);
    Image blue(11, 11, 3);
    Image red(11, 11, 3);
    // Small angles; a grid of twice the pitch at twice the wavelength sees the same samples.
    add_spectral(integral, 100, PixelRule::kEnergy, color::single_wavelength(350),
                 kernel(11, 0.001, Projection::kPerspective), {}, blue);
    add_spectral(integral, 100, PixelRule::kEnergy, color::single_wavelength(700),
                 kernel(11, 0.002, Projection::kPerspective), {}, red);
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 11; ++x) EXPECT_NEAR(blue.at(x, y), red.at(x, y), 1e-4F);
    }
    // Equal pitch: a quarter of the density at half the angle.
    Image same_pitch(21, 21, 3);
    add_spectral(integral, 100, PixelRule::kEnergy, color::single_wavelength(700),
                 kernel(21, 0.001, Projection::kPerspective), {}, same_pitch);
    // A pixel of `red` is 2 x 2 pixels of this grid, whose centre pixel is shared by quarters.
    const double quarters =
        static_cast<double>(same_pitch.at(10, 10) +
                            0.5F * (same_pitch.at(9, 10) + same_pitch.at(11, 10) +
                                    same_pitch.at(10, 9) + same_pitch.at(10, 11)) +
                            0.25F * (same_pitch.at(9, 9) + same_pitch.at(11, 9) +
                                     same_pitch.at(9, 11) + same_pitch.at(11, 11)));
    EXPECT_GT(blue.at(5, 5), 0);
    // Samples are uniform squares: halves of pixels hold halves of the light only on average.
    EXPECT_NEAR(quarters / static_cast<double>(blue.at(5, 5)), 1, 0.15);
}

// Brute force: rays over the exact footprint of the pixel.
double supersampled(const std::vector<float>& pattern, int n, double samples_per_cosine,
                    const KernelGrid& grid, int x, int y, bool mean) {
    constexpr int kRays = 200;
    const double f = grid.view().focal_length_px();
    double sum = 0;
    double solid = 0;
    for (int b = 0; b < kRays; ++b) {
        for (int a = 0; a < kRays; ++a) {
            const double u = (x - grid.width / 2 + (a + 0.5) / kRays - 0.5) / f;
            const double v = -(y - grid.height / 2 + (b + 0.5) / kRays - 0.5) / f;
            double scale = 0;
            double jacobian = 0;
            if (grid.projection == Projection::kPerspective) {
                scale = 1 / std::sqrt(1 + u * u + v * v);
                jacobian = std::pow(scale, 4);
            } else {
                const double theta = std::hypot(u, v);
                scale = theta > 0 ? std::sin(theta) / theta : 1;
                jacobian = std::cos(theta) * scale;
            }
            const double area =
                jacobian / (f * f * kRays * kRays) * samples_per_cosine * samples_per_cosine;
            const int i = static_cast<int>(std::lround(u * scale * samples_per_cosine)) + n / 2;
            const int j = static_cast<int>(std::lround(v * scale * samples_per_cosine)) + n / 2;
            solid += area;
            if (i < 0 || j < 0 || i >= n || j >= n) continue;
            sum += static_cast<double>(pattern[static_cast<std::size_t>(j * n + i)]) * area;
        }
    }
    return mean ? sum / solid : sum;
}

TEST(AddSpectral, PixelsIntegrateTheirArea) {
    const int n = 256;
    const auto pattern = random_pattern(n);
    const PatternIntegral integral(pattern.data(), n);
    // 6 deg off axis: 0.1 in cosine; samples of .001: some 4 x 4 per pixel.
    for (const Projection projection : {Projection::kPerspective, Projection::kConstantPitch}) {
        const KernelGrid grid = kernel(65, 0.2, projection);
        Image energy(65, 65, 3);
        Image mean(65, 65, 3);
        add_spectral(integral, 0.5, PixelRule::kEnergy, color::single_wavelength(500), grid, {},
                     energy);
        add_spectral(integral, 0.5, PixelRule::kMean, color::single_wavelength(500), grid, {},
                     mean);
        for (const auto& [x, y] :
             {std::pair(32, 32), std::pair(33, 30), std::pair(52, 14), std::pair(8, 40)}) {
            const double want = supersampled(pattern, n, 1000, grid, x, y, false);
            // The neglected shear moves corners by uv/2 of a pixel: up to .003 of it here.
            EXPECT_NEAR(energy.at(x, y, 1) / want, 1, 0.01) << x << ", " << y;
            EXPECT_NEAR(mean.at(x, y, 1), supersampled(pattern, n, 1000, grid, x, y, true), 0.01);
        }
    }
}

TEST(AddSpectral, TexturesOfOneAreOneWithinTheBand) {
    const std::vector<float> ones(128 * 128, 1.0F);
    const PatternIntegral integral(ones.data(), 128);
    const KernelGrid grid = kernel(41, 0.1, Projection::kPerspective);
    Image out(41, 41, 3);
    add_spectral(integral, 1, PixelRule::kMean, color::single_wavelength(500), grid, {}, out);
    EXPECT_NEAR(out.at(20, 20), 1, 1e-5);
    EXPECT_NEAR(out.at(5, 30), 1, 1e-5);  // band edge: 64 samples, .032, 18 px
    EXPECT_EQ(out.at(0, 20), 0);
}

TEST(AddSpectral, ImageUpIsApertureUp) {
    std::vector<float> pattern(64 * 64, 0.0F);
    pattern[(32 + 20) * 64 + 32 + 10] = 1;  // right and up
    const PatternIntegral integral(pattern.data(), 64);
    const KernelGrid grid = kernel(51, 0.1, Projection::kPerspective);
    Image out(51, 51, 3);
    add_spectral(integral, 0.5, PixelRule::kEnergy, color::single_wavelength(500), grid, {}, out);
    double x = 0;
    double y = 0;
    for (int j = 0; j < 51; ++j) {
        for (int i = 0; i < 51; ++i) {
            x += (i - 25) * static_cast<double>(out.at(i, j));
            y += (j - 25) * static_cast<double>(out.at(i, j));
        }
    }
    // To within the pixels.
    EXPECT_NEAR(x, deg_from_rad(0.01) / 0.1, 0.3);
    EXPECT_NEAR(y, -deg_from_rad(0.02) / 0.1, 0.3);
}

TEST(AddSpectral, OnlyPixelsInRangeChangeAndLightAdds) {
    const PatternIntegral integral(random_pattern(96).data(), 96);
    const KernelGrid grid = kernel(31, 0.1, Projection::kPerspective);
    const auto add = [&](AngleRange range, Image& out) {
        add_spectral(integral, 1, PixelRule::kEnergy, color::single_wavelength(500), grid, range,
                     out);
    };
    Image parts(31, 31, 3);
    Image whole(31, 31, 3);
    add({0, 0.8}, parts);
    EXPECT_EQ(parts.at(15 + 9, 15), 0);
    EXPECT_NE(parts.at(15 + 7, 15), 0);
    add({0.8, 180}, parts);
    add({}, whole);
    for (std::size_t i = 0; i < whole.pixels(); ++i) {
        ASSERT_EQ(parts.plane(0)[i], whole.plane(0)[i]) << i;
    }
    Image wrong(30, 31, 3);
    EXPECT_THROW(add({}, wrong), InvalidArgument);
}

TEST(AddSpectral, DoesNotDependOnTheNumberOfThreads) {
    const auto pattern = random_pattern(128);
    const KernelGrid grid = kernel(65, 0.1, Projection::kPerspective);
    const auto make = [&] {
        const PatternIntegral integral(pattern.data(), 128);
        Image out(65, 65, 3);
        add_spectral(integral, 1, PixelRule::kEnergy, color::sample_spectrum(8), grid, {}, out);
        return out;
    };
    const Image many = make();
    const ThreadLimit one(1);
    const Image single = make();
    EXPECT_TRUE(std::equal(many.plane(0), many.plane(0) + 3 * many.pixels(), single.plane(0)));
}

TEST(KernelGrid, ReachesFromAnyPixelToAnyOther) {
    const View view = View::from_fov(640, 360, 50, Projection::kPerspective);
    const KernelGrid full = KernelGrid::full_reach(view);
    EXPECT_EQ(full.width, 1279);
    EXPECT_EQ(full.height, 719);
    EXPECT_EQ(full.pitch_deg, view.pitch_deg);
    EXPECT_EQ(KernelGrid::square(view, 65).view().focal_length_px(), view.focal_length_px());
    // Its axis is the centre of the central pixel.
    EXPECT_EQ(KernelGrid::square(view, 65).view().axis_x, 32.5);
    EXPECT_THROW(KernelGrid::square(view, 64), InvalidArgument);
    EXPECT_THROW(KernelGrid::square(view, -1), InvalidArgument);
}

}  // namespace
}  // namespace aureole::wave
