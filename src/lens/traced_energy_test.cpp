// The energy of traced ghosts against sums of exact rays in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <cstdio>
#include <cstdlib>

#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/coating.h"
#include "lens/traced_test_support.h"

namespace aureole::lens {
namespace {

// By the law of the reference: the sum of a ghost's pixels over that of the source's is
// (T_g / T_0) eta, eta the share of the light through the entrance pupil that lands in the picture;
// here as the sum over exact rays, on a grid of the entrance that is shrunk to where rays pass.
double energy_by_rays(const Bench& bench, const Bounces& ghost, const sources::Light& light,
                      double wavelength_nm, double transmission) {
    const Tracer tracer(bench.lens, wavelength_nm);
    const auto lands = [&](double x, double y) {
        const TracedRay ray =
            tracer.trace(ghost, ray_from_light(light.tan_x, light.tan_y, x, y));
        if (!ray.passes()) return false;
        const double px = bench.film.px(ray.x_mm);
        const double py = bench.film.py(ray.y_mm);
        return px >= 0 && px < bench.film.width && py >= 0 && py < bench.film.height;
    };
    const double radius = 1.1 * bench.lens.faces().front().semi_aperture_mm;
    double x0 = -radius;
    double x1 = radius;
    double y0 = -radius;
    double y1 = radius;
    double sum = 0;
    for (const int side : {90, 120}) {
        const double step_x = (x1 - x0) / side;
        const double step_y = (y1 - y0) / side;
        double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
        sum = 0;
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                const double x = x0 + (i + 0.5) * step_x;
                const double y = y0 + (j + 0.5) * step_y;
                if (!lands(x, y)) continue;
                left = std::min(left, x - step_x);
                right = std::max(right, x + step_x);
                top = std::min(top, y - step_y);
                bottom = std::max(bottom, y + step_y);
                if (side == 120) {
                    sum += step_x * step_y *
                           tracer.throughput(
                               ghost, ray_from_light(light.tan_x, light.tan_y, x, y));
                }
            }
        }
        if (left > right) return 0;
        x0 = left;
        x1 = right;
        y0 = top;
        y1 = bottom;
    }
    const double cosine =
        1 / std::sqrt(1 + light.tan_x * light.tan_x + light.tan_y * light.tan_y);
    const double pixel = bench.film.mm_per_px * bench.film.mm_per_px;
    return light.solid_angle_sr * cosine * sum /
           (transmission * bench.film.irradiance_per_radiance * pixel);
}

class TracedEnergySlow : public testing::TestWithParam<const char*> {};

TEST_P(TracedEnergySlow, OfTheStrongestGhostsIsThatOfTheirRays) {
    FlareOptions options;
    options.wavelengths = 1;
    Bench bench(GetParam(), 480, options);
    const sources::Light light = bench.light(5, 2);
    std::vector<double> drawn;
    for (std::size_t g = 0; g < bench.list.size(); ++g) {
        drawn.push_back(sum_of(bench.draw(light, static_cast<int>(g))) / 3);
    }
    std::vector<std::size_t> order(drawn.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return drawn[a] > drawn[b]; });
    order.resize(std::min<std::size_t>(order.size(), 20));

    const double wavelength_nm = color::sample_spectrum(1).front().wavelength_nm;
    double transmission = 1;
    const std::vector<double> index = bench.lens.indices(wavelength_nm);
    for (std::size_t k = 0; k < bench.lens.faces().size(); ++k) {
        transmission *= 1 - reflectance(index[k], index[k + 1], bench.lens.faces()[k].coating,
                                        wavelength_nm, 1)
                                .mean();
    }
    std::vector<double> exact(order.size());
    parallel_for(order.size(), [&](std::size_t k, int) {
        exact[k] =
            energy_by_rays(bench, bench.list[order[k]], light, wavelength_nm, transmission);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Bounces& ghost = bench.list[order[k]];
        EXPECT_NEAR(drawn[order[k]] / exact[k], 1, 0.01)
            << "surfaces " << ghost.far + 1 << ", " << ghost.near + 1 << ": " << drawn[order[k]];
        if (getenv("V")) printf("%d %d: %.5g  %.5f\n", ghost.far+1, ghost.near+1, exact[k], drawn[order[k]]/exact[k]);
    }
}

INSTANTIATE_TEST_SUITE_P(Lenses, TracedEnergySlow,
                         testing::Values("heliar", "biotar", "nikon-28-75"));

}  // namespace
}  // namespace aureole::lens
