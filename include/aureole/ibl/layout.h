// Cube maps as one picture: where each face lies in crosses and strips.
//
// With the faces of cube_map.h, s to the right and t downwards, as pictures:
//
//     horizontal cross, 4:3      vertical cross, 3:4     strips, 6:1 and 1:6
//
//           +Y                        +Y                  +X -X +Y -Y +Z -Z
//        -X +Z +X -Z               -X +Z +X
//           -Y                        -Y                  from left to right, or from the top
//                                     -Z  (turned by 180 deg)
//
// Neighbours in a cross are neighbours on the cube, and the picture is continuous where they meet:
// that is why -Z of the vertical cross, which joins -Y at its lower edge, stands on its head.
#pragma once

#include <array>
#include <string_view>

#include "aureole/ibl/cube_map.h"
#include "aureole/image/image.h"

namespace aureole::ibl {

enum class Layout {
    kLatLong,  // 2:1; see lat_long.h
    kHorizontalCross,
    kVerticalCross,
    kHorizontalStrip,
    kVerticalStrip,
    kSixFaces,  // one square picture each
};

// The names of the command line, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> kLayoutNames = {
    "lat-long",         "horizontal-cross", "vertical-cross",
    "horizontal-strip", "vertical-strip",   "faces"};

// The layout of one picture of that size. Throws InvalidArgument when it has the shape of none.
Layout layout_from_size(int width, int height);

// Throws InvalidArgument unless a picture of that size can have `layout`.
void check_layout(Layout layout, int width, int height);

// Where a face lies, in units of faces from the top left corner of the picture.
struct FacePlace {
    int column = 0;
    int row = 0;
    bool turned = false;  // by 180 deg
};

// Of crosses and strips. Throws InvalidArgument for the other layouts.
FacePlace face_place(Layout layout, int face);

// Bit for bit. The picture has 3 channels. Throws InvalidArgument for a picture of another shape
// (check_layout), and for kLatLong, which needs a size (cube_from_lat_long), and kSixFaces.
CubeMap cube_from_layout(const ConstImageView& picture, Layout layout);
// The inverse; the rest of a cross is 0.
Image layout_from_cube(const CubeMap& map, Layout layout);

// Faces in the order of kFaceNames, 3 channels. Throws InvalidArgument unless all are square and of
// one size. Back: CubeMap::face().
CubeMap cube_from_faces(const std::array<ConstImageView, kFaces>& faces);

}  // namespace aureole::ibl
