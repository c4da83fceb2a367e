#include "aureole/wave/mask_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::wave {
namespace {

Mask drawn(const ApertureGrid& grid, const Shape& shape) {
    Mask mask(grid);
    draw(mask, shape);
    return mask;
}

// Largest difference between a drawn shape and the share of 64 x 64 points per sample inside it.
double worst_coverage_error(const Mask& mask, const std::function<bool(double, double)>& inside) {
    const int n = mask.grid.samples;
    const double dx = mask.grid.spacing_mm();
    double worst = 0;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            int hits = 0;
            for (int b = 0; b < 64; ++b) {
                for (int a = 0; a < 64; ++a) {
                    const double x = mask.grid.x_mm(i) + ((a + 0.5) / 64 - 0.5) * dx;
                    const double y = mask.grid.y_mm(j) + ((b + 0.5) / 64 - 0.5) * dx;
                    hits += inside(x, y) ? 1 : 0;
                }
            }
            worst = std::max(worst, std::abs(hits / 4096.0 - static_cast<double>(mask.row(j)[i])));
        }
    }
    return worst;
}

TEST(Draw, CoverageIsTheAreaInEachSample) {
    const ApertureGrid grid{40, 4};
    // Points on an edge parallel to the raster fall on one side of it together: 1/64.
    constexpr double kTolerance = 0.017;
    EXPECT_LT(worst_coverage_error(
                  drawn(grid, disc(1.23, {0.11, -0.07})),
                  [](double x, double y) { return std::hypot(x - 0.11, y + 0.07) < 1.23; }),
              kTolerance);
    EXPECT_LT(worst_coverage_error(drawn(grid, annulus(0.5, 1.5)),
                                   [](double x, double y) {
                                       const double r = std::hypot(x, y);
                                       return r > 0.5 && r < 1.5;
                                   }),
              kTolerance);
    EXPECT_LT(worst_coverage_error(drawn(grid, ellipse(1.7, 0.33, 30)),
                                   [](double x, double y) {
                                       const double c = std::cos(kPi / 6);
                                       const double s = std::sin(kPi / 6);
                                       return std::hypot((c * x + s * y) / 1.7,
                                                         (c * y - s * x) / 0.33) < 1;
                                   }),
              kTolerance);
    // Turned by 90 deg: tips on the x axis, discs above and below.
    EXPECT_LT(worst_coverage_error(drawn(grid, vesica(0.6, 3, 90, {0.2, 0})),
                                   [](double x, double y) {
                                       const double radius = (9 + 0.36) / (4 * 0.6);
                                       const double offset = radius - 0.3;
                                       return std::hypot(x - 0.2, y - offset) < radius &&
                                              std::hypot(x - 0.2, y + offset) < radius;
                                   }),
              kTolerance);
    EXPECT_LT(worst_coverage_error(drawn(grid, rectangle(3, 0.04, 72, {0.2, 0.1})),
                                   [](double x, double y) {
                                       const double c = std::cos(rad_from_deg(72));
                                       const double s = std::sin(rad_from_deg(72));
                                       x -= 0.2;
                                       y -= 0.1;
                                       return std::abs(c * x + s * y) < 1.5 &&
                                              std::abs(c * y - s * x) < 0.02;
                                   }),
              kTolerance);
    const std::vector<RadiusHarmonic> harmonics = {{2, 0.05, 0.3}, {5, 0.04, 1.1}};
    EXPECT_LT(worst_coverage_error(drawn(grid, irregular_disc(1.4, harmonics)),
                                   [](double x, double y) {
                                       const double phi = std::atan2(y, x);
                                       return std::hypot(x, y) <
                                              1.4 * (1 + 0.05 * std::cos(2 * phi + 0.3) +
                                                     0.04 * std::cos(5 * phi + 1.1));
                                   }),
              kTolerance);
}

TEST(Draw, LidOpensTheInsideOfItsCircleEvenFarOutsideTheRaster) {
    const ApertureGrid grid{40, 4};
    Mask mask(grid, 1);
    draw(mask, lid_opening(LidSide::kUpper, 0.5, 6), Blend::kKeep);
    draw(mask, lid_opening(LidSide::kLower, -1.1, 6), Blend::kKeep);
    EXPECT_LT(worst_coverage_error(mask,
                                   [](double x, double y) {
                                       return std::hypot(x, y + 5.5) < 6 &&
                                              std::hypot(x, y - 4.9) < 6;
                                   }),
              0.02);
}

