// Exact rays, held to closed forms, to reversibility, and to symmetry.
#include "aureole/lens/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "aureole/lens/glass.h"
#include "aureole/lens/library.h"
#include "aureole/lens/paraxial.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

// Where a ray that arrived crosses the axis, behind the last vertex.
double axis_crossing(const Lens& lens, const TracedRay& ray) {
    return lens.sensor_z_mm() - lens.faces().back().z_mm -
           ray.y_mm * ray.direction[2] / ray.direction[1];
}

TracedRay parallel(const Lens& lens, double height_mm) {
    return Tracer(lens, kLineDNm).trace({}, ray_from_light(0, 0, 0, height_mm));
}

// Parallel light that leaves glass through a sphere: the sine theorem gives the crossing.
TEST(Trace, SphericalAberrationOfOneSphere) {
    const double n = 1.6, r = 40;
    const Lens lens(lens_of({{.thickness_mm = 1, .stop = true},
                             {.thickness_mm = 10, .index = n, .semi_aperture_mm = 25},
                             {.radius_mm = -r, .semi_aperture_mm = 25}}));
    for (double height = 0.5; height < 24.9; height += 0.7) {
        const double i = std::asin(height / r);
        const double out = std::asin(n * height / r);
        const double crossing = r * std::sin(out) / std::sin(out - i) - r;
        const TracedRay ray = parallel(lens, height);
        ASSERT_EQ(ray.fate, Fate::kArrived);
        EXPECT_NEAR(axis_crossing(lens, ray), crossing, 1e-11 * r);
        EXPECT_NEAR(ray.direction[1], -std::sin(out - i), 1e-14);
    }
    // sin i > 1 / n = 0.625 from h = 25 on.
    const TracedRay beyond = parallel(lens, 25.01);
    EXPECT_EQ(beyond.fate, Fate::kTotalReflection);
    EXPECT_EQ(beyond.failed_face, 2);
    EXPECT_FALSE(beyond.passes());
    const Tracer tracer(lens, kLineDNm);
    EXPECT_EQ(tracer.throughput({}, ray_from_light(0, 0, 0, 25.01)), 0);
}

// Light parallel in glass is focused without aberration by a hyperboloid of conic -n^2 into air
// (Descartes), at |r| / (n - 1).
TEST(Trace, HyperboloidFocusesExactly) {
    const double n = 1.5, r = 30;
    const Lens lens(lens_of({{.semi_aperture_mm = 40, .stop = true},
                             {.thickness_mm = 20, .index = n, .semi_aperture_mm = 40},
                             {.radius_mm = -r, .semi_aperture_mm = 40, .conic = -n * n}}));
    for (double height = 1; height < 40; height += 1.3) {
        const TracedRay ray = parallel(lens, height);
        ASSERT_EQ(ray.fate, Fate::kArrived);
        EXPECT_NEAR(axis_crossing(lens, ray), r / (n - 1), 1e-11);
    }
}

// Light from air is focused by an ellipsoid of conic -1 / n^2 at n r / (n - 1) within the glass; a
// sphere around that point lets it out undeviated.
TEST(Trace, EllipsoidFocusesExactly) {
    const double n = 1.7, r = 25, d = 15;
    const double focus = n * r / (n - 1);
    const Lens lens(lens_of({{.thickness_mm = 2, .semi_aperture_mm = 20, .stop = true},
                             {.radius_mm = r,
                              .thickness_mm = d,
                              .index = n,
                              .semi_aperture_mm = 20,
                              .conic = -1 / (n * n)},
                             {.radius_mm = focus - d, .semi_aperture_mm = 20}}));
    for (double height = 1; height < 20; height += 0.9) {
        const TracedRay ray = parallel(lens, height);
        ASSERT_EQ(ray.fate, Fate::kArrived);
        EXPECT_NEAR(axis_crossing(lens, ray), focus - d, 1e-11);
    }
}

