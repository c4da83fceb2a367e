#include "ibl/texel_geometry.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/parallel.h"
#include "ibl/gauss_legendre.h"

namespace aureole::ibl {
namespace {

Direction local(double s, double t) { return normalized({s, t, 1}); }

}  // namespace

TexelShape texel_shape(double s, double t, double half_side) {
    static const GaussRule rule = gauss_legendre(4);
    const Direction middle = local(s, t);
    double sum[10] = {};  // 1, and of L - middle the coordinates and their products
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            const Direction d = local(s + half_side * rule.nodes[i], t + half_side * rule.nodes[j]);
            const double weight = rule.weights[i] * rule.weights[j] * d.z * d.z * d.z;
            const double x = d.x - middle.x;
            const double y = d.y - middle.y;
            const double z = d.z - middle.z;
            const double terms[10] = {1, x, y, z, x * x, y * y, z * z, x * y, x * z, y * z};
            for (int k = 0; k < 10; ++k) sum[k] += weight * terms[k];
        }
    }
    for (int k = 1; k < 10; ++k) sum[k] /= sum[0];
    const double* mean = sum + 1;
    TexelShape shape;
    shape.moments.mean[0] = static_cast<float>(middle.x + mean[0]);
    shape.moments.mean[1] = static_cast<float>(middle.y + mean[1]);
    shape.moments.mean[2] = static_cast<float>(middle.z + mean[2]);
    constexpr int kFirst[6] = {0, 1, 2, 0, 0, 1};
    constexpr int kSecond[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
        shape.moments.covariance[k] =
            static_cast<float>(sum[4 + k] - mean[kFirst[k]] * mean[kSecond[k]]);
    }
    const auto halve = [](const Direction& from, const Direction& to, float* half) {
        half[0] = static_cast<float>((to.x - from.x) / 2);
        half[1] = static_cast<float>((to.y - from.y) / 2);
        half[2] = static_cast<float>((to.z - from.z) / 2);
    };
    halve(local(s - half_side, t), local(s + half_side, t), shape.spread.along_s);
    halve(local(s, t - half_side), local(s, t + half_side), shape.spread.along_t);
    return shape;
}

Cone cone_around(double s0, double t0, double s1, double t1) {
    Cone cone = {local((s0 + s1) / 2, (t0 + t1) / 2)};
    for (const double s : {s0, s1}) {
        for (const double t : {t0, t1}) {
            const double cosine = std::min(1.0, dot(cone.axis, local(s, t)));
            cone.radius = std::max(cone.radius, std::acos(cosine));
        }
    }
    return cone;
}

FaceFrame face_frame(int face) {
    const Direction axis = direction_of({face, 0, 0});
    // direction_of(1, 0) is (along_s + axis) / sqrt(2).
    const auto edge = [&](double s, double t) {
        const Direction d = direction_of({face, s, t});
        const double root = std::sqrt(2.0);
        return Direction{std::round(d.x * root - axis.x), std::round(d.y * root - axis.y),
                         std::round(d.z * root - axis.z)};
    };
    return {edge(1, 0), edge(0, 1), axis};
}

TexelGeometry::TexelGeometry(int size_) : size(size_), blocks(tile_count(size_) / kFaces) {
    const auto block_count = static_cast<std::size_t>(blocks);
    solid_angle_sr.resize(block_count * kTileTexels);
    moments.resize(block_count * kTileTexels);
    spreads.resize(block_count * kTileTexels);
    block_centre.resize(block_count);
    std::vector<double> radius(block_count);
    parallel_for(block_count, [&](std::size_t block, int) {
        const Tile tile = tile_at(static_cast<int>(block), size);
        const auto coordinate = [&](double texels) { return 2 * texels / size - 1; };
        for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) {
                const std::size_t at =
                    block * kTileTexels + static_cast<std::size_t>(y * tile.width + x);
                solid_angle_sr[at] = texel_solid_angle_sr(tile.x + x, tile.y + y, size);
                const TexelShape shape = texel_shape(coordinate(tile.x + x + .5),
                                                     coordinate(tile.y + y + .5), 1.0 / size);
                moments[at] = shape.moments;
                spreads[at] = shape.spread;
            }
        }
        const Cone cone =
            cone_around(coordinate(tile.x), coordinate(tile.y), coordinate(tile.x + tile.width),
                        coordinate(tile.y + tile.height));
        block_centre[block] = cone.axis;
        radius[block] = cone.radius;
    });
    block_radius = *std::max_element(radius.begin(), radius.end());
}

}  // namespace aureole::ibl
