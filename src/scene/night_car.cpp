// A car as a distance function, and its surfaces.
#include <cmath>

#include "scene/night_street.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

float smooth_min(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0F) / k;
    return std::min(a, b) - h * h * k * 0.25F;
}

float smooth_max(float a, float b, float k) { return -smooth_min(-a, -b, k); }

float rounded_box(Vec3 p, Vec3 half, float radius) {
    const Vec3 q = {std::abs(p.x) - half.x + radius, std::abs(p.y) - half.y + radius,
                    std::abs(p.z) - half.z + radius};
    const Vec3 outside = {std::max(q.x, 0.0F), std::max(q.y, 0.0F), std::max(q.z, 0.0F)};
    return length(outside) + std::min(std::max(q.x, std::max(q.y, q.z)), 0.0F) - radius;
}

constexpr float kWheelZ[] = {1.36F, -1.30F};
constexpr float kWheelRadius = 0.32F;

// The cabin between sloping screens: distances to its planes in the side view.
float cabin(const Car& car, Vec3 p) {
    const float y = p.y - 0.92F;
    const float rear_slope = car.estate ? 0.30F : 0.62F;
    const float rear_base = car.estate ? 2.02F : 1.86F;
    const float front = (p.z - 1.02F + 1.15F * y) * 0.656F;
    const float rear = (-p.z - rear_base + (rear_slope / 0.5F) * y) *
                       (1 / std::sqrt(1 + square(rear_slope / 0.5F)));
    const float side = (std::abs(p.x) - 0.80F + 0.36F * y) * 0.94F;
    const float roof = y - 0.54F + 0.035F * square(p.z + 0.3F) + 0.05F * square(p.x);
    float d = smooth_max(front, rear, 0.10F);
    d = smooth_max(d, side, 0.10F);
    d = smooth_max(d, roof, 0.16F);
    return smooth_max(d, -y - 0.15F, 0.02F);
}

}  // namespace

// Local frame of a car: +z is its front.
Vec3 to_car(const Car& car, Vec3 world) {
    const Vec3 p = world - car.position;
    return {p.x * car.heading, p.y, p.z * car.heading};
}

float car_distance(const Car& car, Vec3 p) {
    // The body narrows and falls towards both ends.
    const float along = p.z / 2.12F;
    const float taper = 1 + 0.10F * along * along * along * along;
    const float fall = (p.z > 0 ? 0.11F : 0.02F) * along * along;
    // Flanks are convex, so that highlights run along them as lines.
    const float crown = 1 + 0.45F * square(p.y - 0.66F);
    const Vec3 q = {p.x * taper * crown, p.y - 0.615F + fall, p.z};
    float d = rounded_box(q, {0.885F, 0.335F, 2.12F}, 0.17F);
    // The cabin begins at 0.77 m.
    if (d > 0.70F - p.y) d = smooth_min(d, cabin(car, p), 0.07F);
    // Above the wheels the body is always nearer.
    if (p.y < 0.8F) {
        for (const float wheel_z : kWheelZ) {
            const float r = std::sqrt(square(p.y - kWheelRadius) + square(p.z - wheel_z));
            if (r > 0.9F) continue;
            d = smooth_max(d, -std::max(r - 0.385F, 0.62F - std::abs(p.x)), 0.02F);
            d = std::min(
                d, smooth_max(r - kWheelRadius, std::abs(std::abs(p.x) - 0.755F) - 0.105F, 0.04F));
        }
    }
    return 0.92F * d;
}

