#include "aureole/ibl/layout.h"

#include <algorithm>
#include <string>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"

namespace aureole::ibl {
namespace {

struct Shape {
    Layout layout;
    int columns;
    int rows;
    std::array<FacePlace, kFaces> places;  // +X -X +Y -Y +Z -Z
};

constexpr Shape kShapes[] = {
    {Layout::kHorizontalCross, 4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}},
    {Layout::kVerticalCross, 3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}}}},
    {Layout::kHorizontalStrip, 6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}},
    {Layout::kVerticalStrip, 1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}},
};

std::string name_of(Layout layout) {
    return std::string(kLayoutNames[static_cast<std::size_t>(layout)]);
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

bool has_aspect(int width, int height, int columns, int rows) {
    return width > 0 && height > 0 && width % columns == 0 && height % rows == 0 &&
           width / columns == height / rows;
}

const Shape& shape_of(Layout layout) {
    for (const Shape& shape : kShapes) {
        if (shape.layout == layout) return shape;
    }
    throw InvalidArgument("layout", name_of(layout), "must be a cross or a strip");
}

// Copies a face between its place in a picture and its own rows, turned or not.
template <class Copy>
void for_each_row(const FacePlace& place, int size, const Copy& copy) {
    for (int y = 0; y < size; ++y) {
        const int row = place.turned ? size - 1 - y : y;
        copy(y, place.column * size, place.row * size + row);
    }
}

void check_channels(const ConstImageView& picture) {
    if (picture.channels != 3) {
        throw InvalidArgument("channels", std::to_string(picture.channels), "must be 3");
    }
}

}  // namespace

Layout layout_from_size(int width, int height) {
    if (has_aspect(width, height, 2, 1)) return Layout::kLatLong;
    for (const Shape& shape : kShapes) {
        if (has_aspect(width, height, shape.columns, shape.rows)) return shape.layout;
    }
    throw InvalidArgument(
        "environment", size_text(width, height),
        "width to height must be 2:1 (lat-long), 4:3 (horizontal cross), 3:4 (vertical cross), "
        "6:1 or 1:6 (strips), with whole faces; single square faces are given as six pictures");
}

void check_layout(Layout layout, int width, int height) {
    if (layout == Layout::kSixFaces) {
        if (has_aspect(width, height, 1, 1)) return;
        throw InvalidArgument("face", size_text(width, height), "must be square");
    }
    const bool flat = layout == Layout::kLatLong;
    const int columns = flat ? 2 : shape_of(layout).columns;
    const int rows = flat ? 1 : shape_of(layout).rows;
    if (has_aspect(width, height, columns, rows)) return;
    const std::string aspect = std::to_string(columns) + ":" + std::to_string(rows);
    throw InvalidArgument("environment", size_text(width, height),
                          "the layout " + name_of(layout) + " has width to height " + aspect +
                              (flat ? ""
                                    : ", a multiple of " + std::to_string(columns) + " to one of " +
                                          std::to_string(rows)));
}

FacePlace face_place(Layout layout, int face) {
    return shape_of(layout).places[static_cast<std::size_t>(face)];
}

CubeMap cube_from_layout(const ConstImageView& picture, Layout layout) {
    const Shape& shape = shape_of(layout);
    check_layout(layout, picture.width, picture.height);
    check_channels(picture);
    const int size = picture.width / shape.columns;
    CubeMap map(size);
    parallel_for(kFaces, [&](std::size_t index, int) {
        const int face = static_cast<int>(index);
        const FacePlace place = shape.places[index];
        for_each_row(place, size, [&](int y, int x0, int row) {
            for (int c = 0; c < 3; ++c) {
                float* to = map.row(face, y, c);
                for (int x = 0; x < size; ++x) to[x] = picture.at(x0 + x, row, c);
                if (place.turned) std::reverse(to, to + size);
            }
        });
    });
    return map;
}

Image layout_from_cube(const CubeMap& map, Layout layout) {
    const Shape& shape = shape_of(layout);
    if (map.empty()) throw InvalidArgument("map", "empty", "must have texels");
    const int size = map.size();
    Image picture(size * shape.columns, size * shape.rows, 3);
    parallel_for(kFaces, [&](std::size_t index, int) {
        const int face = static_cast<int>(index);
        const FacePlace place = shape.places[index];
        for_each_row(place, size, [&](int y, int x0, int row) {
            for (int c = 0; c < 3; ++c) {
                float* to = picture.row(row, c) + x0;
                std::copy_n(map.row(face, y, c), size, to);
                if (place.turned) std::reverse(to, to + size);
            }
        });
    });
    return picture;
}

CubeMap cube_from_faces(const std::array<ConstImageView, kFaces>& faces) {
    const int size = faces[0].width;
    for (std::size_t i = 0; i < kFaces; ++i) {
        const ConstImageView& face = faces[i];
        check_layout(Layout::kSixFaces, face.width, face.height);
        check_channels(face);
        if (face.width != size) {
            throw InvalidArgument("face " + std::string(kFaceNames[i]),
                                  size_text(face.width, face.height),
                                  "must have the size of +X, " + size_text(size, size));
        }
    }
    CubeMap map(size);
    parallel_for(kFaces, [&](std::size_t i, int) {
        const ImageView to = map.face(static_cast<int>(i));
        for (int c = 0; c < 3; ++c) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) to.at(x, y, c) = faces[i].at(x, y, c);
            }
        }
    });
    return map;
}

}  // namespace aureole::ibl
