// A tree grown branch by branch, and a fence.
#include <cmath>

#include "scene/sun_landscape.h"

namespace aureole::scene::daylight {
namespace {

constexpr float kInversePi = 0.31830989F;

struct Tree {
    const Camera& camera;
    Random& random;
    std::vector<Stroke>& strokes;
    int leaves = 0;
};

float uniform(Random& random, double low, double high) {
    return static_cast<float>(random.uniform(low, high));
}

Vec3 random_direction(Random& random) {
    return normalize({static_cast<float>(random.normal()), static_cast<float>(random.normal()),
                      static_cast<float>(random.normal())});
}

// How far towards the sun a point of the crown lies, 0 deep inside or behind, 1 at the lit surface.
float towards_sun(Vec3 p) {
    const Vec3 d = p - kCrown.centre;
    const Vec3 unit = {d.x / kCrown.half_size.x, d.y / kCrown.half_size.y,
                       d.z / kCrown.half_size.z};
    return smoothstep(0.15F, 1.05F, dot(unit, normalize(sun_direction() + Vec3{-0.5F, 0.45F, 0})));
}

void add_leaves(Tree& tree, Vec3 tip, int count, float spread) {
    const Vec3 shade_light = sky_illuminance() * 0.42F;
    const Vec3 sun = sun_colour() * 1.05e5F;
    for (int i = 0; i < count; ++i) {
        const Vec3 at =
            tip + random_direction(tree.random) * (spread * std::sqrt(uniform(tree.random, 0, 1)));
        Vec3 along = random_direction(tree.random);
        along.y -= 0.5F;  // leaves hang
        along = normalize(along) * uniform(tree.random, 0.05, 0.10);
        const float tone = uniform(tree.random, 0.6, 1.3);
        const float lit = towards_sun(at) * (uniform(tree.random, 0, 1) < 0.55F ? 1.0F : 0.15F);
        const Vec3 reflected = Vec3{0.045F, 0.070F, 0.020F} * shade_light * (kInversePi * tone);
        const Vec3 transmitted =
            Vec3{0.060F, 0.085F, 0.010F} * sun * (0.55F * lit * kInversePi * tone);
        const float radius = uniform(tree.random, 0.028, 0.05);
        project_stroke(tree.camera, at, at + along, radius, 0.55F * radius, reflected + transmitted,
                       0.25F, tree.strokes);
        ++tree.leaves;
    }
}

void grow(Tree& tree, Vec3 from, Vec3 direction, float length_m, float radius, int level) {
    constexpr int kLevels = 6;
    // A branch bends as it grows: towards the light, and off its straight line.
    constexpr int kPieces = 4;
    const Vec3 bark = Vec3{0.075F, 0.060F, 0.045F} * sky_illuminance() * (0.40F * kInversePi);
    Vec3 at = from;
    Vec3 heading = direction;
    float r = radius;
    const float taper = level == 0 ? 0.90F : 0.86F;
    for (int piece = 0; piece < kPieces; ++piece) {
        heading = normalize(heading + random_direction(tree.random) * 0.16F +
                            Vec3{0, level == 0 ? 0.05F : 0.06F, 0});
        const Vec3 next = at + heading * (length_m / kPieces);
        project_stroke(tree.camera, at, next, r, r * taper, bark, level < 3 ? -0.45F : 0,
                       tree.strokes);
        at = next;
        r *= taper;
        if (level >= 3) add_leaves(tree, at, 5, 0.45F);
        if (level >= 1 && level < kLevels - 1 && piece == 1) {
            const Vec3 side = normalize(heading + random_direction(tree.random) * 0.95F);
            grow(tree, at, side, length_m * 0.62F, r * 0.55F, level + 1);
        }
    }
    if (level >= kLevels - 1) {
        add_leaves(tree, at, 16, 0.50F);
        return;
    }
    const int children = level == 0 ? 5 : (level == 1 ? 3 : 2);
    const double turn = tree.random.uniform(0, 6.28318);
    for (int i = 0; i < children; ++i) {
        const double angle = turn + 6.28318 * i / children;
        const float open =
            level == 0 ? uniform(tree.random, 0.55, 0.95) : uniform(tree.random, 0.45, 0.8);
        const Vec3 side = normalize(
            Vec3{static_cast<float>(std::cos(angle)), 0.1F, static_cast<float>(std::sin(angle))});
        const Vec3 out = normalize(heading * (1 - 0.45F * open) + side * open +
                                   random_direction(tree.random) * 0.18F);
        grow(tree, at, out, length_m * uniform(tree.random, 0.66, 0.80),
             r * (level == 0 ? 0.62F : 0.70F), level + 1);
    }
}

}  // namespace

void add_tree(const Camera& camera, Random& random, std::vector<Stroke>& strokes) {
    Tree tree{camera, random, strokes};
    // Roots spread at the foot.
    const Vec3 bark = Vec3{0.075F, 0.060F, 0.045F} * sky_illuminance() * (0.40F * kInversePi);
    for (int i = 0; i < 6; ++i) {
        const float angle = 1.05F * static_cast<float>(i) + 0.4F;
        project_stroke(camera, kTreeFoot + Vec3{0, 0.45F, 0},
                       kTreeFoot + Vec3{0.62F * std::cos(angle), -0.02F, 0.62F * std::sin(angle)},
                       0.20F, 0.05F, bark, -0.3F, strokes);
    }
    grow(tree, kTreeFoot, {0.02F, 1, 0}, 2.5F, kTrunkRadius, 0);
}

void add_fence(const Camera& camera, Random& random, std::vector<Stroke>& strokes) {
    const Vec3 wood = Vec3{0.11F, 0.095F, 0.075F} * sky_illuminance() * (0.5F * kInversePi);
    Vec3 last_low;
    Vec3 last_high;
    for (int i = 0; i < 26; ++i) {
        const float z = 5.5F + 2.6F * static_cast<float>(i);
        const Vec3 foot = {
            -4.6F - 0.02F * z + 0.9F * std::sin(z * 0.05F) + uniform(random, -0.06, 0.06), 0, z};
        const Vec3 lean = {uniform(random, -0.05, 0.05), uniform(random, 1.05, 1.2), 0};
        project_stroke(camera, foot, foot + lean, 0.065F, 0.058F, wood, 0.3F, strokes);
        const Vec3 low = foot + Vec3{0, 0.48F + uniform(random, -0.03, 0.03), -0.05F};
        const Vec3 high = foot + Vec3{0, 0.95F + uniform(random, -0.03, 0.03), -0.05F};
        if (i > 0) {
            project_stroke(camera, last_low, low, 0.038F, 0.038F, wood, 0, strokes);
            project_stroke(camera, last_high, high, 0.038F, 0.038F, wood, 0, strokes);
        }
        last_low = low;
        last_high = high;
    }
}

}  // namespace aureole::scene::daylight
