// The star filter: a regular grid in front of the lens, which sends light to the orders of a
// grating along both axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/base/units.h"
#include "aureole/lens/starburst.h"
#include "lens/starburst_test_support.h"

namespace aureole::lens {
namespace {

constexpr double kPupilMm = 12;
constexpr double kPeriodMm = 0.25;
constexpr double kWire = 0.125;         // of the period
constexpr double kPixelMm = 1 / 256.0;  // of the picture of the grid

// Wires along both axes, 16 mm of them.
Occluder grid_of_wires() {
    constexpr int kSize = 4096;
    constexpr int kPeriod = static_cast<int>(kPeriodMm / kPixelMm);
    constexpr int kWidth = static_cast<int>(kWire * kPeriod);
    Image picture(kSize, kSize, 1);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            picture.at(x, y) = x % kPeriod < kWidth || y % kPeriod < kWidth ? 0.0F : 1.0F;
        }
    }
    return Occluder(picture.view(), kSize * kPixelMm);
}

struct Spot {
    int x = 0, y = 0;  // of the brightest pixel, upwards
    double energy = 0;
};

// The brightest pixel within `reach` pixels of (x, y), and the energy around it.
Spot spot_near(const wave::Psf& psf, int c, double x, double y, int reach) {
    const int middle = psf.grid.width / 2;
    Spot spot{static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), 0};
    const Spot from = spot;
    for (int j = from.y - reach; j <= from.y + reach; ++j) {
        for (int i = from.x - reach; i <= from.x + reach; ++i) {
            spot.energy += static_cast<double>(psf.kernel.at(middle + i, middle - j, c));
            if (psf.kernel.at(middle + i, middle - j, c) >
                psf.kernel.at(middle + spot.x, middle - spot.y, c)) {
                spot.x = i;
                spot.y = j;
            }
        }
    }
    return spot;
}

// Orders at k lambda / p; each direction for itself has, relative to the light that goes straight
// on, (sin(pi k b) / (pi k (1 - b)))^2 of energy, b being the share that the wires of one direction
// block. Measured with one wavelength.
TEST(StarFilter, HasTheOrdersOfAGrating) {
    const Occluder grid = grid_of_wires();
    constexpr StarburstOptions kFine{.samples = 4096, .bands = 1};
    const auto psf = starburst_psf(Iris(), kPupilMm, grid_of(301, 1, kPupilMm), kFine, &grid);
    EXPECT_LT(energy_error(psf), 1e-6);
    const double step = kPupilMm / kPeriodMm;  // in lambda / D, of which a pixel is one
    const double straight = spot_near(psf, 1, 0, 0, 2).energy;
    const auto efficiency = [](int k) {
        if (k == 0) return 1.0;
        return std::pow(std::sin(kPi * k * kWire) / (kPi * k * (1 - kWire)), 2);
    };
    for (int ky = -2; ky <= 2; ++ky) {
        for (int kx = -2; kx <= 2; ++kx) {
            const Spot spot = spot_near(psf, 1, kx * step, ky * step, 2);
            EXPECT_NEAR(spot.x, kx * step, 1) << kx << ' ' << ky;
            EXPECT_NEAR(spot.y, ky * step, 1) << kx << ' ' << ky;
            EXPECT_NEAR(spot.energy / straight / (efficiency(kx) * efficiency(ky)), 1, 0.05)
                << kx << ' ' << ky;
        }
    }
    // Nothing of the kind between them.
    EXPECT_LT(spot_near(psf, 1, 0.5 * step, 0, 2).energy, 1e-3 * straight);
}

// Each wavelength by itself: the orders of light that is one line, and of a lamp whose green and
// blue are lines of mercury.
TEST(StarFilter, SendsEachWavelengthToItsOwnPlace) {
    const Occluder grid = grid_of_wires();
    const auto pixels = grid_of(301, 1.5, kPupilMm);
    const auto lit_by = [&](color::Illuminant lamp) {
        return starburst_psf(Iris(), kPupilMm, pixels, {.samples = 2048, .illuminant = lamp},
                             &grid);
    };
    const wave::Psf sodium = lit_by(color::Illuminant::kSodium);
    const wave::Psf mercury = lit_by(color::Illuminant::kMercury);
    struct Line {
        const wave::Psf& psf;
        int channel;
        double wavelength_nm;
    };
    for (const Line& line :
         {Line{sodium, 0, 589.2}, Line{mercury, 2, 435.8}, Line{mercury, 1, 546.1}}) {
        for (const int order : {1, 2, 3}) {
            const double expected = order * mm_from_nm(line.wavelength_nm) / kPeriodMm *
                                    pixels.view().focal_length_px();
            for (const double sign : {-1.0, 1.0}) {
                const Spot across = spot_near(line.psf, line.channel, sign * expected, 0, 3);
                EXPECT_NEAR(across.x, sign * expected, 1) << line.wavelength_nm << ' ' << order;
                EXPECT_NEAR(across.y, 0, 1) << line.wavelength_nm << ' ' << order;
                const Spot up = spot_near(line.psf, line.channel, 0, sign * expected, 3);
                EXPECT_NEAR(up.y, sign * expected, 1) << line.wavelength_nm << ' ' << order;
            }
        }
    }
}

TEST(StarFilter, WithoutWiresIsTheBareIris) {
    const auto pixels = grid_of(101, 1, kPupilMm);
    Image white(8, 8, 1);
    std::fill_n(white.plane(0), white.pixels(), 1.0F);
    const Occluder glass(white.view(), 8);
    const auto with = starburst_psf(Iris(), kPupilMm, pixels, kOneBand, &glass);
    const auto without = starburst_psf(Iris(), kPupilMm, pixels, kOneBand);
    for (std::size_t i = 0; i < with.kernel.pixels(); ++i) {
        ASSERT_NEAR(with.kernel.plane(1)[i], without.kernel.plane(1)[i],
                    1e-5 + 1e-3 * static_cast<double>(without.kernel.plane(1)[i]));
    }
}

}  // namespace
}  // namespace aureole::lens
