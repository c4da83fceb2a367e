#include "scene/water_surface.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"
#include "scene/noise.h"

namespace aureole::scene {
namespace {

constexpr double kShortestM = 0.1;
constexpr float kRippleVariance = 4e-4F;  // per axis, of what is shorter
constexpr float kPi32 = 3.14159265F;

}  // namespace

// Slope variance by wind speed, both axes (Cox & Munk 1954), shared equally by the waves: slopes of
// wind waves are about as strong in every octave.
WaterSurface::WaterSurface(const WaveField& field) {
    const double variance = 0.003 + 0.00512 * field.wind_m_s - 2 * double{kRippleVariance};
    Random random(field.seed, 31);
    for (int i = 0; i < field.waves; ++i) {
        const double rank = (i + random.uniform()) / field.waves;
        const double length = field.longest_m * std::pow(kShortestM / field.longest_m, rank);
        // Waves run within some 50 deg of the wind.
        const double heading = rad_from_deg(field.heading_deg + 50 * random.normal());
        const double k = 2 * kPi / length;
        constexpr double kGravity = 9.81;
        constexpr double kTension = 7.3e-5;  // surface tension over density, m3/s2
        const double rate = std::sqrt(kGravity * k + kTension * k * k * k);
        // A full turn taken off in double precision, for times of any size.
        const double phase = random.uniform() + rate * field.time_s / (2 * kPi);
        waves_.push_back({static_cast<float>(k * std::cos(heading)),
                          static_cast<float>(k * std::sin(heading)), static_cast<float>(length),
                          static_cast<float>(std::sqrt(2 * variance / field.waves)),
                          static_cast<float>(2 * kPi * (phase - std::floor(phase)))});
    }
}

WaterSurface::Slopes WaterSurface::at(Vec3 point, float across_m, float along_m) const {
    Slopes slopes;
    slopes.variance = kRippleVariance;
    for (const Wave& wave : waves_) {
        const float k = 2 * kPi32 / wave.length_m;
        const float width = std::hypot(across_m * wave.kx, along_m * wave.kz) / k;
        const float shown = survives(wave.length_m, width);
        slopes.variance += 0.25F * square(wave.slope) * (1 - square(shown));
        if (shown <= 0) continue;
        const float slope =
            shown * wave.slope * std::cos(wave.kx * point.x + wave.kz * point.z - wave.phase);
        slopes.x += slope * wave.kx / k;
        slopes.z += slope * wave.kz / k;
    }
    return slopes;
}

float fresnel_of_water(float cosine) {
    constexpr float kIndex = 1.333F;
    const float g = std::sqrt(kIndex * kIndex - 1 + cosine * cosine);
    const float a = square((g - cosine) / (g + cosine));
    const float b = square((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1));
    return 0.5F * a * (1 + b);
}

VisibleFacets visible_facets(float facing, float sigma) {
    const float t = std::max(facing, 0.0F) / sigma;
    const float below = 0.5F * std::erfc(-t / std::sqrt(2.0F));
    const float density = std::exp(-0.5F * square(t)) / std::sqrt(2 * kPi32);
    const float area = sigma * (t * below + density);
    return {area, square(sigma) * below / area};
}

float glitter(const WaterSurface::Slopes& slopes, Vec3 to_sun, Vec3 to_eye) {
    if (!(to_sun.y > 0)) return 0;
    const Vec3 half = normalize(to_sun + to_eye);
    const float off = square(-half.x / half.y - slopes.x) + square(-half.z / half.y - slopes.z);
    const float density = std::exp(-off / (2 * slopes.variance)) / (2 * kPi32 * slopes.variance);
    const float sigma = std::sqrt(slopes.variance);
    const float lit = to_sun.y / visible_facets(to_sun.y, sigma).area;
    return fresnel_of_water(dot(half, to_eye)) * density * lit /
           (4 * visible_facets(to_eye.y, sigma).area * square(square(half.y)));
}

}  // namespace aureole::scene
