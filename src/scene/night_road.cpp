// Asphalt, markings, kerbs and pavement, dry and wet.
#include "scene/night_road.h"

#include <cmath>

#include "aureole/base/parallel.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

struct Ground {
    float x, z;
    float filter_x, filter_z;  // footprint of the pixel, m
};

float box(float v, float low, float high, float width) {
    return interval_coverage(v, low, high, width);
}

// Share of road paint, worn.
float markings(const Ground& g) {
    const float x = std::abs(g.x);
    const float dash = stripe_coverage(g.z + 1.0F, 9, 3, g.filter_z);
    float paint = box(g.x, -0.06F, 0.06F, g.filter_x) * dash;
    paint = std::max(paint, box(x, 3.42F, 3.52F, g.filter_x));
    // Parking bays end in short cross lines.
    paint = std::max(paint, box(x, 3.42F, kKerbX - 0.35F, g.filter_x) *
                                stripe_coverage(g.z + 3.2F, 11.4F, 0.1F, g.filter_z));
    // A zebra crossing.
    const float zebra = box(g.z, 13.2F, 16.2F, g.filter_z) * box(x, 0, 3.4F, g.filter_x) *
                        stripe_coverage(g.x + 0.25F, 1.0F, 0.5F, g.filter_x);
    const bool at_crossing = g.z > 11.5F && g.z < 18;
    paint = at_crossing ? zebra : paint;
    const float wear = 0.72F + 0.5F * fractal_noise(g.x, g.z, 0.5F, 4,
                                                    std::max(g.filter_x, 0.3F * g.filter_z), 91);
    return paint * clamp01(wear);
}

// How far the film of water closes over the grain, 0 damp to 1 puddle: ruts, gutters, hollows.
float water(const Ground& g) {
    const float filter = std::max(g.filter_x, 0.25F * g.filter_z);
    const float hollows = fractal_noise(g.x, 0.55F * g.z, 3.4F, 4, filter, 5);
    const float lane = std::abs(std::abs(g.x) - 1.75F);
    const float ruts = std::exp(-square((lane - 0.72F) / 0.28F));
    const float gutter = smoothstep(0.75F, 0.1F, kKerbX - std::abs(g.x));
    return smoothstep(0.02F, 0.62F, hollows + 0.20F * ruts + 0.42F * gutter);
}

struct Material {
    Vec3 albedo;
    float alpha;   // roughness of the reflecting surface
    float film;    // share of the ground that reflects as one smooth surface
    float ripple;  // amplitude of the slopes that are resolved, rad
};

Material road(const Ground& g) {
    const float filter = std::max(g.filter_x, 0.3F * g.filter_z);
    const float grain = 1 + 0.55F * survives(0.02F, filter) * value_noise(g.x * 90, g.z * 90, 21) +
                        0.35F * fractal_noise(g.x, g.z, 0.16F, 3, filter, 22) +
                        0.30F * fractal_noise(g.x, 0.4F * g.z, 2.6F, 3, filter, 23);
    // A repaired trench, darker and smoother, and a seam between the lanes.
    const float patch = box(g.x, 0.55F, 1.5F, g.filter_x) * box(g.z, 6.0F, 10.6F, g.filter_z);
    const float seam = box(g.x, 0.16F, 0.18F, g.filter_x) + box(g.x, -3.30F, -3.28F, g.filter_x);
    const float wet = water(g);
    Vec3 albedo = Vec3{0.060F, 0.058F, 0.056F} *
                  (std::max(grain, 0.2F) * (1 - 0.35F * patch) * (1 - 0.5F * seam));
    albedo = mix(albedo, Vec3{0.33F, 0.33F, 0.31F}, markings(g));
    // A manhole cover.
    const float r = std::hypot(g.x + 0.55F, g.z - 9.1F);
    const float lid = smoothstep(0.36F + 0.5F * filter, 0.36F - 0.5F * filter, r);
    albedo = mix(albedo, Vec3{0.035F, 0.033F, 0.03F}, lid);
    return {albedo * (1 - 0.55F * wet), mix(0.17F, 0.04F, wet), mix(0.20F, 0.85F, wet),
            mix(0.016F, 0.005F, wet)};
}

Material pavement(const Ground& g) {
    const float filter = std::max(g.filter_x, 0.3F * g.filter_z);
    const float x = std::abs(g.x) - kKerbX;
    // Kerb: its face in the shade, then a stone edge.
    if (x < 0.0F) return {{0.02F, 0.02F, 0.02F}, 0.4F, 0.2F, 0.03F};
    const float slab = 0.6F;
    const int column = floor_int(x / slab);
    const float shift = (column & 1) != 0 ? 0.45F : 0;
    const int row = floor_int((g.z + shift) / 0.9F);
    const float joints = 1 - (stripe_coverage(x, slab, slab - 0.012F, g.filter_x) *
                              stripe_coverage(g.z + shift, 0.9F, 0.888F, g.filter_z));
    const float tone = 1 + survives(0.6F, filter) * 0.35F * (hash_uniform(column, row, 77) - 0.5F) +
                       0.35F * fractal_noise(g.x, g.z, 0.7F, 4, filter, 31);
    const float kerb = box(x, 0, 0.16F, g.filter_x);
    Vec3 albedo = mix(Vec3{0.105F, 0.10F, 0.094F} * tone, Vec3{0.17F, 0.168F, 0.16F} * tone, kerb);
    albedo = mix(albedo, Vec3{0.03F, 0.03F, 0.03F}, joints);
    const float wet = smoothstep(0.1F, 0.6F, fractal_noise(g.x, 0.6F * g.z, 1.9F, 3, filter, 37));
    return {albedo, mix(0.32F, 0.09F, wet), mix(0.30F, 0.75F, wet), mix(0.045F, 0.015F, wet)};
}

