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
    return smoothstep(-0.7F, 1.1F, dot(unit, normalize(sun_direction() + Vec3{-0.5F, 0.45F, 0})));
}

void add_leaves(Tree& tree, Vec3 tip, int count, float spread) {
    // From the sky and, as much again, from the meadow below.
    const Vec3 shade_light = sky_illuminance() * 0.85F;
    const Vec3 sun = sun_colour() * 1.05e5F;
    for (int i = 0; i < count; ++i) {
        const Vec3 at =
            tip + random_direction(tree.random) * (spread * std::sqrt(uniform(tree.random, 0, 1)));
        Vec3 along = random_direction(tree.random);
        along.y -= 0.5F;  // leaves hang
        along = normalize(along) * uniform(tree.random, 0.05, 0.10);
        const float tone = uniform(tree.random, 0.6, 1.3);
        const float lit =
            square(towards_sun(at)) * (uniform(tree.random, 0, 1) < 0.5F ? 1.0F : 0.12F);
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
    const Vec3 bark = Vec3{0.075F, 0.060F, 0.045F} * sky_illuminance() * (0.7F * kInversePi);
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
        if (level >= 3) add_leaves(tree, at, 4, 0.42F);
        if (level >= 1 && level < kLevels - 1 && piece == 1) {
            const Vec3 side = normalize(heading + random_direction(tree.random) * 0.95F);
            grow(tree, at, side, length_m * 0.62F, r * 0.55F, level + 1);
        }
    }
    if (level >= kLevels - 1) {
        add_leaves(tree, at, 13, 0.42F);
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
    // The foot widens towards the roots.
    const Vec3 bark = Vec3{0.075F, 0.060F, 0.045F} * sky_illuminance() * (0.7F * kInversePi);
    const float widths[] = {0.58F, 0.44F, 0.36F, 0.32F, kTrunkRadius};
    const float heights[] = {-0.02F, 0.13F, 0.32F, 0.62F, 1.0F};
    for (int i = 0; i < 4; ++i) {
        // A little overlap hides the seams.
        project_stroke(camera, kTreeFoot + Vec3{0, heights[i], 0},
                       kTreeFoot + Vec3{0, heights[i + 1] + 0.05F, 0}, widths[i], widths[i + 1],
                       bark, -0.45F, strokes, true);
    }
    grow(tree, kTreeFoot + Vec3{0, 0.95F, 0}, {0.02F, 1, 0}, 1.9F, kTrunkRadius, 0);
}

float fence_x(float z) { return -4.4F - 0.02F * z + 0.9F * std::sin(z * 0.05F); }

void add_fence(const Camera& camera, Random& random, std::vector<Stroke>& strokes) {
    const Vec3 wood = Vec3{0.13F, 0.115F, 0.09F} * sky_illuminance() * (0.7F * kInversePi);
    Vec3 last;
    for (int i = 0; i < 40; ++i) {
        const float z = kFirstPostZ + kPostSpacing * static_cast<float>(i);
        const Vec3 foot = {fence_x(z), -0.02F, z};
        const Vec3 lean = {uniform(random, -0.04, 0.04), uniform(random, 1.06, 1.16), 0};
        project_stroke(camera, foot, foot + lean, 0.065F, 0.06F, wood, 0.45F, strokes, true);
        const Vec3 dip = {0, uniform(random, -0.025, 0.025), -0.06F};
        for (const float rail : kRailHeights) {
            if (i == 0) continue;
            project_stroke(camera, last + Vec3{0, rail, 0}, foot + dip + Vec3{0, rail, 0}, 0.038F,
                           0.038F, wood * 0.9F, 0.2F, strokes, true);
        }
        last = foot + dip;
    }
}

// Single blades where a pixel shows them, and tufts about the feet of posts and tree.
void add_grass(const Camera& camera, Random& random, std::vector<Stroke>& strokes) {
    const Vec3 sun = sun_colour() * 1.05e5F;
    const auto blade = [&](Vec3 root, double tallest) {
        const float height = uniform(random, 0.35 * tallest, tallest);
        const Vec3 tip = root + Vec3{uniform(random, -0.4, 0.4) * height, height,
                                     uniform(random, -0.3, 0.3) * height};
        const float dry = uniform(random, 0, 1);
        const Vec3 albedo = mix(Vec3{0.060F, 0.095F, 0.014F}, Vec3{0.15F, 0.13F, 0.05F}, dry * dry);
        const float lit = sunlight(root, 0.02F) * uniform(random, 0.15, 0.75);
        const Vec3 radiance =
            albedo * (sun * (0.42F * lit) + sky_illuminance() * 0.8F) * kInversePi;
        const float width = uniform(random, 0.0022, 0.0045);
        project_stroke(camera, root, tip, width, 0.3F * width, radiance, 0.2F, strokes);
    };
    for (int i = 0; i < 26000; ++i) {
        // Even over the picture: depth falls as the inverse of a uniform variable.
        const float z = 1 / uniform(random, 1 / 26.0, 1 / 3.3);
        const float x = uniform(random, -0.75, 0.75) * z;
        const float from_track = std::abs(std::abs(x - track_x(z)) - 0.75F);
        if (from_track < 0.33F) continue;
        blade({x, 0, z}, 0.20);
    }
    for (int i = 0; i < 40; ++i) {
        const float z = kFirstPostZ + kPostSpacing * static_cast<float>(i);
        for (int n = 0; n < 40; ++n) {
            blade({fence_x(z) + uniform(random, -0.25, 0.25), 0, z + uniform(random, -0.15, 0.15)},
                  0.34);
        }
    }
    for (int n = 0; n < 900; ++n) {
        const float angle = uniform(random, 0, 6.28318);
        const float r = uniform(random, 0.3, 0.95);
        blade(kTreeFoot + Vec3{r * std::cos(angle), 0, r * std::sin(angle)}, 0.36);
    }
}

}  // namespace aureole::scene::daylight