// A paraboloid reflects parallel light into its focus: the far face of a ghost, the near one being
// plane, folds that to twice their distance minus the focal length. All of it in air; the last
// face only makes it a lens.
TEST(Trace, ParaboloidReflectsIntoItsFocus) {
    const double r = -100, distance = 20;
    const Lens lens(
        lens_of({{.thickness_mm = distance, .semi_aperture_mm = 45, .stop = true},
                 {.radius_mm = r, .thickness_mm = 30, .semi_aperture_mm = 45, .conic = -1},
                 {.radius_mm = 60, .thickness_mm = 2, .index = 1.5},
                 {.semi_aperture_mm = 45}}));
    const Tracer tracer(lens, kLineDNm);
    for (double height = 1; height < 20; height += 1) {
        std::vector<Vector> path;
        tracer.trace({1, 0}, ray_from_light(0, 0, 0.6 * height, 0.8 * height), &path);
        ASSERT_GE(path.size(), 5u);  // origin, plane, paraboloid, plane, paraboloid
        const Vector& a = path[3];
        const Vector& b = path[4];
        EXPECT_NEAR(a[2], 0, 1e-13);
        // The mirror's focus at distance + r / 2 = -30 is seen in the plane mirror at +30.
        const double t = (30 - a[2]) / (b[2] - a[2]);
        EXPECT_NEAR(a[0] + t * (b[0] - a[0]), 0, 1e-11);
        EXPECT_NEAR(a[1] + t * (b[1] - a[1]), 0, 1e-11);
    }
}

// The even asphere that a sphere is: a paraboloid with the rest of the sphere's series.
TEST(Trace, AsphereThatIsASphere) {
    const double r = 50, c = 1 / r;
    std::vector<double> series;  // of r^4, r^6, ...: c^(2 k - 1) (2 k - 3)!! / (2 k)!!
    double term = c / 2;
    for (int k = 2; k <= 8; ++k) {
        term *= c * c * (2 * k - 3) / (2 * k);
        series.push_back(term);
    }
    const auto lens = [&](bool asphere) {
        TestRow front{.radius_mm = r, .thickness_mm = 6, .index = 1.6};
        if (asphere) {
            front.conic = -1;
            front.asphere = series;
        }
        return Lens(lens_of({{.stop = true}, front, {.radius_mm = -80}}, 5));
    };
    const Lens sphere = lens(false);
    const Lens asphere = lens(true);
    const Tracer a(sphere, kLineDNm);
    const Tracer b(asphere, kLineDNm);
    for (double height = -6; height <= 6; height += 0.5) {
        const Ray ray = ray_from_light(0.05, 0.1, 1, height);
        for (const Bounces& way : {Bounces{}, Bounces{2, 1}}) {
            const TracedRay x = a.trace(way, ray);
            const TracedRay y = b.trace(way, ray);
            ASSERT_EQ(x.fate, Fate::kArrived);
            ASSERT_EQ(y.fate, Fate::kArrived);
            // The first term left out is r^18 c^17: 1e-16 mm at 6.5 mm.
            EXPECT_NEAR(x.x_mm, y.x_mm, 1e-11);
            EXPECT_NEAR(x.y_mm, y.y_mm, 1e-11);
        }
    }
}

TEST(Trace, CylinderDoesNothingAlongItself) {
    const auto lens = [](Profile profile) {
        return Lens(lens_of({{.thickness_mm = 3, .stop = true},
                             {.radius_mm = 30, .thickness_mm = 5, .index = 1.5, .profile = profile},
                             {.radius_mm = -45}},
                            8));
    };
    const Tracer cylinder_x(lens(Profile::kCylinderX), kLineDNm);
    const Tracer cylinder_y(lens(Profile::kRotational), kLineDNm);
    const Lens flat_lens(lens_of(
        {{.thickness_mm = 3, .stop = true}, {.thickness_mm = 5, .index = 1.5}, {.radius_mm = -45}},
        8));
    const Tracer flat(flat_lens, kLineDNm);
    for (double at = -6; at <= 6; at += 1.5) {
        std::vector<Vector> bent, plain;
        // In the y-z plane: as through a plane face.
        cylinder_x.trace({}, ray_from_light(0, 0.2, 0, at), &bent);
        flat.trace({}, ray_from_light(0, 0.2, 0, at), &plain);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(bent[k][1], plain[k][1], 1e-13);
            EXPECT_NEAR(bent[k][2], plain[k][2], 1e-13);
        }
        // In the x-z plane: as through the sphere.
        cylinder_x.trace({}, ray_from_light(0.2, 0, at, 0), &bent);
        cylinder_y.trace({}, ray_from_light(0.2, 0, at, 0), &plain);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(bent[k][0], plain[k][0], 1e-13);
            EXPECT_NEAR(bent[k][2], plain[k][2], 1e-13);
        }
    }
}

