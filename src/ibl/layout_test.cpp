#include "aureole/ibl/layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "aureole/base/error.h"
#include "aureole/ibl/lat_long.h"
#include "ibl/labelled_cube.h"

namespace aureole::ibl {
namespace {

constexpr Layout kOnePicture[] = {Layout::kHorizontalCross, Layout::kVerticalCross,
                                  Layout::kHorizontalStrip, Layout::kVerticalStrip};

bool identical(const CubeMap& a, const CubeMap& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < 3 * a.stacked().pixels(); ++i) {
        if (a.stacked().plane(0)[i] != b.stacked().plane(0)[i]) return false;
    }
    return true;
}

std::string message_of(int width, int height) {
    try {
        layout_from_size(width, height);
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "";
}

TEST(Layout, IsKnownFromTheShape) {
    EXPECT_EQ(layout_from_size(2048, 1024), Layout::kLatLong);
    EXPECT_EQ(layout_from_size(400, 300), Layout::kHorizontalCross);
    EXPECT_EQ(layout_from_size(300, 400), Layout::kVerticalCross);
    EXPECT_EQ(layout_from_size(600, 100), Layout::kHorizontalStrip);
    EXPECT_EQ(layout_from_size(1, 6), Layout::kVerticalStrip);
}

TEST(Layout, OtherShapesAreRefusedWithWhatIsAllowed) {
    for (const auto& [width, height] :
         {std::pair{1920, 1080}, {2048, 1023}, {100, 100}, {401, 300}, {0, 0}}) {
        EXPECT_NE(message_of(width, height).find(std::to_string(width) + " x "), std::string::npos);
        EXPECT_NE(message_of(width, height).find("2:1 (lat-long), 4:3"), std::string::npos);
    }
    EXPECT_THROW(check_layout(Layout::kLatLong, 400, 300), InvalidArgument);
    EXPECT_THROW(check_layout(Layout::kHorizontalCross, 300, 400), InvalidArgument);
    EXPECT_THROW(check_layout(Layout::kVerticalStrip, 10, 61), InvalidArgument);
    EXPECT_THROW(check_layout(Layout::kSixFaces, 10, 11), InvalidArgument);
    EXPECT_NO_THROW(check_layout(Layout::kVerticalCross, 300, 400));
    const Image grey(4, 3, 1);
    EXPECT_THROW(cube_from_layout(grey, Layout::kHorizontalCross), InvalidArgument);
    const Image flat(4, 2, 3);
    EXPECT_THROW(cube_from_layout(flat, Layout::kLatLong), InvalidArgument);
    EXPECT_THROW(cube_from_layout(flat, Layout::kSixFaces), InvalidArgument);
}

TEST(Layout, ThereAndBackIsTheSameToTheBit) {
    const CubeMap map = labelled_cube(6);
    for (const Layout layout : kOnePicture) {
        const Image picture = layout_from_cube(map, layout);
        EXPECT_EQ(layout_from_size(picture.width(), picture.height()), layout);
        EXPECT_TRUE(identical(cube_from_layout(picture, layout), map));
    }
    std::array<ConstImageView, kFaces> faces;
    for (int i = 0; i < kFaces; ++i) faces[static_cast<std::size_t>(i)] = map.face(i);
    EXPECT_TRUE(identical(cube_from_faces(faces), map));
}

// The direction of each pixel, by the convention of cube_map.h, changes by no more than a texel
// from pixel to pixel within a cross, across the borders of faces too.
TEST(Layout, CrossesAreContinuous) {
    constexpr int kSize = 8;
    CubeMap directions(kSize);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const Direction d = texel_direction(face, x, y, kSize);
                directions.at(face, x, y, 0) = static_cast<float>(d.x);
                directions.at(face, x, y, 1) = static_cast<float>(d.y);
                directions.at(face, x, y, 2) = static_cast<float>(d.z);
            }
        }
    }
    for (const Layout layout : {Layout::kHorizontalCross, Layout::kVerticalCross}) {
        const Image picture = layout_from_cube(directions, layout);
        const auto at = [&](int x, int y) {
            return Direction{picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)};
        };
        int pairs = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                for (const auto& [u, v] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
                    if (u >= picture.width() || v >= picture.height()) continue;
                    const Direction a = at(x, y);
                    const Direction b = at(u, v);
                    if (dot(a, a) == 0 || dot(b, b) == 0) continue;
                    EXPECT_GT(dot(a, b), std::cos(2.01 / kSize)) << x << " " << y;
                    ++pairs;
                }
            }
        }
        // Inside faces, and five borders.
        EXPECT_EQ(pairs, kFaces * 2 * kSize * (kSize - 1) + 5 * kSize);
    }
}

// With the first row of +Y, the picture starts at its top left corner: known by hand.
TEST(Layout, FacesLieWhereTheHeaderDrawsThem) {
    const CubeMap map = labelled_cube(2);
    const Image across = layout_from_cube(map, Layout::kHorizontalCross);
    const float row[] = {2, 2, 5, 5, 1, 1, 6, 6};
    for (int x = 0; x < 8; ++x) EXPECT_EQ(across.at(x, 2, 0), row[x]);
    EXPECT_EQ(across.at(2, 0, 0), 3);
    EXPECT_EQ(across.at(2, 0, 1), 1);
    EXPECT_EQ(across.at(2, 5, 0), 4);
    const Image down = layout_from_cube(map, Layout::kVerticalCross);
    EXPECT_EQ(down.at(2, 7, 0), 6);
    EXPECT_EQ(down.at(2, 7, 1), 2) << "its upper right quarter, as it stands on its head";
    EXPECT_EQ(layout_from_cube(map, Layout::kVerticalStrip).at(0, 6, 0), 4);
}

TEST(Layout, UnequalFacesAreRefusedByName) {
    const Image large(4, 4, 3);
    const Image small(3, 3, 3);
    const Image oblong(4, 3, 3);
    std::array<ConstImageView, kFaces> faces;
    faces.fill(large);
    EXPECT_NO_THROW(cube_from_faces(faces));
    faces[3] = small;
    try {
        cube_from_faces(faces);
        FAIL();
    } catch (const InvalidArgument& error) {
        EXPECT_NE(std::string(error.what()).find("face -Y = 3 x 3"), std::string::npos);
    }
    faces[3] = oblong;
    EXPECT_THROW(cube_from_faces(faces), InvalidArgument);
}

}  // namespace
}  // namespace aureole::ibl
