// What is seen through windows: lamp-lit rooms, curtains, blinds, shops. Rooms have no geometry;
// the ray is continued to a back wall at some depth (van Dongen 2008, "Interior Mapping").
#include <cmath>

#include "scene/builders.h"
#include "scene/night_street.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

struct Lamp {
    Vec3 warm = black_body_rgb(2500);
    Vec3 white = black_body_rgb(3000);
    Vec3 cool = black_body_rgb(4200);
    Vec3 screen = black_body_rgb(9500);
};

const Lamp& lamps() {
    static const Lamp lamp;
    return lamp;
}

// Light in a box-shaped room with one lamp, where the ray of view meets it. The opening is
// [0, width] x [0, height] at depth 0; margins are how far the room reaches beyond it.
float room_brightness(float u, float v, float width, float height, Vec3 direction, float depth,
                      float& hit_u, float& hit_v, bool& ceiling) {
    const float inward = std::max(-direction.z, 1e-3F);
    const float low_u = -0.9F;
    const float high_u = width + 0.9F;
    const float low_v = -0.85F;
    const float high_v = height + 0.35F;
    float t = depth / inward;
    bool side = false;
    ceiling = false;
    const float to_u = direction.x > 0 ? (high_u - u) / std::max(direction.x, 1e-6F)
                                       : (low_u - u) / std::min(direction.x, -1e-6F);
    const float to_v = direction.y > 0 ? (high_v - v) / std::max(direction.y, 1e-6F)
                                       : (low_v - v) / std::min(direction.y, -1e-6F);
    float facing = 1;
    if (to_u < t) {
        t = to_u;
        side = true;
        facing = 0.8F;
    }
    if (to_v < t) {
        t = to_v;
        side = false;
        ceiling = direction.y > 0;
        facing = ceiling ? 1.15F : 0.45F;
    }
    hit_u = u + direction.x * t;
    hit_v = v + direction.y * t;
    const Vec3 at = {hit_u, hit_v, -inward * t};
    const Vec3 lamp = {0.5F * width, high_v - 0.45F, -0.55F * depth};
    const Vec3 d = lamp - at;
    // Side walls continue the coordinate of the back wall towards the window.
    if (side) hit_u += (direction.x > 0 ? 1.0F : -1.0F) * (depth - inward * t);
    return facing * 1.9F / (0.8F + dot(d, d));
}

}  // namespace

