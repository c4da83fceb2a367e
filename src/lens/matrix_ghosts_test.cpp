// Matrix ghosts as they come out of the canvas.
#include "lens/matrix_ghosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/parallel.h"
#include "aureole/base/random.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/trace.h"
#include "lens/matrix_test_support.h"

namespace aureole::lens {
namespace {

// A ring with a spoke.
Image ring() {
    Image image(80, 80, 1);
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 80; ++x) {
            const double r = std::hypot(x - 39.5, y - 39.5);
            image.at(x, y) = (r < 36 && r > 15) || (std::abs(x - 50) < 4 && r < 15) ? 1.0F : 0.0F;
        }
    }
    return image;
}

Image noise(int side, std::uint64_t seed) {
    Image image(side, side, 1);
    Random random(seed);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        image.plane(0)[i] = static_cast<float>(random.uniform());
    }
    return image;
}

// Ghosts that lie inside the picture with room to spare for blur and interpolation.
bool inside(const MatrixGhost& ghost, const View& view, int level) {
    const double reach = 1.2 * static_cast<double>(ghost.radius_px * (1 + ghost.edge)) +
                         3.0 * (1 << level) + 4 * std::sqrt(static_cast<double>(ghost.spot_yy));
    const auto x = static_cast<double>(ghost.open_x);
    const auto y = static_cast<double>(ghost.open_y);
    return x > reach && y > reach && x < view.width - reach && y < view.height - reach;
}

// Draws ghosts one by one and compares the sum of their pixels with what placement says: there the
// area of the open part is exact.
int compare_sums(MatrixScene& scene, const sources::Light& light, double tolerance) {
    scene.ghosts.place(light);
    int compared = 0;
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        const MatrixGhost ghost = scene.ghosts.placements()[g];
        if (ghost.energy == 0) continue;
        for (int level = 0; level < 5; ++level) {
            // As the plan of the flare does: at least 8 pixels of the level across the radius.
            if (level > 0 && ghost.open_radius_px < 8.0F * static_cast<float>(1 << level)) break;
            if (!inside(ghost, scene.view, level)) continue;
            const double sum = sum_of(scene.draw({{static_cast<int>(g), level}}));
            EXPECT_NEAR(sum / static_cast<double>(ghost.energy), 1, tolerance)
                << "ghost " << g << ", level " << level << ", radius " << ghost.radius_px
                << ", open " << ghost.open_radius_px << ", clips " << ghost.clip_count;
            ++compared;
        }
    }
    return compared;
}

TEST(MatrixGhosts, SumOfPixelsIsAreaTimesRadiance) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 8});
    const View view = test_view(lens, 600, 460, 90);
    for (const IrisShape& shape : {IrisShape{}, IrisShape{.blades = 6, .rotation_deg = 11},
                                   IrisShape{.blades = 7, .rotation_deg = 3, .curvature = 0.5},
                                   IrisShape{.blades = 5, .smoothing = 0.1}}) {
        MatrixScene scene(lens, view, Iris(shape));
        int compared = compare_sums(scene, test_light(view, 0.01, 0.02), 1e-3);
        compared += compare_sums(scene, test_light(view, -0.13, 0.06), 1e-3);
        EXPECT_GT(compared, 30) << shape.blades;
    }
}

TEST(MatrixGhosts, SumOfPixelsOfClippedGhosts) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 600, 460, 160);
    for (const IrisShape& shape :
         {IrisShape{}, IrisShape{.blades = 6, .rotation_deg = 11},
          IrisShape{.blades = 9, .curvature = 0.5}, IrisShape{.blades = 5, .smoothing = 0.1}}) {
        MatrixScene scene(lens, view, Iris(shape));
        int clipped = 0;
        for (const double tangent : {0.1, 0.2, 0.35}) {
            EXPECT_GT(compare_sums(scene, test_light(view, tangent, -0.3 * tangent), 1.5e-3), 5);
            for (const MatrixGhost& ghost : scene.ghosts.placements()) {
                clipped += ghost.clip_count > 0;
            }
        }
        EXPECT_GT(clipped, 20) << shape.blades;
    }
}

TEST(MatrixGhosts, SumOfPixelsOfLargeLights) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 8});
    const View view = test_view(lens, 900, 700, 90);
    MatrixScene scene(lens, view, Iris({.blades = 6}));
    for (const double radius : {0.002, 0.01, 0.05}) {
        EXPECT_GT(compare_sums(scene, test_light(view, 0.02, 0.01, radius), 1e-3), 10) << radius;
    }
}

