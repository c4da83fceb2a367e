#include "ibl/shrink.h"

#include <algorithm>
#include <array>

namespace aureole::ibl {
namespace {

// Which source texels one output texel covers along one side, and how much of them.
struct Cover {
    int first = 0;
    int end = 0;
    double from = 0;  // in source texels
    double to = 0;
    double share(int index) const {
        return std::min<double>(index + 1, to) - std::max<double>(index, from);
    }
};

Cover cover_of(int index, int size, int source_size) {
    // Whole numbers are divided last: edges of neighbours then agree to the bit.
    const double from = static_cast<double>(index) * source_size / size;
    const double to = static_cast<double>(index + 1) * source_size / size;
    Cover cover = {static_cast<int>(from), static_cast<int>(to), from, to};
    if (cover.end < to) ++cover.end;
    cover.end = std::min(cover.end, source_size);
    return cover;
}

}  // namespace

void shrink_tile(const CubeMap& environment, const Tile& tile, CubeMap& out) noexcept {
    const int source_size = environment.size();
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        const Cover rows = cover_of(y, out.size(), source_size);
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const Cover columns = cover_of(x, out.size(), source_size);
            std::array<double, 3> sum = {};
            double total = 0;
            for (int v = rows.first; v < rows.end; ++v) {
                for (int u = columns.first; u < columns.end; ++u) {
                    const double weight =
                        rows.share(v) * columns.share(u) * texel_solid_angle_sr(u, v, source_size);
                    total += weight;
                    for (int c = 0; c < 3; ++c) {
                        sum[static_cast<std::size_t>(c)] +=
                            weight * environment.at(tile.face, u, v, c);
                    }
                }
            }
            for (int c = 0; c < 3; ++c) {
                out.at(tile.face, x, y, c) =
                    static_cast<float>(sum[static_cast<std::size_t>(c)] / total);
            }
        }
    }
}

}  // namespace aureole::ibl
