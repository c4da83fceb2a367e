// Environments as latitude-longitude pictures: from them to cube maps, and back.
//
// Convention: that of OpenEXR's environment maps (ImfEnvmap.h, "LATLONG"). +Y is up; the top row is
// about +Y; longitude falls from +pi at the left edge to -pi at the right one; 0 is +Z, in the
// middle, and +pi/2 is +X, a quarter from the left:
//
//     longitude = pi - 2 pi u / width     latitude = pi / 2 - pi v / height
//     direction = (sin(longitude) cos(latitude), sin(latitude), cos(longitude) cos(latitude))
//
// Pixel (x, y) covers [x, x + 1) x [y, y + 1) of (u, v). (The functions of OpenEXR itself put the
// centres of the outermost pixels on the poles and on the seam, so that both ends of a row are the
// same meridian; pictures that people have are not like that.)
#pragma once

#include <array>
#include <memory>

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/environment_transform.h"
#include "aureole/image/image.h"

namespace aureole::ibl {

// A place in a picture of width x height, continuous as (u, v) above.
struct LatLongPoint {
    double u = 0;
    double v = 0;
};

Direction direction_of(const LatLongPoint& point, int width, int height);
// u in [0, width], v in [0, height]; for any vector that is not zero.
LatLongPoint lat_long_point_of(const Direction& direction, int width, int height);
// Solid angle of any pixel of row y, sr; exact. All rows times width sum to 4 pi.
double lat_long_solid_angle_sr(int y, int width, int height);

// Resampling to a cube map, a few rows at a time. Each texel of the cube is the exact mean, over
// its solid angle, of the picture interpolated linearly between pixels, so that
// - a constant stays that constant to 1e-6, and the energy of anything, of a single pixel too, is
//   kept to 1e-5, wherever it lies;
// - nothing aliases when the cube is smaller, nothing is blocky when it is larger;
// - there are no seams at edges of the cube, at the meridian where the picture ends, or at the
//   poles.
// docs/environment_maps.md derives it. Memory: 16 bytes per texel of the cube, and some 10 MB. The
// same bits for any number of threads, and however rows are grouped.
class LatLongToCube {
  public:
    // Throws InvalidArgument unless width and height are in [1, 65536] and cube_size in [1, 16384],
    // and for a transform out of range.
    LatLongToCube(int width, int height, int cube_size, const EnvironmentTransform& transform = {});
    ~LatLongToCube();
    LatLongToCube(LatLongToCube&&) noexcept;
    LatLongToCube& operator=(LatLongToCube&&) noexcept;

    // The rows from `first_row` on, which must be those after the last ones, from the top; 3
    // channels. Not kept after the call. Throws InvalidArgument for anything else.
    void add_rows(int first_row, const ConstImageView& rows);

    // After all rows, once. Throws InvalidArgument when rows are missing.
    CubeMap finish();

    // Of the rows that were added.
    const EnvironmentReport& report() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The same for a whole picture in memory.
CubeMap cube_from_lat_long(const ConstImageView& picture, int cube_size,
                           const EnvironmentTransform& transform = {},
                           EnvironmentReport* report = nullptr);

// A picture of width x width / 2 pixels: each the mean over its solid angle of the map interpolated
// as in CubeSampler, by samples a third of a texel apart. Constants stay constant; the energy of a
// single bright texel changes by .4 % (root mean square; 2 % at most). Throws InvalidArgument
// unless width is even and in [2, 65536], and for an empty map.
Image lat_long_from_cube(const CubeMap& map, int width);

}  // namespace aureole::ibl
