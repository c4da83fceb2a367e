// How much of a ray is left when it arrives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/lens/library.h"
#include "aureole/lens/trace.h"
#include "lens/test_lenses.h"

namespace aureole::lens {
namespace {

// Everything known about one ray from its path alone: 3 x 3 Jones matrices of real amplitudes.
double throughput_by_matrices(const Lens& lens, const Bounces& way, const Ray& ray,
                              double wavelength_nm) {
    using Matrix3 = std::array<Vector, 3>;
    std::vector<Vector> path;
    if (Tracer(lens, wavelength_nm).trace(way, ray, &path).fate != Fate::kArrived) return 0;
    const auto dot = [](const Vector& a, const Vector& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
    };
    const auto unit = [&](Vector v) {
        const double length = std::sqrt(dot(v, v));
        for (double& x : v) x /= length;
        return v;
    };
    const std::vector<double> index = lens.indices(wavelength_nm);
    const std::vector<Step> steps = steps_of(lens, way);
    const auto towards = [&](std::size_t i) {
        // Where neighbouring faces meet far from the axis, the next point may lie behind.
        const bool backwards = i < steps.size() && steps[i].backwards;
        const double sign = (path[i + 1][2] < path[i][2]) == backwards ? 1 : -1;
        return unit({sign * (path[i + 1][0] - path[i][0]), sign * (path[i + 1][1] - path[i][1]),
                     sign * (path[i + 1][2] - path[i][2])});
    };
    Matrix3 field{};  // columns: what became of x, y, z of the field
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            field[a][b] = (a == b ? 1 : 0) - ray.direction[a] * ray.direction[b];
        }
    }
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const auto k = static_cast<std::size_t>(steps[i].face);
        const Face& face = lens.faces()[k];
        const double before = index[steps[i].backwards ? k + 1 : k];
        const double after = index[steps[i].backwards ? k : k + 1];
        const Vector in = i == 0 ? ray.direction : towards(i);
        const Vector out = towards(i + 1);
        const Vector& at = path[i + 1];
        const double c = face.curvature_per_mm;
        const Vector normal = {-c * at[0], -c * at[1], 1 - c * (at[2] - face.z_mm)};
        Coating layers = face.coating;
        if (steps[i].backwards) std::reverse(layers.begin(), layers.end());
        const Reflectance r =
            reflectance(before, after, layers, wavelength_nm, std::abs(dot(in, normal)));
        const Vector s = unit(cross(in, normal));
        const Vector p_in = cross(in, s);
        Vector p_out = cross(out, s);
        double ts = std::sqrt(1 - r.s), tp = std::sqrt(1 - r.p);
        if (steps[i].reflects) {
            ts = -std::sqrt(r.s);  // a mirror turns the field round: -E along s,
            tp = std::sqrt(r.p);   // and along p in the frame of the new direction +E
        }
        Matrix3 next{};
        for (std::size_t b = 0; b < 3; ++b) {
            double along_s = 0, along_p = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                along_s += s[a] * field[a][b];
                along_p += p_in[a] * field[a][b];
            }
            for (std::size_t a = 0; a < 3; ++a) {
                next[a][b] = ts * along_s * s[a] + tp * along_p * p_out[a];
            }
        }
        field = next;
    }
    double energy = 0;
    for (const Vector& row : field) energy += dot(row, row);
    return energy / 2;
}

TEST(Throughput, EqualsJonesMatricesAlongSkewRays) {
    for (const char* coating : {"none", "mgf2", "broadband"}) {
        const Lens lens(shipped_lens("biotar"), {.f_number = 2, .coating = coating});
        const Tracer tracer(lens, 480);
        std::vector<Bounces> ways = enumerate_ghosts(lens, GhostSet::kAll);
        ways.push_back({});
        int compared = 0;
        for (const Bounces& way : ways) {
            const Ray ray = ray_from_light(0.15, 0.1, 9, -14);
            const double got = tracer.throughput(way, ray);
            EXPECT_NEAR(got, throughput_by_matrices(lens, way, ray, 480), 1e-12);
            compared += got > 0;
        }
        EXPECT_GT(compared, 15);
    }
}

// On the axis there is no angle: the product of the reference's formula,
// R_i R_j T_i T_j, T_k once outside the two and three times between them.
TEST(Throughput, OnTheAxisIsTheProductOfTheReference) {
    const Lens lens(shipped_lens("heliar"));
    const std::vector<double> index = lens.indices(520);
    std::vector<double> r;
    for (std::size_t k = 0; k < lens.faces().size(); ++k) {
        r.push_back(reflectance(index[k], index[k + 1], lens.faces()[k].coating, 520, 1).mean());
    }
    const Tracer tracer(lens, 520);
    for (const Bounces& way : enumerate_ghosts(lens, GhostSet::kAll)) {
        double expected = 1;
        for (int k = 0; k < static_cast<int>(r.size()); ++k) {
            const double reflected = r[static_cast<std::size_t>(k)];
            const double passed = 1 - reflected;
            if (k == way.near || k == way.far) {
                expected *= reflected * passed;
            } else {
                expected *= k > way.near && k < way.far ? passed * passed * passed : passed;
            }
        }
        EXPECT_NEAR(tracer.throughput(way, {}), expected, 1e-14 * expected);
    }
}

// Turning ray and lens together changes nothing; in the plane of the axis s and p never mix.
TEST(Throughput, IsTheSameAllRoundTheAxis) {
    const Lens lens(shipped_lens("double-gauss"), {.coating = "none"});
    const Tracer tracer(lens, 600);
    for (const Bounces& way : {Bounces{}, Bounces{3, 1}, Bounces{9, 2}}) {
        const double reference = tracer.throughput(way, ray_from_light(0, 0.12, 2, 3));
        ASSERT_GT(reference, 0);
        for (double turn = 0.3; turn < 6.3; turn += 0.7) {
            const double c = std::cos(turn), s = std::sin(turn);
            const Ray ray = ray_from_light(-0.12 * s, 0.12 * c, 2 * c - 3 * s, 2 * s + 3 * c);
            EXPECT_NEAR(tracer.throughput(way, ray), reference, 1e-12 * reference);
        }
    }
}

// A plate lets through what a plate lets through: (1 - R)^2 in s and in p, at any angle.
TEST(Throughput, OfAPlate) {
    const Lens lens(lens_of({{.thickness_mm = 5, .stop = true},
                             {.thickness_mm = 5, .index = 1.5, .coating = "none"},
                             {.thickness_mm = 20, .coating = "none"},
                             {.radius_mm = 1e9, .thickness_mm = 1, .index = 1.5},
                             {.radius_mm = -1e9}}));
    const Tracer tracer(lens, 550);
    for (double angle = 0; angle < 1.5; angle += 0.1) {
        const Reflectance r = reflectance(1, 1.5, {}, 550, std::cos(angle));
        const Reflectance coated =
            reflectance(1, 1.5, lens.faces()[3].coating, 550, std::cos(angle));
        const double s = std::pow(1 - r.s, 2) * std::pow(1 - coated.s, 2);
        const double p = std::pow(1 - r.p, 2) * std::pow(1 - coated.p, 2);
        const Ray ray = ray_from_light(0, std::tan(angle), 0, 0);
        EXPECT_NEAR(tracer.throughput({}, ray), 0.5 * (s + p), 1e-6);
        // Reflected twice inside it.
        const double ghost = 0.5 * (s * r.s * r.s + p * r.p * r.p);
        EXPECT_NEAR(tracer.throughput({2, 1}, ray), ghost, 1e-6);
    }
}

}  // namespace
}  // namespace aureole::lens
