// How the lights of the street fall on surfaces and mirror in them.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "scene/builders.h"
#include "scene/night_street.h"
#include "scene/noise.h"

namespace aureole::scene::night {
namespace {

// A bowl lamp: a little wider than Lambert's law, to light the road between two posts, with some
// spill above the horizontal.
inline float lamp_lobe(Vec3 direction) {
    const float down = -direction.y;
    return smoothstep(-0.25F, 0.55F, down) * (1.15F - 0.25F * down);
}

// The part of a dipped beam below its cut-off at the horizontal.
inline float dip(float up) { return 1.2F * smoothstep(0.004F, -0.02F, up); }

// A dipped beam: bright just below the horizontal, a wide weak spill above.
inline float headlamp_lobe(const Light& light, Vec3 direction) {
    const float ahead = direction.z * light.axis.z;  // beams run along the road
    if (ahead <= 0.05F) return 0;
    const float inverse = 1 / ahead;
    const float up = direction.y * inverse;
    const float aside2 = square(direction.x * inverse);
    if (up > 0.7F || aside2 > 0.8F) return 0;
    const float spread = 1 / (1 + aside2 * (20.7F + 169 * aside2)) * square(1 - 1.25F * aside2);
    if (up > 0) return spread * (1 - up * 1.43F) / square(1 + up * 12.5F) + spread * dip(up);
    return spread * (1 + dip(up) / square(1 - up * 10));
}

// Intensity towards `direction` (unit, from the light) relative to Light::intensity_cd.
inline float lobe(const Light& light, Vec3 direction) {
    if (light.lobe == Lobe::kLamp) return lamp_lobe(direction);
    if (light.lobe == Lobe::kHeadlamp) return headlamp_lobe(light, direction);
    return std::max(dot(direction, light.axis), 0.0F);
}

// How far a light matters beside the others; there it has faded to nothing.
float reach(const Light& light) {
    switch (light.lobe) {
        case Lobe::kLamp:
            return 36;
        case Lobe::kHeadlamp:
            return 75;
        case Lobe::kCosine:
            return std::min(std::sqrt(luminance(light.intensity_cd) / 0.15F), 24.0F);
    }
    return 0;
}

// Ends the inverse square law at the reach without an edge (Karis 2013, eq. 9).
float fade(const Light& light, float d2) {
    const float ratio = d2 / square(light.reach_m);
    return square(std::max(1 - ratio * ratio, 0.0F));
}

}  // namespace

void sort_lights(Street& street) {
    for (Light& light : street.lights) {
        light.reach_m = reach(light);
        light.candela = luminance(light.intensity_cd);
    }
    std::stable_sort(street.lights.begin(), street.lights.end(),
                     [](const Light& a, const Light& b) { return a.lobe < b.lobe; });
    std::copy_if(street.lights.begin(), street.lights.end(),
                 std::back_inserter(street.lights_mirrored),
                 [](const Light& light) { return light.in_reflection; });
    const int bins = static_cast<int>((kStreetEndZ + 40) / kBinLength);
    street.lights_near.assign(static_cast<std::size_t>(bins), {});
    for (int i = 0; i < bins; ++i) {
        const float low = kBinLength * static_cast<float>(i) - 20;
        const float high = low + kBinLength;
        for (const Light& light : street.lights) {
            const bool directed = light.lobe != Lobe::kLamp;
            const float from =
                light.position.z - (directed && light.axis.z > 0.5F ? 0 : light.reach_m);
            const float to =
                light.position.z + (directed && light.axis.z < -0.5F ? 0 : light.reach_m);
            if (from < high && to > low)
                street.lights_near[static_cast<std::size_t>(i)].push_back(light);
        }
    }
}

const std::vector<Light>& Street::lights_at(float z) const {
    const auto last = static_cast<float>(lights_near.size() - 1);
    return lights_near[static_cast<std::size_t>(std::clamp((z + 20) / kBinLength, 0.0F, last))];
}

Vec3 sky_radiance(Vec3 direction) {
    // The glow of a large town: what its lamps send up comes back from haze, brightest at the
    // horizon, and from broken cloud.
    constexpr Vec3 kZenith = Vec3{0.62F, 0.84F, 1.9F} * 0.085F;
    constexpr Vec3 kGlow = Vec3{1.22F, 0.96F, 0.82F} * 0.40F;
    const float up = std::max(direction.y, 0.0F);
    const float per_height = 1 / (up + 0.18F);
    const float cloud = fractal_noise(1.3F * direction.x * per_height, 1.3F * per_height, 1.0F, 5,
                                      0.01F * per_height, 8);
    const Vec3 haze = kZenith + kGlow * std::exp(-up / 0.14F);
    return haze * (1 + 0.55F * smoothstep(-0.1F, 0.6F, cloud));
}

Vec3 irradiance(const Street& street, Vec3 position, Vec3 normal) {
    // From the sky and from walls that the lamps light: constant but for which way a surface faces.
    constexpr Vec3 kAmbient = {1.02F, 0.84F, 0.76F};
    Vec3 sum = kAmbient * (0.65F + 0.35F * normal.y);
    for (const Light& light : street.lights_at(position.z)) {
        const Vec3 to_light = light.position - position;
        const float facing = dot(to_light, normal);
        if (facing <= 0) continue;
        const float d2 = dot(to_light, to_light);
        if (d2 >= square(light.reach_m)) continue;
        const float inverse = 1 / std::sqrt(d2);
        const float strength = lobe(light, to_light * -inverse);
        if (strength <= 0) continue;
        sum += light.intensity_cd *
               (fade(light, d2) * strength * facing * inverse / (d2 + square(light.radius_m) * 4));
    }
    return sum;
}

Vec3 IrradianceCache::at(const Street& street, const Building& building, Vec3 position,
                         Vec3 normal) {
    for (const Entry& entry : entries_) {
        if (entry.building == &building && dot(entry.normal, normal) > 0.9999F) {
            return entry.irradiance;
        }
    }
    Entry& entry = entries_[next_];
    next_ = (next_ + 1) % kEntries;
    entry = {&building, normal, irradiance(street, position, normal)};
    return entry.irradiance;
}

Vec3 glints(const Street& street, Vec3 position, Vec3 normal, Vec3 to_eye, float alpha, float f0,
            bool on_road) {
    const float cos_eye = dot(normal, to_eye);
    if (cos_eye <= 0) return {};
    Vec3 sum;
    // Far lights mirror in the road just as near ones do; on upright surfaces they hardly show.
    for (const Light& light : on_road ? street.lights_mirrored : street.lights_at(position.z)) {
        const Vec3 difference = light.position - position;
        const float d2 = dot(difference, difference);
        const float inverse = 1 / std::sqrt(d2);
        const Vec3 to_light = difference * inverse;
        const float cos_light = dot(normal, to_light);
        if (cos_light <= 0) continue;
        // Squares of the half vector's cosines, with the normal and with either direction.
        const float one_plus = 1 + dot(to_light, to_eye);
        const float cos2_half = square(cos_light + cos_eye) / (2 * one_plus);
        // The source's own size widens the lobe (Karis 2013, "Real Shading in Unreal Engine 4").
        const float wide = std::min(alpha + light.radius_m * inverse * 0.5F, 1.0F);
        const float a2 = wide * wide;
        const float distribution = a2 / (3.14159265F * square(cos2_half * (a2 - 1) + 1));
        // Too far from the mirror direction to be seen.
        if (light.candela * distribution * inverse * inverse < 3e-4F * cos_eye) continue;
        const float strength = lobe(light, to_light * -1);
        if (strength <= 0) continue;
        const float schlick = 1 - std::sqrt(0.5F * one_plus);
        const float fresnel = f0 + (1 - f0) * square(square(schlick)) * schlick;
        // Height-correlated Smith masking with the cosines' denominator (Heitz 2014).
        const float visibility =
            0.5F / (cos_light * std::sqrt(cos_eye * cos_eye * (1 - a2) + a2) +
                    cos_eye * std::sqrt(cos_light * cos_light * (1 - a2) + a2));
        sum += light.intensity_cd *
               (strength * fresnel * distribution * visibility * cos_light * inverse * inverse);
    }
    return sum;
}

Vec3 shade_matte(const Street& street, const SurfacePoint& at, Vec3 albedo, float gloss) {
    constexpr float kInversePi = 0.31830989F;
    Vec3 out = albedo * irradiance(street, at.position, at.normal) * kInversePi;
    if (gloss > 0) {
        out +=
            glints(street, at.position, at.normal, at.direction * -1, 0.25F, 0.04F, false) * gloss;
    }
    return out;
}

}  // namespace aureole::scene::night
