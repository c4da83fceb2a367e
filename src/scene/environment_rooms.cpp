// Environments indoors: a photographer's studio and a living room. Distances in metres from the
// eye, which is at the origin.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "scene/builders.h"
#include "scene/environments.h"
#include "scene/noise.h"

namespace aureole::scene {
namespace {

constexpr auto kPiF = static_cast<float>(kPi);

// A rectangle that shines to one side.
struct Panel {
    Vec3 centre;
    Vec3 half_1;  // perpendicular to each other
    Vec3 half_2;
    Vec3 normal;  // to the lit side
    Vec3 radiance;
};

Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Turned to the eye, upright.
Panel facing_eye(Vec3 centre, float half_width, float half_height, Vec3 radiance) {
    const Vec3 normal = normalize(centre) * -1.0F;
    const Vec3 hint = std::abs(normal.y) > 0.9F ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    const Vec3 right = normalize(cross(hint, normal));
    return {centre, right * half_width, cross(normal, right) * half_height, normal, radiance};
}

// Place on a panel in [-1, 1] each way, where a ray from a point meets it from the lit side.
bool hit(const Panel& panel, Vec3 origin, Vec3 direction, float& distance, float& u, float& v) {
    const float towards = dot(direction, panel.normal);
    if (towards > -1e-6F) return false;
    distance = dot(panel.centre - origin, panel.normal) / towards;
    if (distance <= 0) return false;
    const Vec3 place = origin + direction * distance - panel.centre;
    u = dot(place, panel.half_1) / dot(panel.half_1, panel.half_1);
    v = dot(place, panel.half_2) / dot(panel.half_2, panel.half_2);
    return std::abs(u) <= 1 && std::abs(v) <= 1;
}

// Light of all panels on a surface, lx: each as n x n points. Nothing throws shadows.
Vec3 irradiance(std::span<const Panel> panels, Vec3 point, Vec3 normal, int n) {
    Vec3 sum;
    for (const Panel& panel : panels) {
        const float part =
            4 * length(panel.half_1) * length(panel.half_2) / static_cast<float>(n * n);
        for (int i = 0; i < n * n; ++i) {
            const float u = (2 * static_cast<float>(i % n) + 1) / static_cast<float>(n) - 1;
            const float v = (2 * static_cast<float>(i / n) + 1) / static_cast<float>(n) - 1;
            const Vec3 to = panel.centre + panel.half_1 * u + panel.half_2 * v - point;
            const float near2 = std::max(dot(to, to), 0.04F);
            const float cosines =
                std::max(0.0F, dot(to, normal)) * std::max(0.0F, -dot(to, panel.normal));
            sum += panel.radiance * (part * cosines / (near2 * near2));
        }
    }
    return sum;
}

struct Room {
    Vec3 low;
    Vec3 high;
};

struct Surface {
    Vec3 point;
    Vec3 normal;
    int axis;      // of the normal
    float corner;  // distance to the nearest other wall
};

Surface leave(const Room& room, Vec3 origin, Vec3 direction) {
    const std::array<float, 3> from = {origin.x, origin.y, origin.z};
    const std::array<float, 3> along = {direction.x, direction.y, direction.z};
    const std::array<float, 3> low = {room.low.x, room.low.y, room.low.z};
    const std::array<float, 3> high = {room.high.x, room.high.y, room.high.z};
    float nearest = 1e9F;
    std::size_t axis = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::abs(along[i]) < 1e-7F) continue;
        const float t = ((along[i] > 0 ? high[i] : low[i]) - from[i]) / along[i];
        if (t >= nearest) continue;
        nearest = t;
        axis = i;
    }
    Surface surface = {origin + direction * nearest, {}, static_cast<int>(axis), 1e9F};
    const float sign = along[axis] > 0 ? -1.0F : 1.0F;
    surface.normal = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    const std::array<float, 3> at = {surface.point.x, surface.point.y, surface.point.z};
    for (std::size_t i = 0; i < 3; ++i) {
        if (i != axis) surface.corner = std::min({surface.corner, at[i] - low[i], high[i] - at[i]});
    }
    return surface;
}

