// Smooth noise for textures, the same on every machine: integer hashes on a lattice, cubic
// interpolation between.
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/vec.h"

namespace aureole::scene {

// An avalanche of three integers (finaliser of Murmur3).
inline std::uint32_t hash_bits(int a, int b, int c) {
    std::uint32_t h = static_cast<std::uint32_t>(a) * 0x9e3779b1U ^
                      static_cast<std::uint32_t>(b) * 0x85ebca77U ^
                      static_cast<std::uint32_t>(c) * 0xc2b2ae3dU;
    h ^= h >> 16U;
    h *= 0x85ebca6bU;
    h ^= h >> 13U;
    h *= 0xc2b2ae35U;
    h ^= h >> 16U;
    return h;
}

// Uniform in [0, 1).
inline float hash_uniform(int a, int b, int c) {
    return static_cast<float>(hash_bits(a, b, c) >> 8U) * 0x1p-24F;
}

// Floor as int, for coordinates below 2^31 in magnitude.
inline int floor_int(float v) {
    const int i = static_cast<int>(v);
    return i - (v < static_cast<float>(i) ? 1 : 0);
}

// Value noise in [-1, 1], one lattice cell per unit.
inline float value_noise(float x, float y, int seed) {
    const int ix = floor_int(x);
    const int iy = floor_int(y);
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const float u = fx * fx * (3 - 2 * fx);
    const float v = fy * fy * (3 - 2 * fy);
    const float low = mix(hash_uniform(ix, iy, seed), hash_uniform(ix + 1, iy, seed), u);
    const float high = mix(hash_uniform(ix, iy + 1, seed), hash_uniform(ix + 1, iy + 1, seed), u);
    return 2 * mix(low, high, v) - 1;
}

// How much of a structure of the given period survives a box filter of the given width: 1 well
// below half a period, 0 from there on. Textures use it to fade what a pixel cannot hold.
inline float survives(float period, float filter_width) {
    return 1 - smoothstep(0.25F * period, 0.6F * period, filter_width);
}

// `octaves` octaves of value noise from `period` downwards, each half as strong as the last;
// octaves finer than the filter are left out. In about [-1, 1].
inline float fractal_noise(float x, float y, float period, int octaves, float filter_width,
                           int seed) {
    float sum = 0;
    float amplitude = 0.5F;
    for (int i = 0; i < octaves; ++i) {
        const float keep = survives(period, filter_width);
        if (keep <= 0) break;
        const float scale = 1 / period;
        // Offsets keep the lattices of the octaves from lining up.
        sum += keep * amplitude *
               value_noise(x * scale + 17.3F * static_cast<float>(i),
                           y * scale - 9.1F * static_cast<float>(i), seed + i);
        amplitude *= 0.5F;
        period *= 0.5F;
    }
    return sum;
}

// Mean over [x - width/2, x + width/2] of a function that is 1 on [0, on) of every period and 0
// on the rest: box-filtered stripes without aliasing.
inline float stripe_coverage(float x, float period, float on, float width) {
    const auto integral = [&](float v) {
        const float cells = std::floor(v / period);
        return cells * on + std::min(v - cells * period, on);
    };
    if (width < 1e-6F * period) return x - std::floor(x / period) * period < on ? 1.0F : 0.0F;
    return (integral(x + 0.5F * width) - integral(x - 0.5F * width)) / width;
}

// The same for a single interval [low, high).
inline float interval_coverage(float x, float low, float high, float width) {
    width = std::max(width, 1e-6F);
    return clamp01((std::min(x + 0.5F * width, high) - std::max(x - 0.5F * width, low)) / width);
}

}  // namespace aureole::scene