Material blend(const Material& a, const Material& b, float t) {
    return {mix(a.albedo, b.albedo, t), mix(a.alpha, b.alpha, t), mix(a.film, b.film, t),
            mix(a.ripple, b.ripple, t)};
}

Material ground_material(const Ground& g) {
    // The face of the kerb, 0.12 m high, is seen as a dark strip at the edge of the road.
    const float x = std::abs(g.x);
    const float outside = box(x, kKerbX, 1000, g.filter_x);
    const float face = box(x, kKerbX - 0.10F, kKerbX, g.filter_x);
    Material m = outside <= 0 ? road(g)
                              : (outside >= 1 ? pavement(g) : blend(road(g), pavement(g), outside));
    m.albedo = m.albedo * (1 - 0.75F * face);
    m.film *= 1 - 0.8F * face;
    return m;
}

// Light from the sky and walls that a car's body keeps from the road beneath it.
float under_cars(const Street& street, Vec3 p) {
    float open = 1;
    for (const Car& car : street.cars) {
        const float dz = std::abs(p.z - car.position.z) - 2.0F;
        if (dz > 1.5F) continue;
        const float dx = std::abs(p.x - car.position.x) - 0.8F;
        if (dx > 1.5F) continue;
        const float outside = std::hypot(std::max(dx, 0.0F), std::max(dz, 0.0F));
        const float inside = std::min(std::max(dx, dz), 0.0F);
        open *= mix(0.06F, 1.0F, smoothstep(-0.25F, 0.85F, outside + inside));
    }
    return open;
}

}  // namespace

GroundLight::GroundLight(const Street& street)
    : values_(static_cast<std::size_t>(kColumns) * static_cast<std::size_t>(kRows)) {
    parallel_for(static_cast<std::size_t>(kRows), [&](std::size_t row, int) {
        for (int i = 0; i < kColumns; ++i) {
            const Vec3 p = {kStep * static_cast<float>(i) - kHalfWidth, 0,
                            kStep * static_cast<float>(row)};
            values_[row * kColumns + static_cast<std::size_t>(i)] = {
                irradiance(street, p, {0, 1, 0}), under_cars(street, p)};
        }
    });
}

GroundLight::Value GroundLight::at(float x, float z) const {
    const float u = std::clamp((x + kHalfWidth) / kStep, 0.0F, kColumns - 1.01F);
    const float v = std::clamp(z / kStep, 0.0F, kRows - 1.01F);
    const auto i = static_cast<std::size_t>(u);
    const auto j = static_cast<std::size_t>(v);
    const Value* p = &values_[j * kColumns + i];
    const float s = u - static_cast<float>(i);
    const float t = v - static_cast<float>(j);
    const auto between = [](const Value& a, const Value& b, float weight) {
        return Value{mix(a.irradiance, b.irradiance, weight), mix(a.open, b.open, weight)};
    };
    return between(between(p[0], p[1], s), between(p[kColumns], p[kColumns + 1], s), t);
}

Vec3 ground_radiance(const Street& street, const GroundLight& light, const MirrorPicture& mirror,
                     const Camera& camera, double px, double py) {
    const Ray ray = camera.ray(px, py);
    if (ray.direction.y > -1e-4F) return {};
    const float t = -ray.origin.y / ray.direction.y;
    const Vec3 p = ray.at(t);
    const Vec3 to_eye = normalize(ray.direction) * -1;
    const float footprint = t * camera.pixel_size();
    // A step down the picture moves along the line of sight: mostly in z, but in x as well.
    const float along = footprint / to_eye.y;
    const float level = std::hypot(to_eye.x, to_eye.z);
    const Ground g{p.x, p.z, footprint + along * std::abs(to_eye.x) / level,
                   along * std::abs(to_eye.z) / level};
    const Material m = ground_material(g);

    // Slopes of the surface: what the pixel resolves moves the reflection, the rest blurs it.
    const float filter = std::max(g.filter_x, 0.2F * g.filter_z);
    const float resolved = survives(0.5F, filter);
    const float slope_x = m.ripple * 2 * fractal_noise(g.x, g.z, 0.45F, 3, filter, 41);
    const float slope_z = m.ripple * 2 * fractal_noise(g.x, g.z, 0.38F, 3, filter, 47);
    const float alpha = std::sqrt(m.alpha * m.alpha + 2 * square(m.ripple) * (1 - resolved));
    const Vec3 normal = normalize(Vec3{-slope_x, 1, -slope_z});

    constexpr float kInversePi = 0.31830989F;
    constexpr float kWater = 0.0204F;
    const auto [arriving, open] = light.at(p.x, p.z);
    Vec3 out = m.albedo * arriving * (kInversePi * open);
    out += glints(street, p, normal, to_eye, alpha, kWater, true) * (m.film * (0.3F + 0.7F * open));

    const float cosine = std::max(to_eye.y + 0.35F * alpha, 0.0F);
    const float fresnel = kWater + (1 - kWater) * std::pow(1 - std::min(cosine, 1.0F), 5.0F);
    // A slope turns the mirrored ray by twice itself: along the view in full, across it by the
    // sine of the grazing angle.
    const View& view = camera.view();
    const auto focal = static_cast<float>(view.focal_length_px() / view.width);
    const auto u = static_cast<float>((px - view.axis_x) / view.width);
    const auto v = static_cast<float>((py - view.axis_y) / view.width);
    const float half_height = 1.1F * alpha * focal;
    out += mirror.mean(u + 2 * slope_x * to_eye.y * focal, v + 2 * slope_z * focal, half_height,
                       smoothstep(0.05F, 0.16F, alpha)) *
           (fresnel * m.film * (0.4F + 0.6F * open));
    return out;
}

}  // namespace aureole::scene::night