TEST(MatrixGhosts, SumOfPixelsWithPicturesInThePupil) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 8});
    const View view = test_view(lens, 600, 460, 90);
    const sources::Light light = test_light(view, 0.02, 0.01);
    // Interpolation between the pyramid's levels, and 28 x 28 samples in placement.
    constexpr double kTolerance = 0.01;
    MatrixScene image(lens, view, Iris(ring()));
    EXPECT_GT(compare_sums(image, light, kTolerance), 10);
    FlareOptions textured;
    textured.ghost_texture = noise(16, 3);
    MatrixScene texture(lens, view, Iris(), textured);
    EXPECT_GT(compare_sums(texture, light, kTolerance), 10);
    const Occluder dirt(noise(12, 4), 30);
    MatrixScene dirty(lens, view, Iris(), {}, &dirt);
    EXPECT_GT(compare_sums(dirty, light, kTolerance), 10);
    // Half of the light is lost in it.
    MatrixScene clean(lens, view);
    clean.ghosts.place(light);
    const double clean_sum = sum_of(clean.draw_all());
    EXPECT_NEAR(sum_of(dirty.draw_all()) / clean_sum, 0.5, 0.1);
}

// The plain coverage() is what the kernels must draw, at full resolution.
TEST(MatrixGhosts, KernelsDrawThePlainCoverage) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 480, 360);
    for (const IrisShape& shape :
         {IrisShape{}, IrisShape{.blades = 6, .rotation_deg = 10},
          IrisShape{.blades = 9, .curvature = 0.7}, IrisShape{.blades = 5, .smoothing = 0.1}}) {
        MatrixScene scene(lens, view, Iris(shape));
        for (const double light_radius : {0.0, 0.01}) {
            scene.ghosts.place(test_light(view, 0.2, 0.11, light_radius));
            for (std::size_t g = 0; g < scene.list.size(); g += 4) {
                const MatrixGhost& ghost = scene.ghosts.placements()[g];
                // Smaller ones are corrected to their exact sum.
                if (ghost.energy == 0 || (ghost.open_radius_px < 10 && !ghost.spot)) continue;
                const Image out = scene.draw({{static_cast<int>(g), 0}});
                for (int y = 0; y < view.height; y += 9) {
                    for (int x = 0; x < view.width; ++x) {
                        const float share = ghost.coverage(scene.iris, static_cast<float>(x) + 0.5F,
                                                           static_cast<float>(y) + 0.5F);
                        // Centres far outside the picture round to some hundredths of a pixel;
                        // spots are normalised to their sum.
                        ASSERT_NEAR(out.at(x, y, 0) / ghost.radiance[0], share,
                                    ghost.spot ? 0.01 * static_cast<double>(share) + 1e-6 : 0.02)
                            << "ghost " << g << " at " << x << ", " << y;
                    }
                }
            }
        }
    }
}

TEST(MatrixGhosts, SameBitsOnAnyNumberOfThreads) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 640, 360);
    MatrixScene scene(lens, view, Iris({.blades = 7}));
    scene.ghosts.place(test_light(view, 0.06, 0.03));
    std::vector<GhostDraw> draws;
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        draws.push_back({static_cast<int>(g), static_cast<int>(g % 4), {1, 0.5F, 2}});
    }
    const Image several = scene.draw(draws);
    const ThreadLimit limit(1);
    const Image one = scene.draw(draws);
    ASSERT_GT(sum_of(one), 0);
    for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < one.pixels(); ++i) {
            ASSERT_EQ(one.plane(c)[i], several.plane(c)[i]);
        }
    }
}

TEST(MatrixGhosts, GainsAreOfEachColour) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 320, 180);
    MatrixScene scene(lens, view);
    scene.ghosts.place(test_light(view, 0.06, 0.03));
    const Image plain = scene.draw({{5, 0}});
    const Image tinted = scene.draw({{5, 0, {0.5F, 2, 0}}});
    for (std::size_t i = 0; i < plain.pixels(); ++i) {
        ASSERT_FLOAT_EQ(tinted.plane(0)[i], 0.5F * plain.plane(0)[i]);
        ASSERT_FLOAT_EQ(tinted.plane(1)[i], 2 * plain.plane(1)[i]);
        ASSERT_EQ(tinted.plane(2)[i], 0);
    }
}