TEST(Draw, AreaDoesNotDependOnTheRaster) {
    const Lash hair{{0.1, -0.4}, 75, 0.075, 1.5, 2.2, 0.2};
    const double taper_area = 2.0 / 3 * hair.taper_mm * hair.width_mm;
    const double lash_area = taper_area + (hair.length_mm - hair.taper_mm) * hair.width_mm;
    const double pentagon = 2.5 * std::sin(2 * kPi / 5) * 1.3 * 1.3;
    for (const int samples : {8, 30, 128, 512}) {
        const ApertureGrid grid{samples, 6};
        SCOPED_TRACE(samples);
        EXPECT_NEAR(area_mm2(drawn(grid, disc(2))) / (kPi * 4), 1, 1e-6);
        EXPECT_NEAR(area_mm2(drawn(grid, disc(0.003, {0.4, 0.7}))) / (kPi * 9e-6), 1, 1e-5);
        EXPECT_NEAR(area_mm2(drawn(grid, rectangle(4, 0.01, 33))) / 0.04, 1, 1e-5);
        EXPECT_NEAR(area_mm2(drawn(grid, regular_polygon(5, 1.3, 17))) / pentagon, 1, 1e-6);
        EXPECT_NEAR(area_mm2(drawn(grid, lash(hair))) / lash_area, 1, 2e-3);
    }
}

TEST(Draw, RoundedBladesRangeFromThePolygonToItsCircle) {
    const ApertureGrid grid{128, 4};
    for (const int blades : {3, 5, 6, 9}) {
        EXPECT_NEAR(area_mm2(drawn(grid, regular_polygon(blades, 1.5, 10, 1))), kPi * 2.25, 1e-3);
        const double straight = area_mm2(drawn(grid, regular_polygon(blades, 1.5, 10, 0)));
        EXPECT_NEAR(straight, blades / 2.0 * std::sin(2 * kPi / blades) * 2.25, 1e-5);
        // To first order in the bulge, what is added on one side is taken away on the other.
        const double out = area_mm2(drawn(grid, regular_polygon(blades, 1.5, 10, 0.1)));
        const double in = area_mm2(drawn(grid, regular_polygon(blades, 1.5, 10, -0.1)));
        EXPECT_GT(out, straight);
        EXPECT_NEAR((out + in) / 2, straight, 1e-5);
    }
}

TEST(Draw, CornersLieWhereTheRotationSays) {
    const ApertureGrid grid{200, 4};
    const Mask mask = drawn(grid, regular_polygon(3, 1.5, 90));
    EXPECT_EQ(mask.row(100 + 70)[100], 1);  // just below the corner at (0, 1.5)
    EXPECT_EQ(mask.row(100 - 70)[100], 0);  // outside the edge at y = -0.75
}

// The convention of the centre: (i, j) -> (N - i, N - j) about sample (N/2, N/2).
TEST(Draw, SymmetricShapesAreSymmetricAboutTheAxisSample) {
    const ApertureGrid grid{96, 7};
    for (const Shape& shape : {disc(2.1), annulus(0.7, 2.2), rectangle(3, 1, 20), ellipse(3, 1, 50),
                               regular_polygon(6, 2.5, 12, 0.4)}) {
        const Mask mask = drawn(grid, shape);
        for (int j = 1; j < 96; ++j) {
            for (int i = 1; i < 96; ++i) {
                ASSERT_NEAR(mask.row(j)[i], mask.row(96 - j)[96 - i], 1e-6) << i << ", " << j;
            }
        }
    }
}

TEST(Draw, BlendsCombineCoverageWithWhatIsThere) {
    const ApertureGrid grid{32, 4};
    const Shape half_plane = rectangle(2, 9, 0, {1 - 1.0 / 16, 0});  // columns 16 to 31 exactly
    const auto after = [&](Blend blend, float value) {
        Mask mask(grid, 0.5F);
        draw(mask, half_plane, blend, value);
        return std::pair(mask.row(9)[8], mask.row(9)[24]);
    };
    EXPECT_EQ(after(Blend::kAdd, 2), std::pair(0.5F, 2.5F));
    EXPECT_EQ(after(Blend::kMax, 0.7F), std::pair(0.5F, 0.7F));
    EXPECT_EQ(after(Blend::kMax, 0.2F), std::pair(0.5F, 0.5F));
    EXPECT_EQ(after(Blend::kMultiply, 0), std::pair(0.5F, 0.0F));
    EXPECT_EQ(after(Blend::kMultiply, -1), std::pair(0.5F, -0.5F));
    EXPECT_EQ(after(Blend::kKeep, 1), std::pair(0.0F, 0.5F));
}

TEST(Draw, NothingIsLitOutsideTheShape) {
    const ApertureGrid grid{256, 10};
    const Mask mask = drawn(grid, disc(2.5, {0.3, 0.2}));
    for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) {
            const double r = std::hypot(grid.x_mm(i) - 0.3, grid.y_mm(j) - 0.2);
            if (std::abs(r - 2.5) <= grid.spacing_mm()) continue;
            ASSERT_EQ(mask.row(j)[i], r < 2.5 ? 1 : 0) << i << ", " << j;
        }
    }
}

TEST(Draw, ShapesOutsideTheRasterLeaveItAsItIs) {
    Mask mask({32, 4}, 0.25F);
    draw(mask, disc(1, {50, 0}));
    draw(mask, disc(1, {0, -50}), Blend::kMultiply, 0);
    draw(mask, {}, Blend::kAdd);
    EXPECT_EQ(*std::min_element(mask.values.data(), mask.values.data() + 1024), 0.25F);
    EXPECT_EQ(*std::max_element(mask.values.data(), mask.values.data() + 1024), 0.25F);
    draw(mask, disc(1, {50, 0}), Blend::kKeep);
    EXPECT_EQ(*std::max_element(mask.values.data(), mask.values.data() + 1024), 0);
}

