#include "ibl/gather_tile.h"

#include <algorithm>
#include <cmath>

#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

// The zeros of Chebyshev's polynomial, stretched so that the outer two are the ends.
double point(int i) {
    return -std::cos((2 * i + 1) * kPi / (2 * kGroupSide)) / std::cos(kPi / (2 * kGroupSide));
}

// Coordinate of `position` on a side of `size` texels.
float coordinate(double position, int size) {
    return static_cast<float>((2 * position + 1) / size - 1);
}

// Columns (or rows) of a quarter; beyond the end of the tile the last one is repeated.
void set_quarter(int first, int count, int from, int size, float* coordinates) {
    for (int i = 0; i < kGroupSide; ++i) {
        coordinates[i] = coordinate(first + std::min(from + i, count - 1), size);
    }
}

constexpr int quarters(int count) { return count > kGroupSide ? 2 : 1; }

}  // namespace

std::array<double, kGroupSide> Interpolation::points() {
    return {point(0), point(1), point(2), point(3)};
}

Interpolation::Interpolation(int outputs) {
    for (int i = 0; i < outputs; ++i) {
        const double u = outputs == 1 ? 0 : 2.0 * i / (outputs - 1) - 1;
        for (int j = 0; j < kGroupSide; ++j) {
            double product = 1;
            for (int k = 0; k < kGroupSide; ++k) {
                if (k != j) product *= (u - point(k)) / (point(j) - point(k));
            }
            weight[i][j] = static_cast<float>(product);
        }
    }
}

GatherTile gather_tile(const Tile& tile, int size) {
    GatherTile out;
    out.face = tile.face;
    for (int i = 0; i < kGroupSide; ++i) {
        const double along = 0.5 * (1 + point(i));
        out.interpolation.s[i] = coordinate(tile.x + along * (tile.width - 1), size);
        out.interpolation.t[i] = coordinate(tile.y + along * (tile.height - 1), size);
    }
    for (int y = 0; y < quarters(tile.height); ++y) {
        for (int x = 0; x < quarters(tile.width); ++x) {
            GatherGrid& quarter = out.quarters[out.quarter_count++];
            set_quarter(tile.x, tile.width, x * kGroupSide, size, quarter.s);
            set_quarter(tile.y, tile.height, y * kGroupSide, size, quarter.t);
        }
    }
    return out;
}

void store_tile(const TileSums& sums, const Interpolation& columns, const Interpolation& rows,
                float scale, const Tile& tile, CubeMap& out) {
    const float* const far[] = {sums.far.r, sums.far.g, sums.far.b};
    for (int c = 0; c < 3; ++c) {
        float at_points[kGroup];
        for (int i = 0; i < kGroup; ++i) at_points[i] = far[c][i] * sums.far.length[i];
        // Down the columns of points first.
        float lines[kTileSide][kGroupSide];
        for (int y = 0; y < tile.height; ++y) {
            const float* w = rows.weight[y];
            for (int j = 0; j < kGroupSide; ++j) {
                lines[y][j] =
                    (w[0] * at_points[j] + w[1] * at_points[kGroupSide + j]) +
                    (w[2] * at_points[2 * kGroupSide + j] + w[3] * at_points[3 * kGroupSide + j]);
            }
        }
        for (int y = 0; y < tile.height; ++y) {
            float* row = out.row(tile.face, tile.y + y, c) + tile.x;
            const float* line = lines[y];
            for (int x = 0; x < tile.width; ++x) {
                const int quarter = y / kGroupSide * quarters(tile.width) + x / kGroupSide;
                const int lane = y % kGroupSide * kGroupSide + x % kGroupSide;
                const GroupSums& group = sums.near[quarter];
                const float* const near = c == 0 ? group.r : c == 1 ? group.g : group.b;
                const float* w = columns.weight[x];
                const float interpolated =
                    (w[0] * line[0] + w[1] * line[1]) + (w[2] * line[2] + w[3] * line[3]);
                row[x] = scale * (near[lane] + interpolated / group.length[lane]);
            }
        }
    }
}

}  // namespace aureole::ibl