TEST(MatrixGhosts, AMirroredLightMakesTheMirroredPicture) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 300, 200);
    // A hexagon with a corner to the right is its own mirror image both ways.
    MatrixScene scene(lens, view, Iris({.blades = 6}));
    scene.ghosts.place(test_light(view, 0.07, 0.04));
    const Image right = scene.draw_all();
    scene.ghosts.place(test_light(view, -0.07, 0.04));
    const Image left = scene.draw_all();
    scene.ghosts.place(test_light(view, 0.07, -0.04));
    const Image below = scene.draw_all();
    double brightest = 0;
    for (std::size_t i = 0; i < right.pixels(); ++i) {
        brightest = std::max(brightest, static_cast<double>(right.plane(1)[i]));
    }
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 300; ++x) {
            // An edge pixel changes with the rounding of centres.
            ASSERT_NEAR(left.at(299 - x, y, 1), right.at(x, y, 1), 2e-3 * brightest);
            ASSERT_NEAR(below.at(x, 199 - y, 1), right.at(x, y, 1), 2e-3 * brightest);
        }
    }
}

TEST(MatrixGhosts, PictureIsContinuousWhenALightMoves) {
    const Lens lens(shipped_lens("biotar"));
    const View view = test_view(lens, 480, 270);
    MatrixScene scene(lens, view, Iris({.blades = 9, .curvature = 0.3}));
    const double step = 0.1 / view.focal_length_px();
    Image before;
    for (int i = 0; i < 6; ++i) {
        scene.ghosts.place(test_light(view, 0.1 + i * step, 0.05));
        Image now = scene.draw_all();
        if (i > 0) {
            double difference = 0;
            for (int c = 0; c < 3; ++c) {
                for (std::size_t p = 0; p < now.pixels(); ++p) {
                    difference += std::abs(static_cast<double>(now.plane(c)[p]) -
                                           static_cast<double>(before.plane(c)[p]));
                }
            }
            EXPECT_NEAR(sum_of(now) / sum_of(before), 1, 0.002);
            EXPECT_LT(difference / sum_of(now), 0.02);
        }
        before = std::move(now);
    }
}

// A large light is as many small ones.
TEST(MatrixGhosts, LargeLightIsTheMeanOfPoints) {
    const Lens lens(shipped_lens("heliar"), {.f_number = 8});
    const View view = test_view(lens, 480, 360, 60);
    MatrixScene scene(lens, view);
    const double radius = 0.01;
    const sources::Light large = test_light(view, 0.05, 0.02, radius);
    scene.ghosts.place(large);
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        scene.ghosts.place(large);
        const MatrixGhost ghost = scene.ghosts.placements()[g];
        if (ghost.energy == 0 || !inside(ghost, view, 0)) continue;
        const Image soft = scene.draw({{static_cast<int>(g), 0}});
        Image mean(view.width, view.height, 3);
        constexpr int kPoints = 200;
        for (int i = 0; i < kPoints; ++i) {
            // Vogel's spiral: equal areas.
            const double r = radius * std::sqrt((i + 0.5) / kPoints);
            const double angle = 2.399963 * i;
            sources::Light point = large;
            point.tan_x += r * std::cos(angle);
            point.tan_y += r * std::sin(angle);
            point.moment_xx = point.moment_yy = 0;
            point.solid_angle_sr /= kPoints;
            scene.ghosts.place(point);
            const Image one = scene.draw({{static_cast<int>(g), 0}});
            for (std::size_t p = 0; p < one.pixels(); ++p) mean.plane(1)[p] += one.plane(1)[p];
        }
        double difference = 0;
        double total = 0;
        for (std::size_t p = 0; p < mean.pixels(); ++p) {
            difference += std::abs(static_cast<double>(mean.plane(1)[p]) -
                                   static_cast<double>(soft.plane(1)[p]));
            total += static_cast<double>(mean.plane(1)[p]);
        }
        // Edges are ramps of the right variance, not of the right shape, and spots have no shape
        // of their own.
        EXPECT_LT(difference / total, ghost.spot ? 0.25 : 0.05) << g;
    }
}

// Part of the plane of the first vertex.
struct EntranceSquare {
    double x_mm = 0, y_mm = 0;  // its middle
    double half_mm = 0;
};

