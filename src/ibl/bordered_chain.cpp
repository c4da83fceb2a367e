#include "ibl/bordered_chain.h"

#include <algorithm>

#include "aureole/base/parallel.h"

namespace aureole::ibl {
namespace {

// The texel seen where texel (x, y) of `face`, which lies outside of it, would be. The plane of a
// face, prolonged, meets the next one closer to its middle, by less than half a texel: so it is the
// texel that touches across the edge.
std::uint32_t across(const BorderedLevel& level, int face, int x, int y) {
    const CubePoint point = cube_point_of(texel_direction(face, x, y, level.size));
    const auto index = [&](double coordinate) {
        return std::clamp(static_cast<int>((coordinate + 1) / 2 * level.size), 0, level.size - 1);
    };
    return level.texel(point.face, index(point.s), index(point.t));
}

}  // namespace

BorderedChain::BorderedChain(const std::vector<int>& sizes) {
    std::uint32_t texels = 0;
    for (const int size : sizes) {
        const auto stride = static_cast<std::uint32_t>(size + 2);
        const BorderedLevel level = {size, texels, stride, stride * stride};
        texels += kFaces * level.face_stride;
        levels_.push_back(level);

        Border& border = borders_.emplace_back();
        for (int face = 0; face < kFaces; ++face) {
            for (const int out : {-1, size}) {
                const int in = std::clamp(out, 0, size - 1);
                for (int i = 0; i < size; ++i) {
                    border.edges.push_back(
                        {across(level, face, i, out), level.texel(face, i, out)});
                    border.edges.push_back(
                        {across(level, face, out, i), level.texel(face, out, i)});
                }
                for (const int other_out : {-1, size}) {
                    const int other_in = std::clamp(other_out, 0, size - 1);
                    border.corners.push_back(
                        {{level.texel(face, in, other_in), level.texel(face, out, other_in),
                          level.texel(face, in, other_out)},
                         level.texel(face, out, other_out)});
                }
            }
        }
    }
    texels_ = Buffer(static_cast<std::size_t>(texels) * kTexelFloats);
}

void BorderedChain::fill(std::size_t level, const CubeMap& map) noexcept {
    const int size = map.size();
    parallel_for(static_cast<std::size_t>(kFaces * size), [&](std::size_t row, int) {
        const int face = static_cast<int>(row) / size;
        const int y = static_cast<int>(row) % size;
        const float* red = map.row(face, y, 0);
        const float* green = map.row(face, y, 1);
        const float* blue = map.row(face, y, 2);
        float* to = texels() + std::size_t{kTexelFloats} * levels_[level].texel(face, 0, y);
        for (int x = 0; x < size; ++x, to += kTexelFloats) {
            to[0] = red[x];
            to[1] = green[x];
            to[2] = blue[x];
            to[3] = 0;
        }
    });
    fill_border(level);
}

void BorderedChain::fill_border(std::size_t level) noexcept {
    const auto at = [&](std::uint32_t texel) {
        return texels() + std::size_t{kTexelFloats} * texel;
    };
    for (const Copy& copy : borders_[level].edges) {
        std::copy_n(at(copy.from), kTexelFloats, at(copy.to));
    }
    for (const Corner& corner : borders_[level].corners) {
        for (int c = 0; c < kTexelFloats; ++c) {
            // In double: the three faces that meet here sum in different orders.
            const double sum = static_cast<double>(at(corner.from[0])[c]) +
                               static_cast<double>(at(corner.from[1])[c]) +
                               static_cast<double>(at(corner.from[2])[c]);
            at(corner.to)[c] = static_cast<float>(sum / 3);
        }
    }
}

EnvironmentMips::EnvironmentMips(int size, int levels) {
    std::vector<int> sizes;
    for (int level = 0; level < levels; ++level) sizes.push_back(std::max(1, size >> level));
    chain_ = BorderedChain(sizes);
    for (std::size_t level = 1; level < sizes.size(); ++level) {
        const int above = sizes[level - 1];
        const double ratio = static_cast<double>(above) / sizes[level];
        std::vector<Cover>& covers = covers_.emplace_back();
        for (int i = 0; i < sizes[level]; ++i) {
            const double from = i * ratio;
            const double to = (i + 1) * ratio;
            Cover& cover = covers.emplace_back();
            cover.first = static_cast<int>(from);
            for (int k = cover.first; k < std::min(above, cover.first + 3); ++k) {
                const double share = std::min<double>(k + 1, to) - std::max<double>(k, from);
                if (share > 1e-9) cover.share[cover.count++] = static_cast<float>(share);
            }
        }
        std::vector<float>& solid_angles = solid_angles_.emplace_back();
        for (int y = 0; y < above; ++y) {
            for (int x = 0; x < above; ++x) {
                // In units of a texel in the middle of a face, so that large maps do not underflow.
                solid_angles.push_back(
                    static_cast<float>(texel_solid_angle_sr(x, y, above) * above * above / 4));
            }
        }
    }
}

void EnvironmentMips::fill(const CubeMap& environment) noexcept {
    chain_.fill(0, environment);
    for (std::size_t level = 1; level < chain_.levels().size(); ++level) halve(level - 1);
}

void EnvironmentMips::halve(std::size_t above) noexcept {
    const BorderedLevel& source = chain_.levels()[above];
    const BorderedLevel& target = chain_.levels()[above + 1];
    const std::vector<Cover>& covers = covers_[above];
    const float* solid_angles = solid_angles_[above].data();
    parallel_for(static_cast<std::size_t>(kFaces * target.size), [&](std::size_t row, int) {
        const int face = static_cast<int>(row) / target.size;
        const int y = static_cast<int>(row) % target.size;
        const Cover& rows = covers[static_cast<std::size_t>(y)];
        float* to = chain_.texels() + std::size_t{kTexelFloats} * target.texel(face, 0, y);
        for (int x = 0; x < target.size; ++x, to += kTexelFloats) {
            const Cover& columns = covers[static_cast<std::size_t>(x)];
            float sum[kTexelFloats] = {};
            float total = 0;
            for (int v = 0; v < rows.count; ++v) {
                const float* from =
                    chain_.texels() +
                    std::size_t{kTexelFloats} * source.texel(face, columns.first, rows.first + v);
                const float* angle = solid_angles +
                                     static_cast<std::ptrdiff_t>(rows.first + v) * source.size +
                                     columns.first;
                for (int u = 0; u < columns.count; ++u, from += kTexelFloats) {
                    const float weight = rows.share[v] * columns.share[u] * angle[u];
                    total += weight;
                    for (int c = 0; c < kTexelFloats; ++c) sum[c] += weight * from[c];
                }
            }
            for (int c = 0; c < kTexelFloats; ++c) to[c] = sum[c] / total;
        }
    });
    chain_.fill_border(above + 1);
}

}  // namespace aureole::ibl