Vec3 window_light(const Building& building, int column, int row, float u, float v, float width,
                  float height, Vec3 direction, float footprint) {
    const int seed = building.seed * 131 + row * 17;
    const auto random = [&](int what) { return hash_uniform(column, seed, what); };
    // Glass mirrors a little of the street and more of the sky, the more the flatter one looks.
    const float grazing = 1 - std::min(-direction.z, 1.0F);
    const float fresnel = 0.06F + 0.9F * square(square(grazing)) * grazing;
    const Vec3 across =
        Vec3{1.15F, 0.92F, 0.72F} * (0.35F + 0.25F * random(11) - 0.2F * v / height);
    const Vec3 dark =
        mix(across, Vec3{0.16F, 0.17F, 0.26F}, smoothstep(0.1F, 0.45F, direction.y)) * fresnel +
        Vec3{0.015F, 0.014F, 0.014F};
    if (random(1) > building.lit_share) return dark;

    const float level = 2 * std::pow(9.0F, random(2));  // cd/m2
    const float kind = random(3);
    const Lamp& lamp = lamps();
    const Vec3 colour =
        random(4) < 0.55F ? lamp.warm : (random(4) < 0.85F ? lamp.white : lamp.cool);
    if (kind < 0.34F) {  // a drawn curtain, lit from within
        const float folds = survives(0.16F, footprint) *
                            (0.16F * std::sin(u * 39 + 2.5F * value_noise(u * 3, v * 0.4F, seed)) +
                             0.08F * std::sin(u * 91));
        const float lit =
            0.45F + 0.55F * std::exp(-square((v - 0.62F * height) / (0.6F * height)) -
                                     square((u - (0.2F + 0.6F * random(5)) * width) / width));
        const Vec3 cloth = random(6) < 0.3F
                               ? Vec3{1.15F, 0.85F, 0.62F}
                               : (random(6) < 0.5F ? Vec3{1.0F, 0.95F, 0.8F} : Vec3{1, 1, 1});
        return colour * cloth * (0.55F * level * lit * (1 + folds));
    }
    if (kind < 0.44F) {  // blinds
        const float slats = stripe_coverage(v, 0.06F, 0.038F, footprint);
        const float fall = 0.55F + 0.45F * v / height;
        return colour * (0.8F * level * fall * (0.22F + 0.78F * (1 - slats)));
    }
    if (kind < 0.52F) {  // a television in the dark
        const float glow = std::exp(-square((u - 0.5F * width) / (0.8F * width)) -
                                    square((v - 0.2F * height) / (0.8F * height)));
        return lamp.screen * (2.2F * glow);
    }
    float hit_u = 0;
    float hit_v = 0;
    bool ceiling = false;
    const float brightness = room_brightness(u, v, width, height, direction,
                                             2.6F + 1.6F * random(7), hit_u, hit_v, ceiling);
    Vec3 light = colour * (level * brightness);
    if (!ceiling) {
        // A picture and a cupboard on the wall.
        const float picture_u = width * random(8);
        if (std::abs(hit_u - picture_u) < 0.32F && std::abs(hit_v - 0.75F * height) < 0.22F) {
            light *= 0.45F;
        }
        if (std::abs(hit_u - width * random(9)) < 0.5F && hit_v < 0.35F * height) light *= 0.4F;
    }
    // Curtains gathered at both sides.
    const float gathered = width * (0.10F + 0.16F * random(10));
    const float cloth = std::max(interval_coverage(u, -1, gathered, footprint),
                                 interval_coverage(u, width - gathered, width + 1, footprint));
    const float folds = 0.5F + 0.2F * survives(0.08F, footprint) * std::sin(u * 78);
    return mix(light, colour * (0.55F * level * folds), cloth);
}

Vec3 shop_light(const Building& building, int column, float u, float v, float width, float height,
                Vec3 direction, float footprint) {
    const int seed = building.seed * 57;
    const auto random = [&](int what) { return hash_uniform(0, seed, what); };
    const Lamp& lamp = lamps();
    const Vec3 colour = random(1) < 0.6F ? lamp.white : lamp.cool;
    const float level = 5 * std::pow(3.0F, random(2));
    float hit_u = 0;
    float hit_v = 0;
    bool ceiling = false;
    const float depth = 4.5F;
    const float brightness =
        room_brightness(u, v, width, height, direction, depth, hit_u, hit_v, ceiling);
    Vec3 light = colour * (level * (0.25F + 0.85F * brightness));
    if (ceiling) {
        // Rows of luminous panels.
        const float panel = stripe_coverage(hit_u, 1.25F, 0.42F, 2 * footprint);
        return light * 0.5F + colour * (5 * level * panel);
    }
    // Shelves of goods along the back wall.
    const float shelf = hit_v / 0.42F;
    const int shelf_row = floor_int(shelf);
    const float cell = hit_u / (0.10F + 0.09F * hash_uniform(shelf_row, seed, 5));
    const int item = floor_int(cell) + 31 * column;
    const float tall = 0.45F + 0.5F * hash_uniform(item, shelf_row, seed);
    const float fraction = shelf - static_cast<float>(shelf_row);
    const float keep = survives(0.14F, footprint);
    Vec3 goods = {0.25F + 0.75F * hash_uniform(item, shelf_row, seed + 1),
                  0.25F + 0.65F * hash_uniform(item, shelf_row, seed + 2),
                  0.20F + 0.6F * hash_uniform(item, shelf_row, seed + 3)};
    if (fraction > tall) goods = {0.30F, 0.26F, 0.22F};
    if (fraction > 0.93F) goods = {0.8F, 0.78F, 0.72F};
    light = light * mix(Vec3{0.52F, 0.45F, 0.38F}, goods, keep);
    // A display plinth in the window.
    if (v < 0.30F) light *= 0.35F + 0.5F * smoothstep(0.30F, 0.26F, v);
    return light;
}

}  // namespace aureole::scene::night
