#include "aureole/ibl/dominant_direction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"

// As much GLSL as the shader needs, in double precision.
namespace glsl {

struct vec3 {
    double x, y, z;
};
double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
vec3 mix(vec3 a, vec3 b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}
using std::clamp;
using std::max;
using std::sqrt;

#define float double
#include "../../shaders/ibl/dominant_direction.glsl"
#undef float

}  // namespace glsl

namespace aureole::ibl {
namespace {

Direction random_direction(Random& random) {
    return normalized({random.normal(), random.normal(), random.normal()});
}

Direction reflected(const Direction& view, const Direction& normal) {
    const double twice = 2 * dot(normal, view);
    return {twice * normal.x - view.x, twice * normal.y - view.y, twice * normal.z - view.z};
}

// The direction of the mean light vector that a GGX surface reflects towards the view, by 512 x 512
// half vectors drawn from D (N.h).
Direction mean_reflection(double n_dot_v, double alpha) {
    constexpr int kPoints = 512;
    const Direction v = {std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
    const auto masked = [&](double cosine) {
        return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
    };
    Direction sum;
    for (int j = 0; j < kPoints; ++j) {
        const double share = (j + .5) / kPoints;
        const double z = std::sqrt((1 - share) / (1 + (alpha * alpha - 1) * share));
        const double r = std::sqrt(1 - z * z);
        for (int i = 0; i < kPoints; ++i) {
            const double phi = 2 * kPi * (i + .5) / kPoints;
            const Direction h = {r * std::cos(phi), r * std::sin(phi), z};
            const Direction l = reflected(v, h);
            if (l.z <= 0) continue;
            const double weight = dot(v, h) / h.z * l.z / (v.z * masked(l.z) + l.z * masked(v.z));
            sum = {sum.x + weight * l.x, sum.y + weight * l.y, sum.z + weight * l.z};
        }
    }
    return normalized(sum);
}

void expect_same(const Direction& a, const glsl::vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-14);
    EXPECT_NEAR(a.y, b.y, 1e-14);
    EXPECT_NEAR(a.z, b.z, 1e-14);
}

TEST(DominantDirection, ShaderIsTheSame) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Direction n = random_direction(random);
        const Direction v = random_direction(random);
        const Direction r = reflected(v, n);
        const double alpha = i < 2 ? i : random.uniform();
        const auto as_vec3 = [](const Direction& d) { return glsl::vec3{d.x, d.y, d.z}; };
        expect_same(specular_dominant_direction(n, r, alpha),
                    glsl::aureole_specular_dominant_direction(as_vec3(n), as_vec3(r), alpha));
        expect_same(diffuse_dominant_direction(n, v, alpha),
                    glsl::aureole_diffuse_dominant_direction(as_vec3(n), as_vec3(v), alpha));
    }
}

TEST(DominantDirection, GoesFromTheMirrorDirectionToTheNormal) {
    const Direction n = {0, 0, 1};
    const Direction v = normalized({1, 0, .5});
    const Direction r = reflected(v, n);
    double before = -1;
    for (int i = 0; i <= 20; ++i) {
        const double up = dot(n, normalized(specular_dominant_direction(n, r, i / 20.0)));
        EXPECT_GE(up, before);
        before = up;
    }
    EXPECT_EQ(specular_dominant_direction(n, r, 0).x, r.x);
    EXPECT_EQ(specular_dominant_direction(n, r, 1).x, n.x);
    EXPECT_EQ(diffuse_dominant_direction(n, v, 0).x, n.x);
    EXPECT_GT(diffuse_dominant_direction(n, v, .8).x, 0);
}

// It is a fit: closer to where the light comes from than the mirror direction is.
TEST(DominantDirection, IsCloserToTheMeanOfTheLightThanTheMirrorDirection) {
    const Direction n = {0, 0, 1};
    for (const double n_dot_v : {.2, .5, .8}) {
        for (const double alpha : {.2, .4, .7}) {
            const Direction v = {std::sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
            const Direction r = reflected(v, n);
            const Direction mean = mean_reflection(n_dot_v, alpha);
            const Direction dominant = normalized(specular_dominant_direction(n, r, alpha));
            EXPECT_GT(dot(dominant, mean), dot(r, mean)) << n_dot_v << " " << alpha;
        }
    }
}

}  // namespace
}  // namespace aureole::ibl