// A lens turned round: rays, direct or ghosts, go back where they came from, and as much energy is
// left of them.
Prescription turned_round(const Prescription& lens) {
    Prescription turned = lens;
    auto& rows = turned.surfaces;
    std::reverse(rows.begin(), rows.end());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t original = rows.size() - 1 - k;
        rows[k].radius_mm = -rows[k].radius_mm;
        for (double& a : rows[k].asphere) a = -a;
        // The medium behind, now, is the one that was in front.
        rows[k].index = original > 0 ? lens.surfaces[original - 1].index : 1;
        rows[k].thickness_mm = original > 0 ? lens.surfaces[original - 1].thickness_mm : 0;
    }
    return turned;
}

TEST(Trace, RaysGoBackTheWayTheyCame) {
    const Prescription table = lens_of(
        {{.radius_mm = 50, .thickness_mm = 6, .index = 1.7, .conic = 0.4, .asphere = {2e-6}},
         {.radius_mm = -70, .thickness_mm = 2, .index = 1.6},
         {.radius_mm = 90, .thickness_mm = 5},
         {.thickness_mm = 4, .stop = true},
         {.radius_mm = -60, .thickness_mm = 3, .index = 1.65},
         {.radius_mm = -35}});
    const Lens lens(table);
    const Lens turned(turned_round(table));
    const Tracer there(lens, 500);
    const Tracer back(turned, 500);
    const double length = lens.faces().back().z_mm;
    const int last = static_cast<int>(table.surfaces.size()) - 1;
    std::vector<Bounces> ways = enumerate_ghosts(lens, GhostSet::kAll);
    ways.push_back({});
    int arrived = 0;
    for (const Bounces& way : ways) {
        const Bounces mirrored = way.direct() ? way : Bounces{last - way.near, last - way.far};
        for (double x = -4; x <= 4; x += 1.1) {
            const Ray ray = ray_from_light(0.07, -0.03, x, 1.5);
            const TracedRay out = there.trace(way, ray);
            if (out.fate != Fate::kArrived) continue;
            ++arrived;
            // z turns round, x stays: a mirrored world, in which light runs backwards.
            const Ray reversed{{out.x_mm, out.y_mm, length - lens.sensor_z_mm()},
                               {-out.direction[0], -out.direction[1], out.direction[2]}};
            std::vector<Vector> path;
            const TracedRay home = back.trace(mirrored, reversed, &path);
            ASSERT_EQ(home.fate, Fate::kArrived);
            EXPECT_NEAR(home.direction[0], -ray.direction[0], 1e-11);
            EXPECT_NEAR(home.direction[1], -ray.direction[1], 1e-11);
            // Where it crosses z = 0 of the first lens.
            const double t = (length - turned.sensor_z_mm()) / home.direction[2];
            EXPECT_NEAR(home.x_mm + t * home.direction[0], x, 1e-9);
            EXPECT_NEAR(home.y_mm + t * home.direction[1], 1.5, 1e-9);
            EXPECT_NEAR(back.throughput(mirrored, reversed), there.throughput(way, ray), 1e-12);
        }
    }
    EXPECT_GT(arrived, 60);
}

TEST(Trace, CoordinatesOfTheHeader) {
    // Light from the upper right goes down and left, and the image stands on its head.
    const Ray ray = ray_from_light(0.01, 0.02, 3, 4);
    EXPECT_EQ(ray.origin, (Vector{3, 4, 0}));
    EXPECT_NEAR(ray.direction[0] / ray.direction[2], -0.01, 1e-15);
    EXPECT_NEAR(ray.direction[1] / ray.direction[2], -0.02, 1e-15);
    const Lens lens(shipped_lens("double-gauss"));
    const TracedRay image = Tracer(lens, kLineDNm).trace({}, ray_from_light(0.01, 0.02, 0, 0));
    EXPECT_NEAR(image.x_mm, -0.01 * lens.efl_mm(), 0.001 * lens.efl_mm() * 0.01);
    EXPECT_NEAR(image.y_mm, -0.02 * lens.efl_mm(), 0.001 * lens.efl_mm() * 0.02);
}

