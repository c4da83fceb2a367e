// Where matrix ghosts are and how bright, held to the crossings of linear optics one by one and to
// exact rays.
#include "lens/matrix_placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "aureole/base/random.h"
#include "aureole/color/spectrum.h"
#include "aureole/lens/glass.h"
#include "aureole/lens/paraxial.h"
#include "aureole/lens/trace.h"
#include "lens/matrix_test_support.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

TEST(CommonArea, EqualsCountingForRandomDiscs) {
    Random random(11);
    for (int run = 0; run < 300; ++run) {
        std::vector<LineDisc> discs;
        const int count = 1 + static_cast<int>(random.uniform(0, 6));
        for (int k = 0; k < count; ++k) {
            discs.push_back({random.uniform(-1, 1), random.log_uniform(0.3, 4), k});
        }
        std::sort(discs.begin(), discs.end(),
                  [](const LineDisc& a, const LineDisc& b) { return a.center < b.center; });
        std::vector<LineDisc> scratch(discs.size());
        const BoundingDiscs bounds = bounding_discs(discs, scratch);
        const CommonArea common = common_area(bounds);
        double area = 0;
        double moment = 0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double x = 10 * ((i + 0.5) / kSteps) - 5;
            double half2 = 1e9;
            for (const LineDisc& disc : discs) {
                half2 = std::min(half2,
                                 disc.radius * disc.radius - (x - disc.center) * (x - disc.center));
            }
            if (half2 <= 0) continue;
            area += 2 * std::sqrt(half2) * 10 / kSteps;
            moment += x * 2 * std::sqrt(half2) * 10 / kSteps;
        }
        EXPECT_NEAR(common.area, area, 2e-4);
        if (area > 1e-2) {
            EXPECT_NEAR(common.middle, moment / area, 1e-3);
        }
        // Leaving out any disc that is not an edge changes nothing.
        for (int k = 0; common.area > 0 && k < count; ++k) {
            if (std::any_of(bounds.discs.begin(), bounds.discs.end(),
                            [&](const LineDisc& disc) { return disc.clip == k; })) {
                continue;
            }
            std::vector<LineDisc> fewer;
            for (const LineDisc& disc : discs) {
                if (disc.clip != k) fewer.push_back(disc);
            }
            std::vector<LineDisc> room(fewer.size());
            EXPECT_NEAR(common_area(bounding_discs(fewer, room)).area, common.area, 1e-9);
        }
    }
}

TEST(OpenArea, EqualsCountingForClippedIrises) {
    Random random(5);
    for (const int blades : {0, 5, 6}) {
        for (const double smoothing : {0.0, 0.1}) {
            const Iris iris({.blades = blades,
                             .rotation_deg = 7,
                             .curvature = blades == 6 ? 0.5 : 0.0,
                             .smoothing = smoothing});
            const Pupil pupil = {&iris, nullptr, nullptr};
            for (int run = 0; run < 6; ++run) {
                MatrixGhost::Clip clips[2];
                for (MatrixGhost::Clip& clip : clips) {
                    clip.u0 = static_cast<float>(random.uniform(-0.7, 0.7));
                    clip.v0 = static_cast<float>(random.uniform(-0.7, 0.7));
                    clip.ru = static_cast<float>(random.uniform(0.7, 1.5));
                    clip.rv = static_cast<float>(random.uniform(0.7, 1.5));
                }
                clips[1].iris = true;
                clips[1].ru = -clips[1].rv;
                const OpenArea open = open_area(pupil, {}, clips);
                constexpr int kSteps = 400;
                double area = 0;
                double middle_u = 0;
                for (int j = 0; j < kSteps; ++j) {
                    for (int i = 0; i < kSteps; ++i) {
                        const float u = 3 * (static_cast<float>(i) + 0.5F) / kSteps - 1.5F;
                        const float v = 3 * (static_cast<float>(j) + 0.5F) / kSteps - 1.5F;
                        const auto in = [&](const MatrixGhost::Clip& clip) {
                            const float cu = (u - clip.u0) / clip.ru;
                            const float cv = (v - clip.v0) / clip.rv;
                            return clip.iris ? iris.distance(cu, cv) < 1 : std::hypot(cu, cv) < 1;
                        };
                        if (iris.distance(u, v) < 1 && in(clips[0]) && in(clips[1])) {
                            area += 9.0 / (kSteps * kSteps);
                            middle_u += 9.0 / (kSteps * kSteps) * static_cast<double>(u);
                        }
                    }
                }
                const double tolerance = smoothing > 0 && blades > 0 ? 1e-2 : 3e-3;
                // Counting is right to about 1e-3; with smooth corners, 28 x 28 points are looked
                // at.
                EXPECT_NEAR(open.area, area, tolerance) << blades;
                EXPECT_NEAR(open.area * open.middle_u, middle_u, tolerance);
            }
        }
    }
}