// Calls visit(i, j, ray) for those of side x side rays of a light that pass.
template <class Visit>
void for_passing(const Tracer& tracer, const Bounces& bounces, const sources::Light& light,
                 const EntranceSquare& square, int side, const Visit& visit) {
    const double cell = 2 * square.half_mm / side;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const Ray ray = ray_from_light(light.tan_x, light.tan_y,
                                           square.x_mm - square.half_mm + (i + 0.5) * cell,
                                           square.y_mm - square.half_mm + (j + 0.5) * cell);
            if (tracer.trace(bounces, ray).passes()) visit(i, j, ray);
        }
    }
}

// Around all that passes of rays over the front, which holds the beam with room to spare.
EntranceSquare square_around_beam(const Lens& lens, const Tracer& tracer, const Bounces& bounces,
                                  const sources::Light& light) {
    constexpr int kSide = 90;
    // Light that passes the front crosses its vertex plane a little off.
    const double front = 1.1 * lens.faces().front().semi_aperture_mm;
    double low[2] = {front, front};
    double high[2] = {-front, -front};
    for_passing(tracer, bounces, light, {0, 0, front}, kSide, [&](int, int, const Ray& ray) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], ray.origin[k]);
            high[k] = std::max(high[k], ray.origin[k]);
        }
    });
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]),
            0.5 * std::max(high[0] - low[0], high[1] - low[1]) + 2 * front / kSide};
}

// What share of the light of the source arrives, by exact rays.
double exact_energy(const Lens& lens, const Film& film, const Bounces& bounces,
                    const sources::Light& light, const std::vector<Tracer>& tracers,
                    const std::vector<color::SpectralBand>& bands) {
    constexpr int kSide = 120;
    constexpr int kColorStep = 8;
    const Tracer& tracer = tracers[bands.size() / 2];
    const EntranceSquare square = square_around_beam(lens, tracer, bounces, light);
    std::vector<double> axial;
    for (const Tracer& of_band : tracers) {
        axial.push_back(of_band.throughput(Bounces{}, ray_from_light(0, 0, 0, 0)));
    }
    double area = 0;
    double color = 0;
    int colored = 0;
    for_passing(tracer, bounces, light, square, kSide, [&](int i, int j, const Ray& ray) {
        area += 4 * square.half_mm * square.half_mm / (kSide * kSide);
        if (i % kColorStep != kColorStep / 2 || j % kColorStep != kColorStep / 2) return;
        ++colored;
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const double share = tracers[b].throughput(bounces, ray) / axial[b];
            for (std::size_t c = 0; c < 3; ++c) {
                color += bands[b].rgb[c] * share * static_cast<double>(light.radiance[c]);
            }
        }
    });
    if (colored == 0) return 0;
    const double tangent2 = light.tan_x * light.tan_x + light.tan_y * light.tan_y;
    return area * color / colored * light.solid_angle_sr / std::sqrt(1 + tangent2) /
           (film.irradiance_per_radiance * film.mm_per_px * film.mm_per_px);
}

// The bar of the twenty strongest ghosts.
TEST(MatrixGhostsSlow, EnergyOfTheStrongestGhostsIsThatOfExactRays) {
    struct Case {
        const char* id;
        double f_number;
    };
    for (const Case& lens_case : {Case{"heliar", 8}, Case{"biotar", 8}, Case{"nikon-28-75", 8}}) {
        const Lens lens(shipped_lens(lens_case.id), {.f_number = lens_case.f_number});
        MatrixScene scene(lens, test_view(lens, 1920, 1080));
        const auto bands = color::sample_spectrum(16);
        std::vector<Tracer> tracers;
        for (const auto& band : bands) tracers.emplace_back(lens, band.wavelength_nm);
        const sources::Light light = test_light(scene.view, 0.02, 0.01);
        scene.ghosts.place(light);
        std::vector<std::size_t> order(scene.list.size());
        for (std::size_t g = 0; g < order.size(); ++g) order[g] = g;
        const auto placements = scene.ghosts.placements();
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return placements[a].energy > placements[b].energy;
        });
        constexpr std::size_t kStrongest = 20;
        std::vector<double> exact(kStrongest);
        parallel_for(kStrongest, [&](std::size_t i, int) {
            exact[i] = exact_energy(lens, scene.film, scene.list[order[i]], light, tracers, bands);
        });
        for (std::size_t i = 0; i < kStrongest; ++i) {
            const Bounces& ghost = scene.list[order[i]];
            EXPECT_NEAR(static_cast<double>(placements[order[i]].energy) / exact[i], 1, 0.04)
                << lens_case.id << " surfaces " << ghost.far + 1 << ", " << ghost.near + 1;
        }
    }
}

}  // namespace
}  // namespace aureole::lens