// ---- Studio ----

struct Studio {
    std::array<Panel, 6> panels;
    Room room = {{-5, -1.35F, -5}, {5, 3.4F, 5}};
    int seed;
    float pixel_rad;
};

Studio build_studio(const EnvironmentOptions& options) {
    const Vec3 daylight = black_body_rgb(5600);
    const Vec3 warm = black_body_rgb(3600);
    const Vec3 cool = black_body_rgb(9000);
    return {{facing_eye({-2.3F, 1.5F, 1.9F}, 1.0F, 0.75F, daylight * 9000),    // key
             facing_eye({2.9F, 0.5F, 1.3F}, 0.45F, 1.3F, daylight * 2500),     // fill
             facing_eye({1.7F, 1.1F, -2.5F}, 0.2F, 1.1F, cool * 14000),        // rim
             facing_eye({-2.4F, 0.8F, -2.2F}, 0.2F, 1.0F, warm * 9000),        // rim
             facing_eye({0.3F, 2.7F, -0.5F}, 0.7F, 0.5F, daylight * 3500),     // above
             facing_eye({0.4F, -0.75F, 3.6F}, 0.8F, 0.12F, daylight * 3000)},  // low strip
            {{-5, -1.35F, -5}, {5, 3.4F, 5}},
            texture_seed(options),
            static_cast<float>(2 * kPi / options.width)};
}

// A panel seen through its cloth: brighter over the lamp, black rim, seams.
bool look_at_panels(const Studio& studio, Vec3 origin, Vec3 direction, Vec3& radiance) {
    float nearest = 1e9F;
    for (const Panel& panel : studio.panels) {
        float distance = 0;
        float u = 0;
        float v = 0;
        if (!hit(panel, origin, direction, distance, u, v) || distance > nearest) continue;
        nearest = distance;
        const float rim_1 = 0.045F / length(panel.half_1);
        const float rim_2 = 0.045F / length(panel.half_2);
        const bool rim = std::abs(u) > 1 - rim_1 || std::abs(v) > 1 - rim_2;
        const float lamp = std::exp(-0.9F * (u * u + v * v));
        radiance = rim ? Vec3{6, 6, 6} : panel.radiance * (0.55F + 0.55F * lamp);
    }
    return nearest < 1e9F;
}

Vec3 look_at_walls(const Studio& studio, Vec3 origin, Vec3 direction) {
    const Surface wall = leave(studio.room, origin, direction);
    const Vec3 light = irradiance(studio.panels, wall.point, wall.normal, 2);
    const bool floor = wall.normal.y > 0.5F;
    const float footprint = studio.pixel_rad * dot(wall.point, wall.point);
    const float stains =
        floor ? fractal_noise(wall.point.x, wall.point.z, 1.3F, 6, footprint, studio.seed) : 0;
    Vec3 albedo =
        floor ? Vec3{0.20F, 0.195F, 0.19F} * (1 + 0.35F * stains) : Vec3{0.15F, 0.155F, 0.17F};
    if (wall.axis == 2 && wall.normal.z < 0 && std::abs(wall.point.x) < 3) {
        albedo = {0.42F, 0.42F, 0.43F};  // the backdrop, grey paper
    }
    const float ambient = 420 * (1 - 0.5F * std::exp(-wall.corner / 0.5F));
    return albedo * (light + Vec3{1, 1, 1} * ambient) * (1 / kPiF);
}

Vec3 look_into_studio(const Studio& studio, Vec3 direction) {
    Vec3 radiance;
    if (look_at_panels(studio, {}, direction, radiance)) return radiance;
    radiance = look_at_walls(studio, {}, direction);
    if (direction.y >= 0) return radiance;
    // Polished floor: Schlick 1994, index 1.5.
    const Surface floor = leave(studio.room, {}, direction);
    if (floor.normal.y < 0.5F) return radiance;
    const float graze = 1 + direction.y;
    const float fresnel = 0.04F + 0.96F * graze * graze * graze * graze * graze;
    const Vec3 mirrored = {direction.x, -direction.y, direction.z};
    Vec3 reflection;
    if (!look_at_panels(studio, floor.point, mirrored, reflection)) {
        reflection = look_at_walls(studio, floor.point, mirrored);
    }
    return radiance + reflection * fresnel;
}

