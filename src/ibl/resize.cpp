#include "aureole/ibl/resize.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/cube_sampler.h"
#include "aureole/image/finite.h"
#include "ibl/adjust.h"
#include "ibl/rotation.h"
#include "ibl/shrink.h"

namespace aureole::ibl {
namespace {

CubeMap cleaned(const CubeMap& map, const EnvironmentTransform& transform,
                EnvironmentReport& report) {
    CubeMap out = map;
    Image& pixels = out.stacked();
    report.nonfinite_texels = replace_nonfinite(pixels);
    const Adjustment adjustment(transform);
    if (!adjustment.needed()) return out;
    std::vector<Tally> tallies(static_cast<std::size_t>(pixels.height()));
    parallel_for(tallies.size(), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        tallies[row] = adjustment.row(
            pixels, y, [&](int x) { return texel_solid_angle_sr(x, y % map.size(), map.size()); });
    });
    Tally sum;
    for (const Tally& tally : tallies) sum.add(tally);
    sum.write(report);
    return out;
}

// Axes go to axes: in whole numbers, texel (x, y) of `size` is at s = 2 x + 1 - size on a cube of
// half edge `size`, and stays there.
CubeMap permuted(const CubeMap& map, const Rotation& rotation) {
    const int size = map.size();
    CubeMap out(size);
    parallel_for(static_cast<std::size_t>(kFaces) * static_cast<std::size_t>(size),
                 [&](std::size_t row, int) {
                     const int face = static_cast<int>(row) / size;
                     const int y = static_cast<int>(row) % size;
                     for (int x = 0; x < size; ++x) {
                         const CubePoint from =
                             cube_point_of(rotation.undo(texel_direction(face, x, y, size)));
                         const auto texel = [size](double s) {
                             return std::clamp(static_cast<int>((s + 1) / 2 * size), 0, size - 1);
                         };
                         for (int c = 0; c < 3; ++c) {
                             out.at(face, x, y, c) =
                                 map.at(from.face, texel(from.s), texel(from.t), c);
                         }
                     }
                 });
    return out;
}

CubeMap shrunk(const CubeMap& map, int size) {
    CubeMap out(size);
    parallel_for(static_cast<std::size_t>(tile_count(size)), [&](std::size_t i, int) {
        shrink_tile(map, tile_at(static_cast<int>(i), size), out);
    });
    return out;
}

// `density`: samples per texel of the map, along either side.
CubeMap sampled(const CubeMap& map, int size, const Rotation& rotation, int density) {
    CubeMap out(size);
    const CubeSampler sampler({map});
    const int count = std::max(2, (density * map.size() + size - 1) / size);  // per side of a texel
    parallel_for(
        static_cast<std::size_t>(kFaces) * static_cast<std::size_t>(size),
        [&](std::size_t row, int) {
            const int face = static_cast<int>(row) / size;
            const int y = static_cast<int>(row) % size;
            for (int x = 0; x < size; ++x) {
                double sum[3] = {};
                double weights = 0;
                for (int k = 0; k < count * count; ++k) {
                    const double s = 2 * (x + (k % count + 0.5) / count) / size - 1;
                    const double t =
                        2 * (y + (static_cast<double>(k / count) + 0.5) / count) / size - 1;
                    const double h = 1 + s * s + t * t;
                    const double weight = 1 / (h * std::sqrt(h));
                    const auto rgb = sampler.sample(rotation.undo(direction_of({face, s, t})), 0);
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[c] += weight * double{rgb[c]};
                    }
                    weights += weight;
                }
                for (int c = 0; c < 3; ++c) {
                    out.at(face, x, y, c) = static_cast<float>(sum[c] / weights);
                }
            }
        });
    return out;
}

}  // namespace

CubeMap transformed(const CubeMap& map, int size, const EnvironmentTransform& transform,
                    EnvironmentReport* report) {
    const Rotation rotation(transform);
    if (map.empty()) throw InvalidArgument("map", "empty", "must have texels");
    EnvironmentReport found;
    CubeMap out = cleaned(map, transform, found);
    if (report != nullptr) *report = found;
    if (!rotation.is_permutation()) return sampled(out, size, rotation, 4);
    if (!rotation.is_identity()) out = permuted(out, rotation);
    if (size == map.size()) return out;
    return size < map.size() ? shrunk(out, size)
                             : sampled(out, size, Rotation(EnvironmentTransform{}), 2);
}

}  // namespace aureole::ibl
