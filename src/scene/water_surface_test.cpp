#include "scene/water_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::scene {
namespace {

// The definition: facets of slope s towards the eye show max(0, facing + s) of themselves.
TEST(WaterSurface, VisibleFacetsAreMeansOverSlopes) {
    for (const double sigma : {0.03, 0.1}) {
        for (const double facing : {0.0, 0.02, 0.1, 0.5}) {
            double area = 0;
            double lean = 0;
            constexpr double kStep = 1e-3;
            for (double t = -8; t < 8; t += kStep) {
                const double weight = kStep * std::exp(-t * t / 2) / std::sqrt(2 * kPi) *
                                      std::max(0.0, facing + sigma * t);
                area += weight;
                lean += weight * sigma * t;
            }
            const VisibleFacets facets =
                visible_facets(static_cast<float>(facing), static_cast<float>(sigma));
            EXPECT_NEAR(static_cast<double>(facets.area), area, 1e-4 * area);
            EXPECT_NEAR(static_cast<double>(facets.lean), lean / area, 1e-4 * sigma);
        }
    }
}

// All light that a high sun sends onto ripples leaves as Fresnel's share of it.
TEST(WaterSurface, GlitterHasFresnelsShareOfTheSun) {
    const double elevation = rad_from_deg(60);
    const Vec3 sun = {0, static_cast<float>(std::sin(elevation)),
                      static_cast<float>(std::cos(elevation))};
    WaterSurface::Slopes ripples;
    ripples.variance = 1e-3F;
    double flux = 0;
    constexpr double kStep = 0.004;
    for (double tilt = kStep / 2; tilt < kPi / 2; tilt += kStep) {
        for (double turn = kStep / 2; turn < 2 * kPi; turn += kStep) {
            const Vec3 to_eye = {static_cast<float>(std::sin(tilt) * std::cos(turn)),
                                 static_cast<float>(std::cos(tilt)),
                                 static_cast<float>(std::sin(tilt) * std::sin(turn))};
            flux += double{glitter(ripples, sun, to_eye)} * std::cos(tilt) * std::sin(tilt) *
                    kStep * kStep;
        }
    }
    const double wanted = std::sin(elevation) * double{fresnel_of_water(sun.y)};
    EXPECT_NEAR(flux / wanted, 1, 0.02);
    EXPECT_EQ(glitter(ripples, {0, -0.01F, 1}, sun), 0);
}

// What is not shown is spread: the variance of both together stays that of Cox & Munk.
TEST(WaterSurface, SlopesKeepTheirVariance) {
    const WaterSurface surface({.wind_m_s = 3, .longest_m = 60, .waves = 40, .heading_deg = 90});
    const double wanted = 0.003 + 0.00512 * 3;
    for (const float footprint_m : {0.001F, 1.0F, 1000.0F}) {
        double sum = 0;
        constexpr int kPoints = 20000;
        for (int i = 0; i < kPoints; ++i) {
            const auto slopes =
                surface.at({0.37F * static_cast<float>(i), 0, 0.91F * static_cast<float>(i)},
                           footprint_m, footprint_m);
            sum += (square(slopes.x) + square(slopes.z) + 2 * slopes.variance) / double{kPoints};
        }
        EXPECT_NEAR(sum / wanted, 1, 0.05) << footprint_m;
    }
}

}  // namespace
}  // namespace aureole::scene
