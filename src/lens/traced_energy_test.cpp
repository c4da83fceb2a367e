// The energy of traced ghosts against sums of exact rays in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "aureole/base/parallel.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/coating.h"
#include "lens/traced_test_support.h"

namespace aureole::lens {
namespace {

double axial_transmission(const Lens& lens, double wavelength_nm) {
    const std::vector<double> index = lens.indices(wavelength_nm);
    double transmission = 1;
    for (std::size_t k = 0; k < lens.faces().size(); ++k) {
        transmission *=
            1 -
            reflectance(index[k], index[k + 1], lens.faces()[k].coating, wavelength_nm, 1).mean();
    }
    return transmission;
}

struct Box {
    double x0, x1, y0, y1;
};

// The part of a box of the entrance, side x side rays, that passes and lands in the picture.
struct Passing {
    std::vector<std::array<double, 2>> at;
    double area_mm2 = 0;
    Box around = {1e9, -1e9, 1e9, -1e9};
};

Passing passing_in(const Box& box, int side, const Bench& bench, const Bounces& ghost,
                   const sources::Light& light, double wavelength_nm) {
    const Tracer tracer(bench.lens, wavelength_nm);
    const double step_x = (box.x1 - box.x0) / side;
    const double step_y = (box.y1 - box.y0) / side;
    Passing passing;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const double x = box.x0 + (i + 0.5) * step_x;
            const double y = box.y0 + (j + 0.5) * step_y;
            const TracedRay ray =
                tracer.trace(ghost, ray_from_light(light.tan_x, light.tan_y, x, y));
            const double px = bench.film.px(ray.x_mm);
            const double py = bench.film.py(ray.y_mm);
            if (!ray.passes() || px < 0 || px >= bench.film.width || py < 0 ||
                py >= bench.film.height) {
                continue;
            }
            passing.at.push_back({x, y});
            passing.area_mm2 += step_x * step_y;
            Box& around = passing.around;
            around = {std::min(around.x0, x - 2 * step_x), std::max(around.x1, x + 2 * step_x),
                      std::min(around.y0, y - 2 * step_y), std::max(around.y1, y + 2 * step_y)};
        }
    }
    return passing;
}

// The sum of a ghost's pixels over that of the source's is (T_g / T_0) eta, eta the light that
// lands in the picture over the light through the entrance pupil: integrals over exact rays and
// over the spectrum, R, G and B added up.
double energy_by_rays(const Bench& bench, const Bounces& ghost, const sources::Light& light) {
    constexpr int kGeometries = 9;
    constexpr int kColoursEach = 2;
    const double radius = 1.1 * bench.lens.faces().front().semi_aperture_mm;
    const Box box =
        passing_in({-radius, radius, -radius, radius}, 90, bench, ghost, light, 540).around;
    if (box.x0 > box.x1) return 0;
    double sum = 0;
    const auto bands = color::sample_spectrum(kGeometries);
    const auto fine = color::sample_spectrum(kGeometries * kColoursEach);
    for (std::size_t b = 0; b < kGeometries; ++b) {
        const Passing passing = passing_in(box, 100, bench, ghost, light, bands[b].wavelength_nm);
        for (std::size_t f = b * kColoursEach; f < (b + 1) * kColoursEach; ++f) {
            const double wavelength_nm = fine[f].wavelength_nm;
            const Tracer tracer(bench.lens, wavelength_nm);
            double throughput = 0;
            int rays = 0;
            // Other rays at each wavelength; a prime makes no pattern with the rows.
            constexpr std::size_t kEvery = 7;
            for (std::size_t k = f % kEvery; k < passing.at.size(); k += kEvery, ++rays) {
                const auto [x, y] = passing.at[k];
                throughput +=
                    tracer.throughput(ghost, ray_from_light(light.tan_x, light.tan_y, x, y));
            }
            if (rays == 0) continue;
            sum += (fine[f].rgb[0] + fine[f].rgb[1] + fine[f].rgb[2]) * passing.area_mm2 *
                   throughput / rays / axial_transmission(bench.lens, wavelength_nm);
        }
    }
    const double cosine = 1 / std::sqrt(1 + light.tan_x * light.tan_x + light.tan_y * light.tan_y);
    const double pixel = bench.film.mm_per_px * bench.film.mm_per_px;
    return light.solid_angle_sr * cosine * sum / (bench.film.irradiance_per_radiance * pixel);
}

class TracedEnergySlow : public testing::TestWithParam<const char*> {};

TEST_P(TracedEnergySlow, OfTheStrongestGhostsIsThatOfTheirRays) {
    FlareOptions options;
    options.wavelengths = 6;
    Bench bench(GetParam(), 480, options);
    const sources::Light light = bench.light(5, 2);
    std::vector<double> drawn;
    for (std::size_t g = 0; g < bench.list.size(); ++g) {
        drawn.push_back(sum_of(bench.draw(light, static_cast<int>(g))));
    }
    std::vector<std::size_t> order(drawn.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return drawn[a] > drawn[b]; });
    order.resize(std::min<std::size_t>(order.size(), 20));
    std::vector<double> exact(order.size());
    parallel_for(order.size(), [&](std::size_t k, int) {
        exact[k] = energy_by_rays(bench, bench.list[order[k]], light);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Bounces& ghost = bench.list[order[k]];
        EXPECT_NEAR(drawn[order[k]] / exact[k], 1, 0.01)
            << "surfaces " << ghost.far + 1 << ", " << ghost.near + 1 << ": " << drawn[order[k]];
    }
}

INSTANTIATE_TEST_SUITE_P(Lenses, TracedEnergySlow,
                         testing::Values("heliar", "biotar", "nikon-28-75"));

}  // namespace
}  // namespace aureole::lens
