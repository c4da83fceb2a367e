// Pixel integrals of the scatter models: energy, projection, accuracy.
#include "eye/scatter_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "aureole/base/units.h"
#include "aureole/image/view.h"

namespace aureole::eye {
namespace {

ScatterPsf cie() { return {ScatterModel::kCie, 30, Pigmentation::kBrown, 5}; }

double kernel_energy(const ScatterPixels& pixels, const wave::KernelGrid& grid) {
    const int half_width = grid.width / 2;
    std::vector<float> row(static_cast<std::size_t>(half_width) + 1);
    double sum = 0;
    for (int dy = 0; dy <= grid.height / 2; ++dy) {
        pixels.row(dy, half_width + 1, row.data());
        double half = 0;
        for (int dx = 1; dx <= half_width; ++dx) half += row[static_cast<std::size_t>(dx)];
        sum += (dy == 0 ? 1 : 2) * (row[0] + 2 * half);
    }
    return sum;
}

TEST(ScatterPixels, KernelAndOutsideMakeUnitEnergyAtEveryPitch) {
    for (const auto model : {ScatterModel::kCie, ScatterModel::kIjspeert}) {
        const ScatterPsf psf(model, 45, Pigmentation::kBlue, 3);
        for (const auto projection : {Projection::kPerspective, Projection::kConstantPitch}) {
            for (const double pitch_deg : {0.0005, 0.0345, 0.3, 2.0}) {
                for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {201, 401}}) {
                    if (pitch_deg * height > 300 && projection == Projection::kConstantPitch) {
                        continue;
                    }
                    const wave::KernelGrid grid{width, height, pitch_deg, projection};
                    const ScatterPixels pixels(psf, grid);
                    EXPECT_NEAR(kernel_energy(pixels, grid) + pixels.off_kernel_energy(), 1, 2e-5)
                        << pitch_deg << " deg, " << width << " x " << height << ", perspective "
                        << (projection == Projection::kPerspective);
                }
            }
        }
    }
}

// Brute force: 400 x 400 midpoints per pixel.
TEST(ScatterPixels, PixelIsTheIntegralOfTheDensityOverItsSolidAngle) {
    const ScatterPsf psf = cie();
    const auto grid =
        wave::KernelGrid::square(View::from_fov(1920, 1080, 60, Projection::kPerspective), 1025);
    const ScatterPixels pixels(psf, grid);
    const double f = grid.view().focal_length_px();
    std::vector<float> row(400);
    for (const auto& [dx, dy] :
         {std::pair{1, 0}, {1, 1}, {3, 2}, {15, 5}, {16, 0}, {12, 11}, {100, 37}, {300, 299}}) {
        pixels.row(dy, dx + 1, row.data());
        double sum = 0;
        const int n = 400;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const double rho = std::hypot(dx - 0.5 + (i + 0.5) / n, dy - 0.5 + (j + 0.5) / n);
                const double theta = std::atan(rho / f);
                sum += psf.per_sr(deg_from_rad(theta)) * std::pow(std::cos(theta), 3);
            }
        }
        const double expected = sum / (f * f * n * n);
        EXPECT_NEAR(row[static_cast<std::size_t>(dx)] / expected, 1, 1e-5) << dx << ", " << dy;
    }
}

// The central pixel of a coarse picture holds nearly everything, that of a fine one little.
TEST(ScatterPixels, CentralPixelFollowsThePitch) {
    float coarse = 0;
    float fine = 0;
    ScatterPixels(cie(), {1, 1, 0.5, Projection::kConstantPitch}).row(0, 1, &coarse);
    ScatterPixels(cie(), {1, 1, 0.001, Projection::kConstantPitch}).row(0, 1, &fine);
    EXPECT_GT(coarse, 0.8F);
    EXPECT_LT(fine, 0.02F);
    // A pixel far smaller than the core is the peak density times its solid angle.
    float tiny = 0;
    ScatterPixels(cie(), {1, 1, 1e-5, Projection::kConstantPitch}).row(0, 1, &tiny);
    EXPECT_NEAR(tiny / (cie().per_sr(0) * std::pow(rad_from_deg(1e-5), 2)), 1, 1e-3);
}

}  // namespace
}  // namespace aureole::eye
