#include "aureole/ibl/cube_map.h"

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

constexpr int kLargestSize = 16384;

// Solid angle of the rectangle from the middle of a face to (s, t), signed; the integral of
// (1 + s^2 + t^2)^(-3/2).
double corner_solid_angle_sr(double s, double t) {
    return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
}

double edge(int index, int size) { return 2.0 * index / size - 1; }

}  // namespace

Direction normalized(const Direction& d) {
    const double scale = 1 / std::sqrt(dot(d, d));
    return {d.x * scale, d.y * scale, d.z * scale};
}

Direction direction_of(const CubePoint& point) {
    const double s = point.s;
    const double t = point.t;
    switch (point.face) {
        case 0:
            return normalized({1, -t, -s});
        case 1:
            return normalized({-1, -t, s});
        case 2:
            return normalized({s, 1, t});
        case 3:
            return normalized({s, -1, -t});
        case 4:
            return normalized({s, -t, 1});
        default:
            return normalized({-s, -t, -1});
    }
}

CubePoint cube_point_of(const Direction& direction) {
    const auto [x, y, z] = direction;
    const double ax = std::abs(x);
    const double ay = std::abs(y);
    const double az = std::abs(z);
    if (ax >= ay && ax >= az) {
        return x > 0 ? CubePoint{0, -z / ax, -y / ax} : CubePoint{1, z / ax, -y / ax};
    }
    if (ay >= az) return y > 0 ? CubePoint{2, x / ay, z / ay} : CubePoint{3, x / ay, -z / ay};
    return z > 0 ? CubePoint{4, x / az, -y / az} : CubePoint{5, -x / az, -y / az};
}

Direction texel_direction(int face, double x, double y, int size) {
    return direction_of({face, (2 * x + 1) / size - 1, (2 * y + 1) / size - 1});
}

double texel_solid_angle_sr(int x, int y, int size) {
    const double s0 = edge(x, size);
    const double s1 = edge(x + 1, size);
    const double t0 = edge(y, size);
    const double t1 = edge(y + 1, size);
    return corner_solid_angle_sr(s1, t1) - corner_solid_angle_sr(s0, t1) -
           corner_solid_angle_sr(s1, t0) + corner_solid_angle_sr(s0, t0);
}

CubeMap::CubeMap(int size) : size_(size) {
    if (size < 1 || size > kLargestSize) {
        throw InvalidArgument(
            "size", std::to_string(size),
            "a cube map has 1 to " + std::to_string(kLargestSize) + " texels per side");
    }
    pixels_ = Image(size, kFaces * size, 3);
}

ImageView CubeMap::face(int face) noexcept {
    ImageView view = pixels_.view();
    view.data = row(face, 0, 0);
    view.height = size_;
    return view;
}

ConstImageView CubeMap::face(int face) const noexcept {
    ConstImageView view = pixels_.view();
    view.data = row(face, 0, 0);
    view.height = size_;
    return view;
}

std::array<double, 3> mean_radiance(const CubeMap& map) {
    std::array<double, 3> sum = {};
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < map.size(); ++y) {
            for (int x = 0; x < map.size(); ++x) {
                const double weight = texel_solid_angle_sr(x, y, map.size());
                for (int c = 0; c < 3; ++c) {
                    sum[static_cast<std::size_t>(c)] += weight * map.at(face, x, y, c);
                }
            }
        }
    }
    for (double& channel : sum) channel /= 4 * kPi;
    return sum;
}

}  // namespace aureole::ibl
