#include "ibl/shrink.h"

#include <gtest/gtest.h>

#include "aureole/base/random.h"

namespace aureole::ibl {
namespace {

CubeMap shrunk(const CubeMap& environment, int size) {
    CubeMap out(size);
    for (int i = 0; i < tile_count(size); ++i) shrink_tile(environment, tile_at(i, size), out);
    return out;
}

TEST(Shrink, KeepsAConstantAndTheMean) {
    for (const int source : {1, 7, 16, 40}) {
        CubeMap map(source);
        Random random(3);
        for (int face = 0; face < kFaces; ++face) {
            for (int y = 0; y < source; ++y) {
                for (int x = 0; x < source; ++x) {
                    map.at(face, x, y, 0) = 3;
                    map.at(face, x, y, 1) = static_cast<float>(random.uniform(0, 10));
                }
            }
        }
        for (int size = 1; size <= source; ++size) {
            const CubeMap small = shrunk(map, size);
            for (int face = 0; face < kFaces; ++face) {
                for (int y = 0; y < size; ++y) {
                    for (int x = 0; x < size; ++x) EXPECT_FLOAT_EQ(small.at(face, x, y, 0), 3);
                }
            }
            // Texels that are cut keep their mean density on both sides: exact for whole ratios.
            const double tolerance = source % size == 0 ? 1e-6 : 1e-2;
            EXPECT_NEAR(mean_radiance(small)[1] / mean_radiance(map)[1], 1, tolerance)
                << source << " to " << size;
        }
    }
}

TEST(Shrink, SameSizeIsACopy) {
    CubeMap map(9);
    Random random(4);
    for (int y = 0; y < 9; ++y) map.at(2, y, 8 - y, 2) = static_cast<float>(random.uniform());
    const CubeMap copy = shrunk(map, 9);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x) EXPECT_EQ(copy.at(2, x, y, 2), map.at(2, x, y, 2));
    }
}

}  // namespace
}  // namespace aureole::ibl