// By small squares whose edges are shaded.
OpenChords count_open(const Iris& iris, double along_u, double along_v,
                      std::span<const LineClip> clips) {
    constexpr int kSide = 240;
    constexpr double kStep = 2.5 / kSide;
    OpenChords open;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const double u = (i + 0.5) * kStep - 1.25;
            const double v = (j + 0.5) * kStep - 1.25;
            const auto iris_outside = [&](double at_u, double at_v) {
                return static_cast<double>(
                           iris.distance(static_cast<float>(at_u), static_cast<float>(at_v))) -
                       1;
            };
            double outside = iris_outside(u, v);
            for (const LineClip& clip : clips) {
                const double clip_u = u - clip.center * along_u;
                const double clip_v = v - clip.center * along_v;
                outside = std::max(
                    outside, clip.iris ? std::abs(clip.radius) * iris_outside(clip_u / clip.radius,
                                                                              clip_v / clip.radius)
                                       : std::hypot(clip_u, clip_v) - clip.radius);
            }
            const double area = kStep * kStep * std::clamp(0.5 - outside / kStep, 0.0, 1.0);
            open.area += area;
            open.middle_along += area * (u * along_u + v * along_v);
            open.middle_across += area * (v * along_u - u * along_v);
        }
    }
    open.middle_along /= open.area;
    open.middle_across /= open.area;
    return open;
}

TEST(IrisChords, EqualCounting) {
    Random random(8);
    for (const IrisShape& shape :
         {IrisShape{.blades = 5, .rotation_deg = 9}, IrisShape{.blades = 8},
          IrisShape{.blades = 9, .rotation_deg = 2, .curvature = 0.6},
          IrisShape{.blades = 6, .smoothing = 0.2}, IrisShape{.blades = 64}}) {
        const Iris iris(shape);
        IrisChords chords(iris);
        int small = 0;
        for (int run = 0; run < 36; ++run) {
            const double angle = random.uniform(0, 2 * kPi);
            const double along_u = std::cos(angle);
            const double along_v = std::sin(angle);
            chords.turn_to(along_u, along_v);
            LineClip clips[2];
            for (LineClip& clip : clips) {
                clip.center = random.uniform(-1.6, 1.6);
                clip.radius = random.uniform(0.7, 2);
            }
            // Huge ones are nearly straight.
            if (run % 3 == 0) {
                clips[0].radius = random.log_uniform(10, 1000);
                clips[0].center = clips[0].radius + random.uniform(-0.9, 0.9);
            }
            clips[1].iris = run % 2 == 0;
            if (clips[1].iris && run % 4 == 0) clips[1].radius = -clips[1].radius;
            const OpenChords open = chords.open(clips);
            const OpenChords expected = count_open(iris, along_u, along_v, clips);
            EXPECT_NEAR(open.area, expected.area, 1e-3 * kPi) << run;
            if (expected.area < 0.02) continue;
            small += expected.area < 0.3 ? 1 : 0;
            EXPECT_NEAR(open.area / expected.area, 1, 0.01) << run << ": " << expected.area;
            EXPECT_NEAR(open.middle_along, expected.middle_along, 3e-3) << run;
            EXPECT_NEAR(open.middle_across, expected.middle_across, 3e-3) << run;
        }
        EXPECT_GT(small, 0);
        // Of the whole iris, whatever the light.
        const LineClip wide = {0.3, 5, false};
        EXPECT_NEAR(chords.open({&wide, 1}).area, kPi, 1e-3 * kPi);
    }
}