Vec3 shade_car(const Street& street, const Car& car, const SurfacePoint& at) {
    const Vec3 p = to_car(car, at.position);
    const Vec3 n = {at.normal.x * car.heading, at.normal.y, at.normal.z * car.heading};
    const bool on_wheel =
        p.y < 0.66F && std::abs(p.x) > 0.60F &&
        std::min(std::abs(p.z - kWheelZ[0]), std::abs(p.z - kWheelZ[1])) < kWheelRadius + 0.03F &&
        std::min(std::hypot(p.y - kWheelRadius, p.z - kWheelZ[0]),
                 std::hypot(p.y - kWheelRadius, p.z - kWheelZ[1])) < kWheelRadius + 0.02F;
    const Vec3 to_eye = at.direction * -1;
    if (on_wheel) {
        const float r = std::min(std::hypot(p.y - kWheelRadius, p.z - kWheelZ[0]),
                                 std::hypot(p.y - kWheelRadius, p.z - kWheelZ[1]));
        // Five spokes on a dark disc.
        const float wheel_z =
            std::abs(p.z - kWheelZ[0]) < std::abs(p.z - kWheelZ[1]) ? kWheelZ[0] : kWheelZ[1];
        const float angle = std::atan2(p.y - kWheelRadius, p.z - wheel_z);
        const bool spoke = r < 0.06F || r > 0.185F || std::cos(5 * angle) > 0.25F;
        const bool rim = r < 0.215F && std::abs(p.x) > 0.8F;
        const Vec3 albedo = rim ? (spoke ? Vec3{0.17F, 0.17F, 0.18F} : Vec3{0.02F, 0.02F, 0.02F})
                                : Vec3{0.015F, 0.015F, 0.015F};
        return shade_matte(street, at, albedo, rim && spoke ? 0.08F : 0.04F);
    }

    // Glass: the upper band of the cabin, but for pillars.
    const float y = p.y - 0.92F;
    bool glass = false;
    if (y > 0.055F && y < 0.435F) {
        const bool end_face = std::abs(n.z) > 0.45F;
        if (end_face) {
            glass = std::abs(p.x) < 0.70F - 0.36F * y;
        } else if (std::abs(n.x) > 0.5F) {
            const bool pillar = std::abs(p.z + 0.22F) < 0.05F || p.z > 0.86F - 1.15F * y ||
                                p.z < (car.estate ? -1.75F : -1.45F) + 0.6F * y;
            glass = !pillar;
        }
    }
    Vec3 albedo = car.paint;
    float gloss = 0.30F;
    float f0 = 0.045F;
    float alpha = 0.085F;
    if (glass) {
        albedo = {0.004F, 0.004F, 0.005F};
        alpha = 0.05F;
        gloss = 0.8F;
    } else if (p.y < 0.36F || (std::abs(n.z) > 0.5F && p.y < 0.46F)) {
        albedo = {0.02F, 0.02F, 0.02F};  // bumpers and sills
        gloss = 0.2F;
        alpha = 0.3F;
    }
    const bool rear = n.z < -0.5F;
    const bool front = n.z > 0.5F;
    if (!glass && (rear || front)) {
        const float x = std::abs(p.x);
        if (x < 0.26F && std::abs(p.y - (rear ? 0.60F : 0.44F)) < 0.058F) {
            albedo = {0.62F, 0.60F, 0.50F};  // number plate
            if (std::abs(p.x) < 0.23F && std::abs(p.y - (rear ? 0.60F : 0.44F)) < 0.035F &&
                std::abs(p.x - 0.066F * std::round(p.x / 0.066F)) < 0.019F) {
                albedo = {0.05F, 0.05F, 0.05F};
            }
        } else if (rear && x > 0.56F && p.y > 0.68F && p.y < 0.84F) {
            albedo = {0.20F, 0.010F, 0.008F};  // tail lamp glass
            alpha = 0.06F;
            f0 = 0.06F;
        } else if (front && x > 0.48F && p.y > 0.56F && p.y < 0.72F) {
            albedo = {0.25F, 0.25F, 0.26F};  // headlamp glass
            alpha = 0.06F;
            f0 = 0.10F;
        } else if (front && x < 0.42F && p.y > 0.54F && p.y < 0.68F) {
            albedo = {0.015F, 0.015F, 0.015F};  // grille
        }
    }
    // Beams along the road graze the flanks of a row of cars; most of it lies in the shadow of the
    // next car.
    if (std::abs(n.x) > 0.5F) gloss *= mix(1.0F, 0.12F, smoothstep(0.5F, 0.85F, std::abs(n.x)));
    constexpr float kInversePi = 0.31830989F;
    Vec3 out = albedo * irradiance(street, at.position, at.normal) * kInversePi;
    out += glints(street, at.position, at.normal, to_eye, alpha, f0, false) * gloss;
    // The surroundings in the clear coat: sky above, dim facades to the sides, road below.
    const float facing = dot(at.normal, to_eye);
    const Vec3 mirror = at.normal * (2 * facing) - to_eye;
    const float grazing = clamp01(1 - facing);
    const float fresnel = f0 + (1 - f0) * square(square(grazing)) * grazing;
    const Vec3 walls =
        Vec3{1.2F, 0.95F, 0.7F} * (0.22F + 0.12F * value_noise(mirror.x * 5, mirror.y * 9, 3));
    const Vec3 around = mix(walls, sky_radiance(mirror), smoothstep(0.25F, 0.6F, mirror.y));
    out += mix(Vec3{0.05F, 0.045F, 0.04F}, around, smoothstep(-0.12F, 0.06F, mirror.y)) *
           (fresnel * gloss);
    return out;
}

}  // namespace aureole::scene::night
