// Three floats: positions in metres (x right, y up, z ahead of the camera), directions, and colours
// in cd/m2 of linear sRGB.
#pragma once

#include <algorithm>
#include <cmath>

namespace aureole::scene {

struct Vec3 {
    float x = 0;
    float y = 0;
    float z = 0;

    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
    Vec3& operator+=(Vec3 b) { return *this = *this + b; }
    Vec3& operator*=(float s) { return *this = *this * s; }
};

constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(Vec3 v) { return std::sqrt(dot(v, v)); }
inline Vec3 normalize(Vec3 v) { return v * (1 / length(v)); }
constexpr Vec3 mix(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
constexpr float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float clamp01(float v) { return std::clamp(v, 0.0F, 1.0F); }
inline float smoothstep(float low, float high, float v) {
    const float t = clamp01((v - low) / (high - low));
    return t * t * (3 - 2 * t);
}
inline float square(float v) { return v * v; }

struct Ray {
    Vec3 origin;
    Vec3 direction;  // not necessarily of unit length
    Vec3 at(float t) const { return origin + direction * t; }
};

// The colour scaled so that its luminance is 1.
constexpr Vec3 unit_luminance(Vec3 rgb) {
    return rgb * (1 / (0.2126F * rgb.x + 0.7152F * rgb.y + 0.0722F * rgb.z));
}
constexpr float luminance(Vec3 rgb) { return 0.2126F * rgb.x + 0.7152F * rgb.y + 0.0722F * rgb.z; }

}  // namespace aureole::scene
