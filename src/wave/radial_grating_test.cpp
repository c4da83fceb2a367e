#include "aureole/wave/radial_grating.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "aureole/wave/mask_shapes.h"

namespace aureole::wave {
namespace {

// Mean of the grating over a sample by 48 x 48 points.
std::complex<double> sampled(const RadialGrating& g, double x, double y, double dx) {
    std::complex<double> sum = 0;
    for (int b = 0; b < 48; ++b) {
        for (int a = 0; a < 48; ++a) {
            const double px = x + ((a + 0.5) / 48 - 0.5) * dx;
            const double py = y + ((b + 0.5) / 48 - 0.5) * dx;
            const double r = std::hypot(px, py);
            const double s = std::clamp(
                (r - g.inner_radius_mm) / (g.full_radius_mm - g.inner_radius_mm), 0.0, 1.0);
            const double w = s * s * (3 - 2 * s);
            const double phi = std::atan2(py, px);
            double u = g.fibres * phi;
            if (!g.jitter_rad.empty()) {
                const double at =
                    (phi + kPi) / (2 * kPi) * static_cast<double>(g.jitter_rad.size());
                const auto k = static_cast<std::size_t>(at) % g.jitter_rad.size();
                const double low = static_cast<double>(g.jitter_rad[k]);
                const double high =
                    static_cast<double>(g.jitter_rad[(k + 1) % g.jitter_rad.size()]);
                u += low + (at - std::floor(at)) * (high - low);
            }
            sum += (1 - g.opacity * w * (1 + std::cos(u)) / 2) *
                   std::polar(1.0, g.phase_rad * w * std::cos(u));
        }
    }
    return sum / (48.0 * 48.0);
}

TEST(RadialGrating, IsTheMeanOverEachSample) {
    std::vector<float> jitter;
    for (int k = 0; k < 64; ++k) jitter.push_back(static_cast<float>(std::sin(2 * kPi * k / 64)));
    const ApertureGrid grid{128, 6};
    // Well resolved outside, unresolved inside; weak and strong; with and without absorption.
    for (const RadialGrating& g :
         {RadialGrating{60, 0.175, 0, 0.5, 2, jitter}, RadialGrating{60, 2.5, 0, 0.5, 2, {}},
          RadialGrating{40, 0.8, 0.6, 0.2, 1.5, jitter}}) {
        Mask open(grid);
        draw(open, disc(2.9));
        Field field = field_from(open);
        multiply_radial_grating(field, g);
        Random random(3);
        for (int trial = 0; trial < 400; ++trial) {
            const int i = static_cast<int>(random.uniform(10, 118));
            const int j = static_cast<int>(random.uniform(10, 118));
            const double x = grid.x_mm(i);
            const double y = grid.y_mm(j);
            const double r = std::hypot(x, y);
            if (open.row(j)[i] < 1 || r < 0.8) continue;
            const std::complex<double> want = sampled(g, x, y, grid.spacing_mm());
            const std::size_t s = static_cast<std::size_t>(j * 128 + i);
            // What is neglected: the bend of the fibres within a sample, and w's slope.
            ASSERT_NEAR(field.re[s], want.real(), 0.02 * g.phase_rad) << r;
            ASSERT_NEAR(field.im[s], want.imag(), 0.02 * g.phase_rad) << r;
        }
    }
}

TEST(RadialGrating, UnresolvedFibresFadeToTheirMean) {
    const ApertureGrid grid{64, 6};
    Field field = field_from(Mask(grid, 1));
    multiply_radial_grating(field, {20000, 0.5, 0, 0.1, 0.2, {}});
    const double mean = std::cyl_bessel_j(0.0, 0.5);
    for (int i = 40; i < 64; ++i) {
        const std::size_t s = static_cast<std::size_t>(20 * 64 + i);
        ASSERT_NEAR(field.re[s], mean, 2e-3);
        ASSERT_NEAR(field.im[s], 0, 2e-3);
    }
}

TEST(RadialGrating, PhaseAloneTakesNoEnergyWhereResolved) {
    const ApertureGrid grid{512, 6};
    Mask mask(grid);
    draw(mask, annulus(1, 2.5));
    Field field = field_from(mask);
    const double before = area_mm2(mask);
    multiply_radial_grating(field, {50, 0.175, 0, 0.5, 1, {}});
    double after = 0;
    double open = 0;
    for (std::size_t s = 0; s < grid.size(); ++s) {
        open += static_cast<double>(mask.values[s] * mask.values[s]);
        after += static_cast<double>(field.re[s] * field.re[s] + field.im[s] * field.im[s]);
    }
    EXPECT_GT(before, 10);
    EXPECT_NEAR(after / open, 1, 1e-3);
}

TEST(RadialGrating, DoesNotDependOnTheNumberOfThreads) {
    const auto make = [] {
        Field field = field_from(Mask({120, 4}, 1));
        multiply_radial_grating(field, {100, 0.5, 0.1, 0.1, 0.5, {}});
        return field;
    };
    const Field many = make();
    const ThreadLimit one(1);
    const Field single = make();
    EXPECT_TRUE(std::equal(many.re.data(), many.re.data() + 120 * 120, single.re.data()));
    EXPECT_TRUE(std::equal(many.im.data(), many.im.data() + 120 * 120, single.im.data()));
}

TEST(RadialGrating, BadParametersAreNamed) {
    Field field({16, 1});
    const auto reject = [&](auto change) {
        RadialGrating grating;
        change(grating);
        EXPECT_THROW(multiply_radial_grating(field, grating), InvalidArgument);
    };
    reject([](RadialGrating& g) { g.fibres = 0; });
    reject([](RadialGrating& g) { g.phase_rad = -1; });
    reject([](RadialGrating& g) { g.opacity = 2; });
    reject([](RadialGrating& g) { g.inner_radius_mm = -1; });
    reject([](RadialGrating& g) { g.full_radius_mm = g.inner_radius_mm; });
}

}  // namespace
}  // namespace aureole::wave