// Points of the drawn iris, as rays of linear optics, met by every aperture on their way: where all
// let them pass, coverage must be 1, and 0 where one does not. Oracle: the matrices themselves,
// crossing by crossing; placement sees only what is left after much simplification.
void compare_with_crossings(MatrixScene& scene, double tan_x, double tan_y) {
    const Lens& lens = scene.lens;
    scene.ghosts.place(test_light(scene.view, tan_x, tan_y));
    const double stop = lens.stop_radius_mm();
    int open_points = 0;
    int blocked_points = 0;
    Random random(17);
    for (std::size_t g = 0; g < scene.list.size(); ++g) {
        const MatrixGhost& ghost = scene.ghosts.placements()[g];
        const GhostMatrices matrices = ghost_matrices(lens, scene.list[g], kLineDNm);
        const auto& reference =
            matrices.crossings[static_cast<std::size_t>(matrices.stop_crossings.back())].matrix;
        // Near a focus in the stop the iris is widened on purpose (matrix_path.cpp).
        if (std::abs(reference.x.a) < 0.05) continue;
        for (int point = 0; point < 60; ++point) {
            const double u = random.uniform(-1.1, 1.1);
            const double v = random.uniform(-1.1, 1.1);
            const double px = (u * stop + reference.x.b * tan_x) / reference.x.a;
            const double py = (v * stop + reference.y.b * tan_y) / reference.y.a;
            double clip = 0;
            for (const CrossingMatrix& crossing : matrices.crossings) {
                const double x = crossing.matrix.x.a * px - crossing.matrix.x.b * tan_x;
                const double y = crossing.matrix.y.a * py - crossing.matrix.y.b * tan_y;
                clip = std::max(
                    clip,
                    std::hypot(x, y) /
                        lens.faces()[static_cast<std::size_t>(crossing.face)].semi_aperture_mm);
            }
            const double sensor_x = matrices.to_sensor.x.a * px - matrices.to_sensor.x.b * tan_x;
            const double sensor_y = matrices.to_sensor.y.a * py - matrices.to_sensor.y.b * tan_y;
            if (ghost.u_per_px == 0) {
                EXPECT_GT(clip, 0.999) << "ghost " << g;
                continue;
            }
            // Ghosts of few pixels are all edge.
            if (std::abs(1 / ghost.u_per_px) < 20 || std::abs(clip - 1) < 0.1) continue;
            const float share =
                ghost.coverage(scene.iris, static_cast<float>(scene.film.px(sensor_x)),
                               static_cast<float>(scene.film.py(sensor_y)));
            EXPECT_NEAR(share, clip < 1 ? 1 : 0, 1e-3) << "ghost " << g << ", clip " << clip;
            ++(clip < 1 ? open_points : blocked_points);
        }
    }
    EXPECT_GT(open_points, 50);
    EXPECT_GT(blocked_points, 50);
}

TEST(MatrixGhosts, EveryApertureOfEveryCrossingClips) {
    for (const char* id : {"heliar", "biotar", "nikon-28-75"}) {
        SCOPED_TRACE(id);
        const Lens lens{shipped_lens(id)};
        MatrixScene scene(lens, test_view(lens, 4000, 3000));
        compare_with_crossings(scene, 0.0, 0.0);
        compare_with_crossings(scene, 0.05, -0.03);
        compare_with_crossings(scene, -0.2, 0.25);
    }
}

// An anamorphic pair of cylinders in front of a thin lens.
Lens anamorphic_lens() {
    Prescription lens = lens_of({{.radius_mm = 0, .thickness_mm = 2, .index = 1.5},
                                 {.radius_mm = 60,
                                  .thickness_mm = 15,
                                  .semi_aperture_mm = 12,
                                  .profile = Profile::kCylinderX},
                                 {.thickness_mm = 3, .semi_aperture_mm = 6, .stop = true},
                                 {.radius_mm = 40, .thickness_mm = 3, .index = 1.6},
                                 {.radius_mm = -60, .thickness_mm = 40}});
    lens.surfaces[0].semi_aperture_mm = 14;
    return Lens(lens, {.f_number = 8});
}

TEST(MatrixGhosts, CylindersClipByEllipses) {
    const Lens lens = anamorphic_lens();
    MatrixScene scene(lens, test_view(lens, 4000, 3000));
    compare_with_crossings(scene, 0.05, 0.02);
    compare_with_crossings(scene, 0.2, -0.15);
}

