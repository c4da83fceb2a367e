// Colours of rays against exact throughput, every band along its own way.
#include "lens/ray_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/library.h"

namespace aureole::lens {
namespace {

TEST(RayColors, AreThoseOfExactThroughput) {
    for (const char* id : {"heliar", "nikon-28-75", "biotar"}) {
        const Lens lens(shipped_lens(id), {.f_number = 4});
        const RayColors colors(lens);
        const auto bands = color::sample_spectrum(RayColors::kBands);
        std::vector<Tracer> tracers;
        std::vector<double> axial;
        std::array<double, 3> axial_rgb = {};
        for (const color::SpectralBand& band : bands) {
            tracers.emplace_back(lens, band.wavelength_nm);
            axial.push_back(tracers.back().throughput(Bounces{}, ray_from_light(0, 0, 0, 0)));
            for (std::size_t c = 0; c < 3; ++c) axial_rgb[c] += band.rgb[c] * axial.back();
        }
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(colors.axial_transmission()[c], axial_rgb[c], 1e-6) << id;
        }
        Random random(3);
        std::vector<Incidence> scratch;
        double off = 0;
        double sum = 0;
        int rays = 0;
        const double radius = lens.efl_mm() / 8;
        for (const Bounces& ghost : enumerate_ghosts(lens, GhostSet::kAll)) {
            // Mostly skew ones.
            const Ray ray =
                ray_from_light(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15),
                               random.uniform(-radius, radius), random.uniform(-radius, radius));
            if (!tracers[RayColors::kBands / 2].trace(ghost, ray).passes()) continue;
            ASSERT_TRUE(colors.arrives(ghost, ray));
            std::array<double, 3> color = {};
            ASSERT_TRUE(colors.color_of(ghost, ray, scratch, color));
            std::array<double, 3> expected = {};
            for (std::size_t b = 0; b < bands.size(); ++b) {
                const double share = tracers[b].throughput(ghost, ray) / axial[b];
                for (std::size_t c = 0; c < 3; ++c) expected[c] += bands[b].rgb[c] * share;
            }
            double worst = 0;
            double brightest = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(color[c] - expected[c]));
                brightest = std::max(brightest, std::abs(expected[c]));
            }
            off += worst;
            sum += brightest;
            ++rays;
            // Where a face reflects hardly anything at one angle, dispersion of the ray shows.
            EXPECT_LT(worst, 0.03 * brightest) << id << " " << ghost.far << ", " << ghost.near;
        }
        EXPECT_GT(rays, 5) << id;
        EXPECT_LT(off, 3e-3 * sum) << id;
    }
}

TEST(RayColors, ARayThatIsLostHasNone) {
    const Lens lens(shipped_lens("heliar"));
    const RayColors colors(lens);
    std::vector<Incidence> scratch;
    std::array<double, 3> color = {1, 1, 1};
    const Ray far = ray_from_light(0, 0, 500, 0);
    EXPECT_FALSE(colors.arrives({1, 0}, far));
    EXPECT_FALSE(colors.color_of({1, 0}, far, scratch, color));
    EXPECT_EQ(color, (std::array<double, 3>{}));
}

}  // namespace
}  // namespace aureole::lens