TEST(Draw, BadShapesAreNamed) {
    EXPECT_THROW(disc(0), InvalidArgument);
    EXPECT_THROW(disc(std::nan("")), InvalidArgument);
    EXPECT_THROW(annulus(2, 1), InvalidArgument);
    EXPECT_THROW(ellipse(1, -1), InvalidArgument);
    EXPECT_THROW(regular_polygon(2, 1), InvalidArgument);
    EXPECT_THROW(regular_polygon(5, 1, 0, 1.5), InvalidArgument);
    EXPECT_THROW(lash({{}, 90, 0}), InvalidArgument);
    const std::vector<RadiusHarmonic> wild = {{2, 1.0, 0}};
    EXPECT_THROW(irregular_disc(1, wild), InvalidArgument);
    EXPECT_THROW(Mask({30 * 11, 1}), InvalidArgument);
    EXPECT_THROW(Mask({15, 1}), InvalidArgument);
    EXPECT_THROW(Mask({16, 0}), InvalidArgument);
    Mask mask({16, 1});
    EXPECT_THROW(draw(mask, disc(1, {1.0 / 0.0, 0})), InvalidArgument);
    const Particle bad{0, 0, -1};
    EXPECT_THROW(draw_particles(mask, {&bad, 1}), InvalidArgument);
    EXPECT_THROW(draw_particles(mask, {}, Blend::kKeep), InvalidArgument);
}

std::vector<Particle> some_particles() {
    Random random(7);
    std::vector<Particle> particles;
    for (int k = 0; k < 400; ++k) {
        particles.push_back({random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1),
                             random.log_uniform(1e-3, 60e-3)});
    }
    return particles;
}

TEST(DrawParticles, IsTheSameAsDrawingEachDisc) {
    const ApertureGrid grid{300, 2};
    const auto particles = some_particles();
    for (const Blend blend : {Blend::kAdd, Blend::kMultiply, Blend::kMax}) {
        Mask together(grid, 0.3F);
        Mask one_by_one(grid, 0.3F);
        draw_particles(together, particles, blend, -1);
        for (const Particle& p : particles) {
            draw(one_by_one, disc(p.radius_mm, {p.x_mm, p.y_mm}), blend, -1);
        }
        for (std::size_t s = 0; s < grid.size(); ++s) {
            ASSERT_NEAR(together.values[s], one_by_one.values[s], 2e-6) << s;
        }
    }
}

TEST(DrawParticles, DoesNotDependOnTheNumberOfThreads) {
    const ApertureGrid grid{300, 2};
    const auto particles = some_particles();
    const auto make = [&] {
        Mask mask(grid, 1);
        draw_particles(mask, particles, Blend::kMultiply, -1);
        draw(mask, disc(0.9), Blend::kKeep);
        return mask;
    };
    const Mask many = make();
    const ThreadLimit one(1);
    const Mask single = make();
    EXPECT_TRUE(
        std::equal(many.values.data(), many.values.data() + grid.size(), single.values.data()));
}

TEST(ImageMask, IsCentredUprightAndKeepsItsLight) {
    // 3 x 5 pixels of 1 mm; the top left one is bright.
    Image image(3, 5, 1);
    image.at(0, 0) = 1;
    image.at(1, 2) = 0.5F;
    const Mask mask = image_mask({70, 7}, image, 3);
    EXPECT_NEAR(area_mm2(mask), 1.5, 1e-5);
    EXPECT_NEAR(mask.row(35 + 20)[35 - 10], 1, 1e-6);  // x = -1, y = +2
    EXPECT_NEAR(mask.row(35)[35], 0.5, 1e-6);
    EXPECT_EQ(mask.row(35 - 20)[35 - 10], 0);
    EXPECT_EQ(mask.row(1)[35], 0);  // outside the picture
    // Coarser than the picture: averages.
    EXPECT_NEAR(area_mm2(image_mask({6, 12}, image, 3)), 1.5, 1e-5);
}

TEST(ImageMask, ClampsAndAveragesColour) {
    Image image(1, 1, 3);
    image.at(0, 0, 0) = 7;
    image.at(0, 0, 1) = 7;
    image.at(0, 0, 2) = 7;
    EXPECT_EQ(image_mask({4, 1}, image, 2).row(2)[2], 1);
    image.at(0, 0, 0) = 0;
    image.at(0, 0, 1) = 0.3F;
    image.at(0, 0, 2) = 0.6F;
    EXPECT_NEAR(image_mask({4, 1}, image, 2).row(2)[2], 0.3F, 1e-6);
    EXPECT_THROW(image_mask({4, 1}, {}, 1), InvalidArgument);
    EXPECT_THROW(image_mask({4, 1}, image, 0), InvalidArgument);
}

}  // namespace
}  // namespace aureole::wave
