// Where everything in the night street stands.
#include <array>
#include <cmath>

#include "aureole/base/random.h"
#include "scene/builders.h"
#include "scene/night_street.h"

namespace aureole::scene::night {
namespace {

constexpr float kFacadeX = 8.6F;

float uniform(Random& random, double low, double high) {
    return static_cast<float>(random.uniform(low, high));
}

int index_below(Random& random, int count) { return static_cast<int>(random.uniform() * count); }

Building make_building(Random& random, int seed) {
    constexpr std::array<Vec3, 7> kWalls = {{{0.30F, 0.13F, 0.085F},   // red brick
                                             {0.34F, 0.24F, 0.14F},    // yellow brick
                                             {0.46F, 0.40F, 0.29F},    // cream stucco
                                             {0.33F, 0.33F, 0.32F},    // grey stucco
                                             {0.42F, 0.36F, 0.28F},    // sandstone
                                             {0.36F, 0.22F, 0.16F},    // terracotta stucco
                                             {0.24F, 0.27F, 0.30F}}};  // blue-grey stucco
    constexpr std::array<Wall, 7> kKinds = {Wall::kBrick,  Wall::kBrick, Wall::kStucco,
                                            Wall::kStucco, Wall::kStone, Wall::kStucco,
                                            Wall::kStucco};
    Building b{};
    const auto look = static_cast<std::size_t>(index_below(random, 7));
    b.albedo = kWalls[look] * uniform(random, 0.8, 1.15);
    b.wall = kKinds[look];
    b.trim = mix(b.albedo, Vec3{0.58F, 0.55F, 0.49F}, uniform(random, 0.55, 1));
    b.width = uniform(random, 8.5, 14.5);
    b.depth = 9;
    b.shop = random.uniform() < 0.4;
    b.ground_floor = b.shop ? 3.7F : uniform(random, 3.2, 3.7);
    b.storeys = 2 + index_below(random, 3);
    b.storey = uniform(random, 2.9, 3.3);
    b.height = b.ground_floor + b.storey * static_cast<float>(b.storeys) + 0.55F;
    b.roof_height = uniform(random, 1.4, 2.8);
    const float columns = std::round((b.width - 0.9F) / uniform(random, 2.1, 2.8));
    b.bay = (b.width - 0.9F) / columns;
    b.window_width = uniform(random, 0.95, 1.3);
    b.window_height = uniform(random, 1.55, 1.95);
    b.sill = uniform(random, 0.7, 0.95);
    b.lit_share = uniform(random, 0.18, 0.45);
    b.seed = seed;
    return b;
}

void add_side(Random& random, float side, Street& street) {
    float z = -14;
    for (int i = 0; z < kStreetEndZ - 8; ++i) {
        Building b = make_building(random, 100 * (side > 0 ? 2 : 1) + i);
        b.origin = {side * (kFacadeX + uniform(random, 0, 0.5)), 0, z};
        b.along = {0, 0, 1};
        b.normal = {-side, 0, 0};
        for (int c = 0; c < 2; ++c) {
            const float at = z + b.width * (c == 0 ? 0.14F : uniform(random, 0.6, 0.9));
            const float back = b.origin.x + side * uniform(random, 2, 3.2);
            street.chimneys.push_back(
                {{std::min(back, back + side * 0.6F), b.height, at},
                 {std::max(back, back + side * 0.6F),
                  b.height + b.roof_height + uniform(random, 0.6, 1.5), at + 1.1F}});
        }
        if (b.shop) {  // what its windows throw on the pavement
            const float reach = b.width - 1;
            street.lights.push_back({b.origin + Vec3{-side * 0.4F, 1.8F, 0.5F * b.width},
                                     black_body_rgb(3300) * (9.0F * reach), b.normal, Lobe::kCosine,
                                     1.3F, false});
        }
        z += b.width + (random.uniform() < 0.15 ? uniform(random, 1.5, 3) : 0);
        street.buildings.push_back(b);
    }
}

void add_lamp(float x_post, float x_head, float z, Street& street) {
    constexpr float kHeight = 6.7F;
    constexpr Vec3 kBowl = {0.17F, 0.08F, 0.17F};
    static const Vec3 colour = black_body_rgb(3000);
    const float side = x_post > 0 ? 1.0F : -1.0F;
    Post post;
    post.bars.push_back({{x_post, 0, z}, {x_post, 1.1F, z}, 0.105F});
    post.bars.push_back({{x_post, 1.1F, z}, {x_post, kHeight - 0.15F, z}, 0.06F});
    // The arm: a quarter arc in four pieces.
    Vec3 last = {x_post, kHeight - 0.15F, z};
    for (int i = 1; i <= 4; ++i) {
        const float angle = 1.5707963F * static_cast<float>(i) / 4;
        const Vec3 next = {
            x_post - side * (std::abs(x_post - x_head) - 0.25F) * (1 - std::cos(angle)),
            kHeight - 0.15F + 0.55F * std::sin(angle), z};
        post.bars.push_back({last, next, 0.04F});
        last = next;
    }
    const Vec3 head = {x_head, kHeight + 0.36F, z};
    post.bars.push_back({last, head, 0.045F});
    post.bars.push_back(
        {head + Vec3{side * 0.30F, -0.02F, 0}, head + Vec3{-side * 0.22F, -0.06F, 0}, 0.10F});
    street.posts.push_back(std::move(post));

    const Vec3 bowl = head + Vec3{-side * 0.02F, -0.17F, 0};
    constexpr float kLuminance = 2e4F;
    street.luminaires.push_back(
        {bowl, {kBowl.x, 0, 0}, {0, kBowl.y, 0}, colour * kLuminance, false});
    street.lights.push_back({bowl,
                             colour * (kLuminance * 3.14159265F * kBowl.x * kBowl.y),
                             {0, -1, 0},
                             Lobe::kLamp,
                             kBowl.x,
                             true});
}

void add_headlamps(const Car& car, Street& street) {
    constexpr float kRadius = 0.035F;
    constexpr float kLuminance = 1e6F;
    static const Vec3 colour = black_body_rgb(4600);
    for (const float x : {-0.64F, 0.64F}) {
        const Vec3 at = car.position + Vec3{x, 0.66F, car.heading * 2.13F};
        street.luminaires.push_back(
            {at, {kRadius, 0, 0}, {0, kRadius, 0}, colour * kLuminance, false});
        street.lights.push_back({at,
                                 colour * (kLuminance * 3.14159265F * kRadius * kRadius),
                                 {0, 0, car.heading},
                                 Lobe::kHeadlamp,
                                 kRadius,
                                 true});
    }
}

void add_tail_lamps(const Car& car, Street& street) {
    constexpr float kHalfWidth = 0.115F;
    constexpr float kHalfHeight = 0.045F;
    constexpr float kLuminance = 300;
    const Vec3 colour = unit_luminance({1, 0.028F, 0.012F});
    for (const float x : {-0.70F, 0.70F}) {
        const Vec3 at = car.position + Vec3{x, 0.77F, -car.heading * 2.14F};
        street.luminaires.push_back(
            {at, {kHalfWidth, 0, 0}, {0, kHalfHeight, 0}, colour * kLuminance, true});
        street.lights.push_back({at,
                                 colour * (kLuminance * 4 * kHalfWidth * kHalfHeight),
                                 {0, 0, -car.heading},
                                 Lobe::kCosine,
                                 0.09F,
                                 true});
    }
}

Vec3 car_paint(Random& random) {
    constexpr std::array<Vec3, 6> kPaints = {{{0.02F, 0.02F, 0.022F},
                                              {0.25F, 0.26F, 0.27F},
                                              {0.09F, 0.012F, 0.012F},
                                              {0.015F, 0.03F, 0.075F},
                                              {0.40F, 0.40F, 0.39F},
                                              {0.06F, 0.065F, 0.07F}}};
    return kPaints[static_cast<std::size_t>(index_below(random, 6))];
}

void add_cars(Random& random, Street& street) {
    int seed = 0;
    const auto add = [&](float x, float z, float heading) {
        street.cars.push_back(
            {{x, 0, z}, heading, car_paint(random), ++seed, random.uniform() < 0.4});
        return street.cars.back();
    };
    // Parked along both kerbs, with gaps; the near ones stand beside the picture.
    for (float z = 11; z < 165;) {
        add(4.42F + uniform(random, -0.08, 0.08), z, 1);
        z += uniform(random, 5.2, 6.0) + (random.uniform() < 0.35 ? uniform(random, 5, 11) : 0);
    }
    for (float z = 17.5F; z < 165;) {
        add(-4.42F + uniform(random, -0.08, 0.08), z, -1);
        z += uniform(random, 5.2, 6.0) + (random.uniform() < 0.4 ? uniform(random, 5, 12) : 0);
    }
    for (const float z : {33.0F, 78.0F, 140.0F}) add_headlamps(add(-1.75F, z, -1), street);
    for (const float z : {20.5F, 52.0F, 104.0F}) {
        const Car car = add(1.75F, z, 1);
        add_tail_lamps(car, street);
        // Its own dipped beam lights the road and the houses before it.
        for (const float x : {-0.64F, 0.64F}) {
            street.lights.push_back({car.position + Vec3{x, 0.66F, 2.13F},
                                     Vec3{3500, 3400, 3100},
                                     {0, 0, 1},
                                     Lobe::kHeadlamp,
                                     0.05F,
                                     false});
        }
    }
}

// A luminous rectangle upright in the plane z = const.
void add_stroke(float x0, float y0, float x1, float y1, float z, Vec3 radiance, Street& street) {
    street.luminaires.push_back({{0.5F * (x0 + x1), 0.5F * (y0 + y1), z},
                                 {0.5F * (x1 - x0), 0, 0},
                                 {0, 0.5F * (y1 - y0), 0},
                                 radiance,
                                 true});
}

// HOTEL, one letter above the other, in neon tubes on a board that juts out from the left.
void add_sign(float z, Street& street) {
    const Vec3 pink = unit_luminance({1, 0.10F, 0.22F}) * 400;
    constexpr float kLeft = -8.25F;
    constexpr float kWidth = 0.42F;
    constexpr float kHeight = 0.58F;
    constexpr float kTube = 0.05F;
    const char letters[] = {'H', 'O', 'T', 'E', 'L'};
    float top = 8.1F;
    for (const char letter : letters) {
        const float bottom = top - kHeight;
        const float right = kLeft + kWidth;
        const float middle = 0.5F * (top + bottom);
        const auto upright = [&](float x, float low, float high) {
            add_stroke(x - 0.5F * kTube, low, x + 0.5F * kTube, high, z, pink, street);
        };
        const auto level = [&](float y, float from, float to) {
            add_stroke(from, y - 0.5F * kTube, to, y + 0.5F * kTube, z, pink, street);
        };
        const float inner = 0.5F * kTube + 0.015F;
        if (letter == 'T') {
            level(top, kLeft, right);
            upright(0.5F * (kLeft + right), bottom, top - inner);
        } else {
            upright(kLeft, bottom, top);
            if (letter != 'L' && letter != 'T' && letter != 'E') upright(right, bottom, top);
            const float end = letter == 'E' || letter == 'L' ? right : right - inner;
            if (letter != 'L' && letter != 'O')
                level(middle, kLeft + inner, end - (letter == 'E' ? 0.06F : 0));
            if (letter == 'O' || letter == 'E') level(top - 0.5F * kTube, kLeft + inner, end);
            if (letter != 'H') level(bottom + 0.5F * kTube, kLeft + inner, end);
        }
        top -= kHeight + 0.17F;
    }
    street.chimneys.push_back(
        {{kLeft - 0.14F, top + 0.02F, z + 0.05F}, {kLeft + kWidth + 0.14F, 8.28F, z + 0.20F}});
    street.lights.push_back({{kLeft + 0.5F * kWidth, 6.2F, z - 0.3F},
                             pink * 0.45F,
                             {0, 0, -1},
                             Lobe::kCosine,
                             0.9F,
                             true});
}

void add_signal(float x, float z, Street& street) {
    Post post;
    post.bars.push_back({{x, 0, z}, {x, 3.6F, z}, 0.06F});
    street.posts.push_back(post);
    street.chimneys.push_back({{x - 0.17F, 2.55F, z - 0.12F}, {x + 0.17F, 3.55F, z + 0.1F}});
    const Vec3 green = unit_luminance({0.02F, 1, 0.48F});
    const Vec3 at = {x, 2.74F, z - 0.15F};
    constexpr float kRadius = 0.1F;
    constexpr float kLuminance = 5000;
    street.luminaires.push_back({at, {kRadius, 0, 0}, {0, kRadius, 0}, green * kLuminance, false});
    street.lights.push_back({at,
                             green * (kLuminance * 3.14159265F * kRadius * kRadius),
                             {0, 0, -1},
                             Lobe::kCosine,
                             kRadius,
                             true});
}

}  // namespace

Street build_street(std::uint64_t seed) {
    Street street;
    Random houses(seed, 33);
    add_side(houses, -1, street);
    add_side(houses, 1, street);
    // The houses that close the street.
    float x = -24;
    for (int i = 0; i < 5; ++i) {
        Building b = make_building(houses, 300 + i);
        b.origin = {x, 0, kStreetEndZ};
        b.along = {1, 0, 0};
        b.normal = {0, 0, -1};
        x += b.width;
        street.buildings.push_back(b);
    }
    for (int i = 0; i < 7; ++i) {
        const float z = 15.5F + 27 * static_cast<float>(i);
        add_lamp(-5.95F, -4.4F, z, street);
        if (z + 13.5F < kStreetEndZ) add_lamp(5.95F, 4.4F, z + 13.5F, street);
    }
    Random traffic(seed, 133);
    add_cars(traffic, street);
    add_sign(36, street);
    add_signal(5.75F, 62, street);
    // The observer's own dipped beams.
    for (const float at : {-0.62F, 0.62F}) {
        street.lights.push_back({{kEye.x + at, 0.66F, 1.6F},
                                 Vec3{950, 930, 860},
                                 {0, 0, 1},
                                 Lobe::kHeadlamp,
                                 0.05F,
                                 false});
    }
    street.people = {{{7.0F, 0, 13.6F}, 1.76F, 0.13F},
                     {{-3.1F, 0, 14.6F}, 1.74F, 0.10F},
                     {{-7.0F, 0, 31}, 1.68F, 0.10F},
                     {{-6.6F, 0, 31.5F}, 1.80F, 0.12F},
                     {{-6.9F, 0, 58}, 1.75F, 0.12F}};
    sort_lights(street);
    return street;
}

}  // namespace aureole::scene::night