TEST(Trace, PathAndClips) {
    const Lens lens(shipped_lens("nikon-28-75"));
    const Tracer tracer(lens, 550);
    const Ray ray = ray_from_light(0.002, 0.005, 0.1, -0.2);
    int widest_in_between = 0;  // ghosts whose worst crossing of the stop is not the last
    for (const Bounces& ghost : enumerate_ghosts(lens, GhostSet::kAll)) {
        std::vector<Vector> path;
        const TracedRay traced = tracer.trace(ghost, ray, &path);
        if (traced.fate != Fate::kArrived) continue;
        const std::vector<Step> steps = steps_of(lens, ghost);
        ASSERT_EQ(path.size(), steps.size() + 2);
        double stop_clip = 0, housing_clip = 0, last_at_stop = 0;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Face& face = lens.faces()[static_cast<std::size_t>(steps[i].face)];
            const Vector& at = path[i + 1];
            const double r = std::hypot(at[0], at[1]);
            // On the sphere: c (r^2 + z^2) = 2 z.
            const double z = at[2] - face.z_mm;
            EXPECT_NEAR(face.curvature_per_mm * (r * r + z * z) - 2 * z, 0, 1e-12);
            const double clip = r / face.semi_aperture_mm;
            (face.stop ? stop_clip : housing_clip) =
                std::max(face.stop ? stop_clip : housing_clip, clip);
            if (face.stop) last_at_stop = clip;
        }
        EXPECT_NEAR(std::hypot(traced.stop_x_mm, traced.stop_y_mm) / lens.stop_radius_mm(),
                    last_at_stop, 1e-14);
        EXPECT_NEAR(traced.stop_clip, stop_clip, 1e-14);
        EXPECT_NEAR(traced.housing_clip, housing_clip, 1e-13);
        EXPECT_EQ(path.back(), (Vector{traced.x_mm, traced.y_mm, lens.sensor_z_mm()}));
        widest_in_between += stop_clip > 1.001 * last_at_stop;
    }
    EXPECT_GT(widest_in_between, 10);
    // An aperture in the way is told and does not end the ray.
    const TracedRay wide = tracer.trace({}, ray_from_light(0, 0, 0, 8));
    EXPECT_EQ(wide.fate, Fate::kArrived);
    EXPECT_GT(wide.stop_clip, 1);
    EXPECT_FALSE(wide.passes());
    EXPECT_TRUE(tracer.trace({}, ray_from_light(0, 0, 0, 3)).passes());
}

TEST(Trace, MissedAndTurned) {
    const Lens lens(lens_of({{.thickness_mm = 20, .stop = true},
                             {.radius_mm = 10, .thickness_mm = 4, .index = 1.5},
                             {.radius_mm = -30}},
                            20));
    const Tracer tracer(lens, 550);
    const TracedRay missed = tracer.trace({}, ray_from_light(0, 0, 0, 10.1));
    EXPECT_EQ(missed.fate, Fate::kMissed);
    EXPECT_EQ(missed.failed_face, 1);
    const TracedRay backwards = tracer.trace({}, {{0, 0, -1}, {0, 0.6, -0.8}});
    EXPECT_EQ(backwards.fate, Fate::kTurned);
    EXPECT_EQ(backwards.failed_face, 0);
    // Reflected far out on a ball, where its face stands steeper than 45 degrees, light goes on
    // towards the sensor instead of back.
    const TracedRay turned = tracer.trace({1, 0}, ray_from_light(0, 0, 0, 9));
    EXPECT_EQ(turned.fate, Fate::kTurned);
    EXPECT_EQ(turned.failed_face, 0);
}

