// Cube maps: where their texels lie on the sphere, and how much of it each covers.
//
// Convention (OpenGL 4.6 specification, section 8.13, table 8.19; the same in Vulkan, Direct3D, DDS
// and KTX): faces in the order +X -X +Y -Y +Z -Z; within a face s runs to the right and t
// downwards, both over [-1, 1], texel (x, y) of a face of n x n texels has its centre at s = (2x +
// 1) / n - 1, t = (2y + 1) / n - 1, and looks in the direction
//
//     +X ( 1, -t, -s)   -X (-1, -t,  s)   +Y ( s,  1,  t)   -Y ( s, -1, -t)   +Z ( s, -t,  1)
//     -Z (-s, -t, -1)
//
// before it is normalised. +Y is up. In a world whose axes are right-handed a face looks mirrored
// when seen as a picture: that is the convention, not a fault; see docs/environment_maps.md.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::ibl {

inline constexpr int kFaces = 6;
inline constexpr std::array<std::string_view, kFaces> kFaceNames = {"+X", "-X", "+Y",
                                                                    "-Y", "+Z", "-Z"};

struct Direction {
    double x = 0;
    double y = 0;
    double z = 0;
};

constexpr double dot(const Direction& a, const Direction& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
// Of any vector that is not zero.
Direction normalized(const Direction& d);

// A place on a cube: s and t in [-1, 1], as above.
struct CubePoint {
    int face = 0;
    double s = 0;
    double t = 0;
};

// Unit vector. s and t may lie beyond the face: the point is then on the plane of that face.
Direction direction_of(const CubePoint& point);
// The inverse, for any vector that is not zero; on an edge the face whose axis comes first.
CubePoint cube_point_of(const Direction& direction);

// Centre of texel (x, y) of a face of `size` x `size` texels.
Direction texel_direction(int face, double x, double y, int size);
// Solid angle of texel (x, y) of any face, sr; exact. All texels of all faces sum to 4 pi.
double texel_solid_angle_sr(int x, int y, int size);

// Six square faces of linear RGB radiance. Copy and move as a value.
class CubeMap {
  public:
    CubeMap() = default;
    // All zero. Throws InvalidArgument unless size is in [1, 16384].
    explicit CubeMap(int size);

    int size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }

    // Planar; 3 channels.
    ImageView face(int face) noexcept;
    ConstImageView face(int face) const noexcept;
    float* row(int face, int y, int channel) noexcept {
        return pixels_.row(face * size_ + y, channel);
    }
    const float* row(int face, int y, int channel) const noexcept {
        return pixels_.row(face * size_ + y, channel);
    }
    float& at(int face, int x, int y, int channel) noexcept { return row(face, y, channel)[x]; }
    float at(int face, int x, int y, int channel) const noexcept {
        return row(face, y, channel)[x];
    }

    // All faces below one another, the first on top: size x 6 size pixels, 3 channels.
    Image& stacked() noexcept { return pixels_; }
    const Image& stacked() const noexcept { return pixels_; }

  private:
    int size_ = 0;
    Image pixels_;
};

// The levels of a texture, the largest first; level k has max(1, size >> k) texels per side.
using CubeChain = std::vector<CubeMap>;

// Mean radiance over the sphere, each texel weighted by its solid angle.
std::array<double, 3> mean_radiance(const CubeMap& map);

}  // namespace aureole::ibl