// Rays so near the axis that aberrations are below 1e-6.
TEST(MatrixGhosts, PositionsAreThoseOfExactRaysNearTheAxis) {
    constexpr double kTan = 1e-6;
    for (const Lens& lens : {Lens(shipped_lens("heliar")), Lens(shipped_lens("nikon-28-75")),
                             Lens(shipped_lens("tessar")), anamorphic_lens()}) {
        MatrixScene scene(lens, test_view(lens, 1920, 1080));
        scene.ghosts.place(test_light(scene.view, kTan, -2 * kTan));
        const Tracer tracer(lens, kLineDNm);
        for (std::size_t g = 0; g < scene.list.size(); ++g) {
            const MatrixGhost& ghost = scene.ghosts.placements()[g];
            if (ghost.u_per_px == 0 || ghost.radius_px > 2e4F) continue;
            const TracedRay ray =
                tracer.trace(scene.list[g], ray_from_light(kTan, -2 * kTan, 1e-4, 2e-4));
            ASSERT_EQ(ray.fate, Fate::kArrived);
            const double u = (scene.film.px(ray.x_mm) - static_cast<double>(ghost.center_x)) *
                             static_cast<double>(ghost.u_per_px);
            const double v = (scene.film.py(ray.y_mm) - static_cast<double>(ghost.center_y)) *
                             static_cast<double>(ghost.v_per_px);
            // Centres are in single precision.
            const double rounding = 1e-4 * std::abs(static_cast<double>(ghost.u_per_px));
            EXPECT_NEAR(u, ray.stop_x_mm / lens.stop_radius_mm(), rounding + 1e-7) << g;
            EXPECT_NEAR(v, ray.stop_y_mm / lens.stop_radius_mm(), rounding + 1e-7) << g;
        }
    }
}

// Mean radiance of the unclipped ghosts of an iris over that at twice the f-number.
struct Stopping {
    double radius = 0;    // of the ghosts, wide over narrow
    double radiance = 0;  // narrow over wide
    double energy = 0;
};
Stopping stop_down(double f_number) {
    const Lens wide(shipped_lens("heliar"), {.f_number = f_number});
    const Lens narrow(shipped_lens("heliar"), {.f_number = 2 * f_number});
    MatrixScene before(wide, test_view(wide, 960, 640));
    MatrixScene after(narrow, test_view(narrow, 960, 640));
    const sources::Light light = test_light(before.view, 0.03, 0.04);
    before.ghosts.place(light);
    after.ghosts.place(light);
    double sums[2][3] = {};
    for (std::size_t g = 0; g < before.list.size(); ++g) {
        const MatrixGhost& a = before.ghosts.placements()[g];
        const MatrixGhost& b = after.ghosts.placements()[g];
        if (a.energy == 0 || a.clip_count > 0 || b.clip_count > 0) continue;
        for (const MatrixGhost* ghost : {&a, &b}) {
            double* sum = sums[ghost == &b];
            sum[0] += static_cast<double>(ghost->radius_px);
            sum[1] += static_cast<double>(ghost->radiance[1]);
            sum[2] += static_cast<double>(ghost->energy);
        }
    }
    return {sums[0][0] / sums[1][0], sums[1][1] / sums[0][1], sums[1][2] / sums[0][2]};
}

TEST(MatrixGhosts, StoppingDownBrightensGhostsAndKeepsTheirEnergy) {
    // At equal exposure the picture keeps its values, so that a ghost of the iris, a quarter as
    // large at f/16 as at f/8, with a quarter of the light, over a quarter of the image's light, is
    // four times as bright: radiance goes as N^2, the ghost's area as N^-2, its energy not at all.
    const Stopping small = stop_down(32);
    EXPECT_NEAR(small.radius, 2, 2e-3);
    EXPECT_NEAR(small.radiance, 4, 0.1);
    EXPECT_NEAR(small.energy, 1, 0.03);
    // At f/8 aberrations already keep light of the wide beam from some ghosts.
    const Stopping document = stop_down(8);
    EXPECT_NEAR(document.radius, 2, 1e-2);
    EXPECT_GT(document.radiance, 4);
    EXPECT_LT(document.radiance, 5);
    EXPECT_GT(document.energy, 1);
}