// ---- Interior ----

constexpr Room kRoom = {{-2.6F, -1.45F, -2.4F}, {3.2F, 1.25F, 3.4F}};
// On the wall at x = 3.2.
constexpr float kWindowLow = -0.55F, kWindowHigh = 0.95F, kWindowFrom = -0.7F, kWindowTo = 1.9F;

struct Interior {
    std::array<Panel, 3> panels;  // window, two luminaires
    int seed;
    float pixel_rad;
};

Interior build_interior(const EnvironmentOptions& options) {
    const Vec3 outside = unit_luminance({0.9F, 1.0F, 1.15F}) * 4200;
    const Vec3 lamp = black_body_rgb(3500) * 3800;
    const float y = kRoom.high.y - 0.02F;
    const Vec3 down = {0, -1, 0};
    return {{Panel{{kRoom.high.x, (kWindowLow + kWindowHigh) / 2, (kWindowFrom + kWindowTo) / 2},
                   {0, 0, (kWindowTo - kWindowFrom) / 2},
                   {0, (kWindowHigh - kWindowLow) / 2, 0},
                   {-1, 0, 0},
                   outside},
             Panel{{-0.9F, y, 0.4F}, {0.16F, 0, 0}, {0, 0, 0.75F}, down, lamp},
             Panel{{1.5F, y, 0.4F}, {0.16F, 0, 0}, {0, 0, 0.75F}, down, lamp}},
            texture_seed(options),
            static_cast<float>(2 * kPi / options.width)};
}

// What is seen through the window: sky, roofs, a tree.
Vec3 look_outside(Vec3 direction, int seed) {
    const float height = direction.y;
    const float along = direction.z / std::max(direction.x, 0.05F);
    const float roof = 0.02F + 0.07F * hash_uniform(floor_int(along * 5), 3, seed);
    const float tree = 0.24F - 2.2F * square(along - 0.1F) +
                       0.12F * fractal_noise(along * 6, height * 6, 0.8F, 4, 0, seed);
    if (height < tree) return Vec3{0.35F, 0.55F, 0.22F} * 900;
    if (height < roof) return Vec3{0.75F, 0.45F, 0.35F} * 1300;
    return unit_luminance({0.75F, 0.97F, 1.3F}) * (4200 + 2500 * std::exp(-height / 0.3F));
}

bool look_at_window(Vec3 point, Vec3 direction, int seed, Vec3& radiance) {
    if (point.y < kWindowLow || point.y > kWindowHigh || point.z < kWindowFrom ||
        point.z > kWindowTo) {
        return false;
    }
    const float rim = std::min(
        {point.y - kWindowLow, kWindowHigh - point.y, point.z - kWindowFrom, kWindowTo - point.z});
    const float middle = 0.5F * (kWindowFrom + kWindowTo);
    const bool bar =
        rim < 0.07F || std::abs(point.z - middle) < 0.05F || std::abs(point.y - 0.45F) < 0.03F;
    radiance = bar ? Vec3{90, 88, 84} : look_outside(direction, seed);
    return true;
}

Vec3 wood(float across, float along, float footprint, int seed) {
    const int row = floor_int(across / 0.14F);
    const float shift = hash_uniform(row, 1, seed);
    const int plank = floor_int(along / 1.3F + shift);
    const float tone = 0.75F + 0.5F * hash_uniform(row, plank, seed + 2);
    const float grain = fractal_noise(across * 9, along + 7 * tone, 0.5F, 4, 4 * footprint, seed);
    const float in_row = across / 0.14F - static_cast<float>(row);
    const float in_plank = along / 1.3F + shift - static_cast<float>(plank);
    const bool gap = in_row < 0.025F || in_plank < 0.003F;
    return Vec3{0.36F, 0.20F, 0.10F} * (tone * (1 + 0.35F * grain) * (gap ? 0.4F : 1.0F));
}

