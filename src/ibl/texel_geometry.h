// The texels of one face of a cube map, in the frame of that face: what sums over all texels need
// to know about each. The six faces are alike.
//
// Blocks of 8 x 8 texels lie together (tile.h), each with room for 64 of them.
#pragma once

#include <array>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "ibl/exact_kernels.h"
#include "ibl/tile.h"

namespace aureole::ibl {

// Unit vectors of a face's frame: a point (s, t) of it is in the direction s along_s + t along_t +
// axis.
struct FaceFrame {
    Direction along_s;
    Direction along_t;
    Direction axis;
};
FaceFrame face_frame(int face);

constexpr Direction in_frame(const FaceFrame& frame, const Direction& d) {
    return {dot(d, frame.along_s), dot(d, frame.along_t), dot(d, frame.axis)};
}
constexpr Direction from_frame(const FaceFrame& frame, const Direction& d) {
    return {d.x * frame.along_s.x + d.y * frame.along_t.x + d.z * frame.axis.x,
            d.x * frame.along_s.y + d.y * frame.along_t.y + d.z * frame.axis.y,
            d.x * frame.along_s.z + d.y * frame.along_t.z + d.z * frame.axis.z};
}

// Of the texel with its middle at (s, t) and sides of 2 half_side, in the frame of its face: the
// mean of the unit vectors over it and their covariance, and how far they spread.
struct TexelShape {
    TexelMoments moments;
    TexelSpread spread;
};
TexelShape texel_shape(double s, double t, double half_side);

// A cone around everything between two corners of a face, in the frame of the face.
struct Cone {
    Direction axis;
    double radius = 0;  // rad
};
Cone cone_around(double s0, double t0, double s1, double t1);

struct TexelGeometry {
    explicit TexelGeometry(int size);

    int size = 0;
    int blocks = 0;  // of a face
    // Per texel, 64 for each block.
    std::vector<double> solid_angle_sr;
    std::vector<TexelMoments> moments;
    std::vector<TexelSpread> spreads;
    // Per block.
    std::vector<Direction> block_centre;
    double block_radius = 0;  // rad, of the largest
};

}  // namespace aureole::ibl
