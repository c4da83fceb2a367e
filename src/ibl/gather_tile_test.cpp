#include "ibl/gather_tile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aureole::ibl {
namespace {

TEST(GatherTile, InterpolatesCubicsExactly) {
    const auto points = Interpolation::points();
    EXPECT_EQ(points.front(), -1);
    EXPECT_EQ(points.back(), 1);
    const auto cubic = [](double u) { return 0.3 + u * (0.7 + u * (-1.1 + 0.4 * u)); };
    for (int outputs = 1; outputs <= kTileSide; ++outputs) {
        const Interpolation interpolation(outputs);
        for (int i = 0; i < outputs; ++i) {
            const double u = outputs == 1 ? 0 : 2.0 * i / (outputs - 1) - 1;
            double value = 0;
            for (std::size_t j = 0; j < points.size(); ++j) {
                value += static_cast<double>(interpolation.weight[i][j]) * cubic(points[j]);
            }
            EXPECT_NEAR(value, cubic(u), 1e-6);
        }
    }
}

// Every output of every tile, whole or cut by the edge of the face, is a point of its quarter, and
// inside the points of interpolation.
TEST(GatherTile, QuartersCoverTheOutputs) {
    for (const int size : {1, 3, 5, 8, 11, 20}) {
        for (int index = 0; index < tile_count(size); ++index) {
            const Tile tile = tile_at(index, size);
            const GatherTile gather = gather_tile(tile, size);
            const int columns = tile.width > kGroupSide ? 2 : 1;
            EXPECT_EQ(gather.quarter_count, columns * (tile.height > kGroupSide ? 2 : 1));
            for (int y = 0; y < tile.height; ++y) {
                for (int x = 0; x < tile.width; ++x) {
                    const GatherGrid& quarter =
                        gather.quarters[y / kGroupSide * columns + x / kGroupSide];
                    const double s = (2.0 * (tile.x + x) + 1) / size - 1;
                    const double t = (2.0 * (tile.y + y) + 1) / size - 1;
                    EXPECT_NEAR(quarter.s[x % kGroupSide], s, 1e-6);
                    EXPECT_NEAR(quarter.t[y % kGroupSide], t, 1e-6);
                    EXPECT_GE(s, gather.interpolation.s[0] - 1e-6);
                    EXPECT_LE(s, gather.interpolation.s[kGroupSide - 1] + 1e-6);
                    EXPECT_GE(t, gather.interpolation.t[0] - 1e-6);
                    EXPECT_LE(t, gather.interpolation.t[kGroupSide - 1] + 1e-6);
                }
            }
            for (int i = 0; i < gather.quarter_count; ++i) {
                for (int j = 0; j < kGroupSide; ++j) {  // none beyond the face
                    EXPECT_LT(std::abs(gather.quarters[i].s[j]), 1);
                    EXPECT_LT(std::abs(gather.quarters[i].t[j]), 1);
                }
            }
        }
    }
}

}  // namespace
}  // namespace aureole::ibl