// No lens and no ray, however wild, makes a number that is none.
TEST(Trace, NeverNaN) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int lenses = 0, arrived = 0, ended[4] = {};
    while (lenses < 300) {
        std::vector<TestRow> rows;
        const int count = static_cast<int>(between(2, 9));
        for (int k = 0; k < count; ++k) {
            TestRow row{.radius_mm = between(-60, 60), .thickness_mm = between(0, 12)};
            if (k + 1 < count && between(0, 1) < 0.6) row.index = between(1, 2.2);
            if (between(0, 1) < 0.2) row.radius_mm = 0;
            if (between(0, 1) < 0.3) row.conic = between(-4, 3);
            if (between(0, 1) < 0.3) row.asphere = {between(-1e-4, 1e-4), between(-1e-6, 1e-6)};
            if (between(0, 1) < 0.2) {
                row.profile = between(0, 1) < 0.5 ? Profile::kCylinderX : Profile::kCylinderY;
            }
            rows.push_back(row);
        }
        rows.push_back({.stop = true});
        std::swap(rows.back(), rows.front());
        rows.back().index = 1;
        try {
            const Lens lens(lens_of(rows, between(2, 16)));
            ++lenses;
            const Tracer tracer(lens, between(380, 770));
            std::vector<Bounces> ways = enumerate_ghosts(lens, GhostSet::kAll);
            ways.push_back({});
            for (const Bounces& way : ways) {
                for (int i = 0; i < 20; ++i) {
                    const Ray ray = ray_from_light(between(-5, 5), between(-1, 1), between(-60, 60),
                                                   between(-20, 20));
                    const TracedRay out = tracer.trace(way, ray);
                    const double share = tracer.throughput(way, ray);
                    ASSERT_TRUE(share >= 0 && share <= 1) << share;
                    for (const double v :
                         {out.x_mm, out.y_mm, out.stop_x_mm, out.stop_y_mm, out.housing_clip,
                          out.stop_clip, out.direction[0], out.direction[2]}) {
                        ASSERT_TRUE(std::isfinite(v));
                    }
                    ++ended[static_cast<int>(out.fate)];
                    if (out.fate != Fate::kArrived) continue;
                    ++arrived;
                    ASSERT_NEAR(std::hypot(out.direction[0], out.direction[1], out.direction[2]), 1,
                                1e-12);
                }
            }
        } catch (const std::exception&) {
            // Not a lens.
        }
    }
    for (const int count : ended) EXPECT_GT(count, 100);
    const Lens lens(shipped_lens("heliar"));
    const Tracer tracer(lens, 550);
    for (const double bad : {double(NAN), HUGE_VAL, -HUGE_VAL, 1e200}) {
        for (const Ray& ray : {Ray{{bad, 0, 0}, {0, 0, 1}}, Ray{{0, 0, 0}, {0, bad, 1}},
                               Ray{{0, 0, bad}, {0, 0, 1}}, ray_from_light(bad, 0, 0, 0)}) {
            EXPECT_NE(tracer.trace({}, ray).fate, Fate::kArrived);
            EXPECT_EQ(tracer.throughput({}, ray), 0);
        }
    }
}

TEST(Trace, IncidencesTellWhatARayMeets) {
    const Lens lens(shipped_lens("biotar"), {.f_number = 8});
    const Tracer tracer(lens, 550);
    const Bounces ghost = enumerate_ghosts(lens, GhostSet::kAll)[7];
    const Ray ray = ray_from_light(0.05, 0.03, 2, -1);
    std::vector<Incidence> met;
    const TracedRay result = tracer.trace(ghost, ray, met);
    ASSERT_EQ(result.fate, Fate::kArrived);
    EXPECT_EQ(result.x_mm, tracer.trace(ghost, ray).x_mm);
    const std::vector<Step> steps = steps_of(lens, ghost);
    ASSERT_EQ(met.size(), steps.size());
    const std::vector<double> index = lens.indices(550);
    for (std::size_t k = 0; k < met.size(); ++k) {
        EXPECT_EQ(met[k].step.face, steps[k].face);
        EXPECT_EQ(met[k].step.reflects, steps[k].reflects);
        const Vector next = k + 1 < met.size() ? met[k + 1].direction : result.direction;
        // The same sine on both sides, times the indices; and it flies on along its direction.
        const auto dot = [](const Vector& a, const Vector& b) {
            return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        };
        const double incidence = dot(met[k].direction, met[k].normal);
        EXPECT_NEAR(std::abs(incidence), met[k].cosine, 1e-12);
        const auto face = static_cast<std::size_t>(met[k].step.face);
        const bool back = met[k].step.backwards;
        const double before = index[back ? face + 1 : face];
        const double after = met[k].step.reflects ? before : index[back ? face : face + 1];
        EXPECT_NEAR(before * std::sqrt(1 - incidence * incidence),
                    after * std::sqrt(1 - std::pow(dot(next, met[k].normal), 2)), 1e-9);
        if (k + 1 == met.size()) continue;
        for (std::size_t c = 0; c < 2; ++c) {
            const double flown = (met[k + 1].point[2] - met[k].point[2]) / next[2];
            EXPECT_NEAR(met[k].point[c] + flown * next[c], met[k + 1].point[c], 1e-9);
        }
    }
}

}  // namespace
}  // namespace aureole::lens