TEST(MatrixGhosts, EnergyIsContinuousWhenALightMoves) {
    const Lens lens(shipped_lens("nikon-28-75"));
    MatrixScene scene(lens, test_view(lens, 1920, 1080));
    const double step = 0.1 / scene.view.focal_length_px();
    // Through angles at which housings begin to clip and block.
    for (const double start : {0.0, 0.1, 0.3, 0.8}) {
        std::vector<float> before;
        double total_before = 0;
        for (int i = 0; i < 20; ++i) {
            scene.ghosts.place(test_light(scene.view, start + i * step, 0.4 * start));
            double total = 0;
            double strongest = 0;
            for (const MatrixGhost& ghost : scene.ghosts.placements()) {
                total += static_cast<double>(ghost.energy);
                strongest = std::max(strongest, static_cast<double>(ghost.energy));
            }
            const auto placements = scene.ghosts.placements();
            for (std::size_t g = 0; i > 0 && g < placements.size(); ++g) {
                EXPECT_NEAR(placements[g].energy, before[g], 0.005 * strongest) << g;
            }
            if (i > 0) {
                EXPECT_NEAR(total / total_before, 1, 0.003);
            }
            total_before = total;
            before.clear();
            for (const MatrixGhost& ghost : placements) before.push_back(ghost.energy);
        }
    }
}

TEST(MatrixGhosts, ALightThatIsNotSeenMakesNone) {
    const Lens lens(shipped_lens("heliar"));
    MatrixScene scene(lens, test_view(lens, 192, 108));
    const auto expect_dark = [&](const sources::Light& light) {
        scene.ghosts.place(light);
        for (const MatrixGhost& ghost : scene.ghosts.placements()) {
            EXPECT_EQ(ghost.u_per_px, 0);
            EXPECT_EQ(ghost.energy, 0);
        }
        EXPECT_EQ(sum_of(scene.draw_all()), 0);
    };
    sources::Light light = test_light(scene.view, 1000, 1000);
    expect_dark(light);
    light.tan_x = std::numeric_limits<double>::quiet_NaN();
    expect_dark(light);
    light = test_light(scene.view, 0.1, 0);
    light.radiance = {};
    expect_dark(light);
    light.radiance = {1, std::numeric_limits<float>::infinity(), 1};
    expect_dark(light);
}

TEST(MatrixGhosts, AtASmallStopAllIsThatOfTheRayThroughItsMiddle) {
    // Nothing clips the Heliar's ghosts at small angles, so that the middle is the iris's own.
    const Lens lens(shipped_lens("heliar"), {.f_number = 64});
    MatrixScene scene(lens, test_view(lens, 960, 640));
    std::vector<Tracer> tracers;
    const auto bands = color::sample_spectrum(16);
    for (const auto& band : bands) tracers.emplace_back(lens, band.wavelength_nm);
    for (const double tangent : {0.003, 0.01}) {
        scene.ghosts.place(test_light(scene.view, tangent, 0));
        for (std::size_t g = 0; g < scene.list.size(); ++g) {
            const MatrixGhost& ghost = scene.ghosts.placements()[g];
            if (ghost.energy == 0 || ghost.clip_count > 0) continue;
            const GhostMatrices matrices = ghost_matrices(lens, scene.list[g], kLineDNm);
            const auto& stop =
                matrices.crossings[static_cast<std::size_t>(matrices.stop_crossings.back())];
            const Ray ray =
                ray_from_light(tangent, 0, stop.matrix.x.b * tangent / stop.matrix.x.a, 0);
            double expected[3] = {};
            for (std::size_t i = 0; i < bands.size(); ++i) {
                const double share = tracers[i].throughput(scene.list[g], ray) /
                                     tracers[i].throughput(Bounces{}, ray_from_light(0, 0, 0, 0));
                for (std::size_t c = 0; c < 3; ++c) expected[c] += bands[i].rgb[c] * share;
            }
            const sources::Light light = test_light(scene.view, tangent, 0);
            const double scale = static_cast<double>(ghost.radiance[1]) / expected[1];
            for (std::size_t c = 0; c < 3; ++c) {
                const double ratio = light.radiance[c] / light.radiance[1];
                EXPECT_NEAR(static_cast<double>(ghost.radiance[c]), scale * expected[c] * ratio,
                            0.03 * std::abs(scale * expected[c]))
                    << g;
            }
            // flare.h; the beams' areas are right to some per cent.
            const double irradiance =
                light.solid_angle_sr * static_cast<double>(light.radiance[1]) /
                std::sqrt(1 + tangent * tangent) / std::pow(matrices.to_sensor.x.a, 2) /
                scene.film.irradiance_per_radiance;
            EXPECT_NEAR(scale / irradiance, 1, 0.03) << g;
        }
    }
}

}  // namespace
}  // namespace aureole::lens
