// Procedural environments for tests and benchmarks of this module: one for each thing that breaks
// a filter. Texels hold the radiance at their centres; all maps are the same picture at any size,
// and all but corner_texel_environment() have a mean of the order of 1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

using Radiance = std::array<float, 3>;

// Fills every texel with radiance(direction of its centre).
template <class RadianceOf>
CubeMap make_environment(int size, const RadianceOf& radiance) {
    CubeMap map(size);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const Radiance value = radiance(texel_direction(face, x, y, size));
                for (int c = 0; c < 3; ++c) {
                    map.at(face, x, y, c) = value[static_cast<std::size_t>(c)];
                }
            }
        }
    }
    return map;
}

inline Radiance scaled(const Radiance& color, double factor) {
    const auto f = static_cast<float>(factor);
    return {color[0] * f, color[1] * f, color[2] * f};
}

inline Radiance sum(const Radiance& a, const Radiance& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline void set_texel(CubeMap& map, int face, int x, int y, const Radiance& value) {
    for (int c = 0; c < 3; ++c) map.at(face, x, y, c) = value[static_cast<std::size_t>(c)];
}

// The texel that contains a direction: face, x, y.
inline std::array<int, 3> texel_of(const Direction& direction, int size) {
    const CubePoint point = cube_point_of(direction);
    const auto index = [size](double coordinate) {
        return std::clamp(static_cast<int>((coordinate + 1) / 2 * size), 0, size - 1);
    };
    return {point.face, index(point.s), index(point.t)};
}

inline CubeMap constant_environment(int size, const Radiance& value = {1, 1, 1}) {
    return make_environment(size, [&](const Direction&) { return value; });
}

// All black but for one texel.
inline CubeMap one_texel_environment(int size, int face, int x, int y, const Radiance& value) {
    CubeMap map(size);
    set_texel(map, face, x, y, value);
    return map;
}

// A dim gradient, and 2e6 in a texel at the corner of three faces.
inline CubeMap corner_texel_environment(int size) {
    CubeMap map = make_environment(size, [](const Direction& d) {
        return Radiance{static_cast<float>(0.02 + 0.01 * d.y), 0.02F,
                        static_cast<float>(0.02 + 0.005 * d.x)};
    });
    set_texel(map, 0, 0, 0, {2e6F, 2e6F, 2e6F});
    return map;
}

// Smooth: the overcast sky of CIE S 011 (Moon & Spencer 1942), three times as bright at the zenith
// as at the horizon, over a dull ground that the horizon blends into.
inline CubeMap overcast_environment(int size) {
    return make_environment(size, [](const Direction& d) {
        const double sky = 1.5 * (1 + 2 * std::max(d.y, 0.0)) / 3;
        const double ground = 0.15 * (1 + 0.3 * d.x);
        const double blend = 0.5 + 0.5 * std::tanh(8 * d.y);
        return sum(scaled({0.95F, 1.0F, 1.08F}, sky * blend),
                   scaled({1.1F, 1.0F, 0.85F}, ground * (1 - blend)));
    });
}

// A rectangle of light that faces the middle: half sizes are tangents of angles.
struct Softbox {
    Direction axis;
    double half_width = 0;
    double half_height = 0;
    Radiance value = {};
};

inline bool is_in(const Softbox& box, const Direction& d) {
    const Direction axis = normalized(box.axis);
    const Direction right = normalized({axis.z, 0, -axis.x});
    const Direction up = {axis.y * right.z - axis.z * right.y, axis.z * right.x - axis.x * right.z,
                          axis.x * right.y - axis.y * right.x};
    const double along = dot(axis, d);
    return along > 0 && std::abs(dot(right, d)) < box.half_width * along &&
           std::abs(dot(up, d)) < box.half_height * along;
}

// Softboxes in a dark room: hard edges, and a strip a few texels wide.
inline CubeMap studio_environment(int size) {
    const std::array boxes = {Softbox{{1, 0.8, 0.6}, 0.35, 0.25, {14, 13, 12}},
                              Softbox{{-1, 0.3, 0.4}, 0.12, 0.6, {7, 8, 9}},
                              Softbox{{0.3, 0.1, -1}, 0.015, 0.8, {40, 40, 44}},
                              Softbox{{0.2, 1.4, -0.3}, 0.03, 0.03, {220, 200, 160}}};
    return make_environment(size, [&](const Direction& d) {
        for (const Softbox& box : boxes) {
            if (is_in(box, d)) return box.value;
        }
        return scaled({1.0F, 0.95F, 0.9F}, 0.02 + 0.01 * d.y);
    });
}

// A room with checkered, unevenly lit walls, four ceiling lights of 150 times their brightness and
// a window.
inline CubeMap interior_environment(int size) {
    return make_environment(size, [](const Direction& d) {
        // Seen from (0.4, -0.2, 0.3) in a box of 3 x 1.4 x 4.
        const double tx = (std::copysign(3.0, d.x) - 0.4) / d.x;
        const double ty = (std::copysign(1.4, d.y) + 0.2) / d.y;
        const double tz = (std::copysign(4.0, d.z) - 0.3) / d.z;
        const double t = std::min({tx, ty, tz});
        const double x = 0.4 + t * d.x;
        const double y = -0.2 + t * d.y;
        const double z = 0.3 + t * d.z;
        if (t == ty && d.y > 0 && std::abs(std::abs(x) - 1.4) < 0.3 &&
            std::abs(std::abs(z) - 1.8) < 0.6) {
            return Radiance{16, 15, 13};
        }
        if (t == tx && d.x < 0 && std::abs(y - 0.2) < 0.6 && std::abs(z) < 1) {
            return Radiance{5, 6, 7.5F};
        }
        const double pattern =
            std::sin(5.3 * x) * std::sin(4.7 * y) * std::sin(5.9 * z) > 0 ? 1 : 0.3;
        const double light = 0.05 + 0.15 / (1 + x * x + (1.4 - y) * (1.4 - y));
        return scaled({1.05F, 0.95F, 0.8F}, pattern * light);
    });
}

// A clear sky over textured ground, with all of the sun in one texel: its energy is the same at
// every size, and its radiance at 256 texels per side 200,000 times the mean.
inline CubeMap sun_environment(int size) {
    const Direction sun = normalized({0.45, 0.62, -0.71});
    CubeMap map = make_environment(size, [&](const Direction& d) {
        if (d.y < 0) {
            const double texture =
                std::sin(9 * d.x / (0.1 - d.y)) * std::sin(7 * d.z / (0.1 - d.y));
            return scaled({0.5F, 0.45F, 0.35F}, 0.25 + 0.1 * texture);
        }
        const double near = std::max(0.0, dot(d, sun));
        return sum(scaled({0.2F, 0.3F, 0.5F}, 1 - 0.5 * d.y),
                   scaled({1.0F, 0.95F, 0.85F}, 2 * std::pow(near, 200)));
    });
    const auto [face, x, y] = texel_of(sun, size);
    set_texel(map, face, x, y, scaled({1.0F, 0.93F, 0.85F}, 17 / texel_solid_angle_sr(x, y, size)));
    return map;
}

// A low, saturated red sun with a wide glow in a blue sky: luminance and color come from different
// places.
inline CubeMap red_sun_environment(int size) {
    const Direction sun = normalized({0.75, 0.12, -0.65});
    CubeMap map = make_environment(size, [&](const Direction& d) {
        const double near = std::max(0.0, dot(d, sun));
        if (d.y < 0) {
            return sum(scaled({0.05F, 0.08F, 0.12F}, 1 + 0.5 * std::sin(9 * d.x)),
                       scaled({1.0F, 0.2F, 0.02F}, 0.3 * std::pow(near, 20)));
        }
        return sum(scaled({0.05F, 0.2F, 0.8F}, 0.3 + 0.7 * d.y),
                   scaled({1.0F, 0.2F, 0.02F}, 6 * std::pow(near, 60)));
    });
    const auto [face, x, y] = texel_of(sun, size);
    set_texel(map, face, x, y, scaled({1.0F, 0.1F, 0.01F}, 3 / texel_solid_angle_sr(x, y, size)));
    return map;
}

// Saturated red and blue patches on green.
inline CubeMap patches_environment(int size) {
    return make_environment(size, [](const Direction& d) {
        const double pattern = std::sin(5 * d.x + 1) * std::sin(6 * d.y) * std::sin(7 * d.z + 2);
        if (pattern > 0.3) return Radiance{4, 0.02F, 0.05F};
        if (pattern < -0.3) return Radiance{0.02F, 0.05F, 6};
        return Radiance{0.1F, 0.6F, 0.1F};
    });
}

}  // namespace aureole::ibl