// Shelves over the whole wall at +z.
Vec3 books(float x, float y, int seed) {
    const float shelf = (y - kRoom.low.y) / 0.34F;
    const int row = floor_int(shelf);
    const float height = shelf - static_cast<float>(row);
    const float panel = std::abs(x / 0.95F - std::round(x / 0.95F));
    if (height < 0.08F || panel < 0.02F) return {0.42F, 0.30F, 0.18F};
    const float place = x / 0.045F;
    const int book = floor_int(place);
    const float top = 0.62F + 0.3F * hash_uniform(book, row, seed);
    if (height > top || hash_uniform(book / 9, row, seed + 1) < 0.12F)
        return {0.05F, 0.035F, 0.025F};
    const float edge = place - static_cast<float>(book);
    const Vec3 colours[] = {{0.35F, 0.08F, 0.06F}, {0.08F, 0.16F, 0.30F}, {0.10F, 0.22F, 0.12F},
                            {0.55F, 0.50F, 0.38F}, {0.40F, 0.26F, 0.08F}, {0.12F, 0.12F, 0.13F}};
    const Vec3 colour = colours[hash_bits(book, row, seed + 3) % 6U];
    const bool band = std::abs(height - 0.7F * top) < 0.03F;
    return colour * ((0.6F + 0.8F * edge * (1 - edge) * 2) * (band ? 1.8F : 1.0F));
}

// Pictures on the wall at -x.
bool paintings(float z, float y, int seed, Vec3& albedo) {
    const float centres[] = {-1.3F, 0.3F, 2.0F};
    const float halves[] = {0.42F, 0.62F, 0.42F};
    for (int i = 0; i < 3; ++i) {
        const float u = (z - centres[i]) / halves[i];
        const float v = (y - 0.15F) / 0.48F;
        if (std::abs(u) > 1 || std::abs(v) > 1) continue;
        const float rim = std::min((1 - std::abs(u)) * halves[i], (1 - std::abs(v)) * 0.48F);
        const float hue = fractal_noise(u * 2, v * 2, 1.1F, 4, 0, seed + 31 * i);
        const Vec3 a = i == 1 ? Vec3{0.55F, 0.16F, 0.07F} : Vec3{0.06F, 0.20F, 0.34F};
        const Vec3 b = i == 1 ? Vec3{0.62F, 0.52F, 0.20F} : Vec3{0.55F, 0.58F, 0.50F};
        albedo = rim < 0.035F  ? Vec3{0.04F, 0.03F, 0.025F}
                 : rim < 0.11F ? Vec3{0.72F, 0.70F, 0.66F}
                               : mix(a, b, smoothstep(-0.3F, 0.3F, hue + 0.3F * v));
        return true;
    }
    return false;
}

Vec3 interior_albedo(const Surface& wall, float footprint, int seed) {
    const Vec3& p = wall.point;
    if (wall.normal.y > 0.5F) {
        // A carpet on wooden planks.
        const float x = p.x - 0.4F;
        const float z = p.z - 0.5F;
        if (std::abs(x) < 1.3F && std::abs(z) < 0.95F) {
            const float rim = std::min(1.3F - std::abs(x), 0.95F - std::abs(z));
            const float stripes = stripe_coverage(rim, 0.16F, 0.05F, footprint);
            const float pile = fractal_noise(x, z, 0.05F, 3, footprint, seed);
            return mix(Vec3{0.30F, 0.06F, 0.05F}, Vec3{0.55F, 0.45F, 0.28F}, stripes) *
                   (1 + 0.3F * pile);
        }
        return wood(p.x, p.z, footprint, seed);
    }
    if (wall.normal.y < -0.5F) return {0.78F, 0.77F, 0.74F};
    const float above_floor = p.y - kRoom.low.y;
    if (wall.axis == 2 && p.z > 0) return books(p.x, p.y, seed);
    if (above_floor < 0.11F) return {0.70F, 0.69F, 0.66F};
    if (wall.axis == 2 && std::abs(p.x + 0.6F) < 0.5F && above_floor < 2.05F) {
        // A door with four panels.
        const float u = std::abs(std::abs(p.x + 0.6F) - 0.23F);
        const float v = std::abs(std::abs(above_floor - 1.02F) - 0.5F);
        const bool groove = std::max(u / 0.16F, v / 0.38F) > 0.93F && u < 0.17F && v < 0.405F;
        return Vec3{0.52F, 0.50F, 0.46F} * (groove ? 0.55F : 1.0F);
    }
    Vec3 albedo;
    if (wall.axis == 0 && p.x < 0 && paintings(p.z, p.y, seed, albedo)) return albedo;
    // Wallpaper in broad stripes.
    const float along = wall.axis == 0 ? p.z : p.x;
    const float stripes = stripe_coverage(along, 0.24F, 0.12F, footprint);
    const float paper = fractal_noise(along, p.y, 0.06F, 3, footprint, seed + 9);
    return mix(Vec3{0.58F, 0.57F, 0.48F}, Vec3{0.50F, 0.53F, 0.45F}, stripes) * (1 + 0.08F * paper);
}

Vec3 look_into_room(const Interior& interior, Vec3 origin, Vec3 direction, bool mirror) {
    for (std::size_t i = 1; i < interior.panels.size(); ++i) {
        float distance = 0;
        float u = 0;
        float v = 0;
        if (hit(interior.panels[i], origin, direction, distance, u, v)) {
            return std::abs(u) > 0.9F ? Vec3{150, 145, 135} : interior.panels[i].radiance;
        }
    }
    const Surface wall = leave(kRoom, origin, direction);
    Vec3 radiance;
    if (wall.axis == 0 && wall.point.x > 0 &&
        look_at_window(wall.point, direction, interior.seed, radiance)) {
        return radiance;
    }
    const float footprint = interior.pixel_rad * length(wall.point - origin);
    const Vec3 light = irradiance(interior.panels, wall.point, wall.normal, 3);
    const Vec3 ambient = Vec3{1.05F, 1.0F, 0.92F} * 420.0F;
    const float open = 1 - 0.45F * std::exp(-wall.corner / 0.18F);
    radiance = interior_albedo(wall, footprint, interior.seed) * (light + ambient) * (open / kPiF);
    if (!mirror || wall.normal.y < 0.5F) return radiance;
    if (std::abs(wall.point.x - 0.4F) < 1.3F && std::abs(wall.point.z - 0.5F) < 0.95F) {
        return radiance;  // the carpet is dull
    }
    const float graze = 1 + direction.y;
    const float fresnel = 0.04F + 0.5F * graze * graze * graze * graze * graze;
    return radiance + look_into_room(interior, wall.point + wall.normal * 1e-3F,
                                     {direction.x, -direction.y, direction.z}, false) *
                          fresnel;
}

}  // namespace

Environment make_studio(const EnvironmentOptions& options) {
    const Studio studio = build_studio(options);
    Environment out;
    out.rgb = render_sphere(options, 1500,
                            [&](Vec3 direction) { return look_into_studio(studio, direction); });
    out.adaptation_cd_m2 = mean_luminance(out.rgb, 0.9);
    out.display_white_cd_m2 = 1000;
    return out;
}

Environment make_interior(const EnvironmentOptions& options) {
    const Interior interior = build_interior(options);
    Environment out;
    out.rgb = render_sphere(options, 800, [&](Vec3 direction) {
        return look_into_room(interior, {}, direction, true);
    });
    out.adaptation_cd_m2 = mean_luminance(out.rgb, 0.9);
    out.display_white_cd_m2 = 600;
    return out;
}

}  // namespace aureole::scene
