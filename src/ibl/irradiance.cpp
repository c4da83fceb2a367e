#include "aureole/ibl/irradiance.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "ibl/irradiance_kernels.h"
#include "ibl/texel_geometry.h"

namespace aureole::ibl {
namespace {

constexpr int kLargestSize = 16384;
// Where texels are larger than on a map of this size, each is taken in parts of equal light: a
// horizon's way through a part is straight enough.
constexpr int kFinestSize = 64;
// A stack of nodes still to visit holds at most three of each level but the last.
constexpr int kMostWaiting = 64;

// Part of a face.
struct Node {
    float vector[3][3];  // of R, G, B: the integral of radiance times L
    float axis[3];       // of a cone around it
    float sine = 0;      // of the cone's radius
};

// The nodes of one face at one level, row by row.
struct Level {
    int side = 0;
    std::size_t first = 0;  // in the list of a face
};

}  // namespace

struct Irradiance::Impl {
    int parts = 1;              // of a texel, per side
    int fine = 0;               // parts along a face
    std::vector<Level> levels;  // the first has one node per block
    std::size_t nodes_per_face = 0;
    std::vector<Node> nodes;
    std::vector<FaceFrame> frames;
    std::vector<IrradianceBlock, AlignedAllocator<IrradianceBlock>> blocks;  // of all faces

    explicit Impl(int size) {
        parts = (kFinestSize + size - 1) / size;
        fine = parts * size;
        for (int face = 0; face < kFaces; ++face) frames.push_back(face_frame(face));
        for (int side = tiles_per_side(fine);; side = (side + 1) / 2) {
            levels.push_back({side, nodes_per_face});
            nodes_per_face += static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
            if (side == 1) break;
        }
        nodes.resize(kFaces * nodes_per_face);
        blocks.resize(static_cast<std::size_t>(tile_count(fine)));
        for (std::size_t level = 0; level < levels.size(); ++level) set_cones(level);
    }

    Node& node(int face, std::size_t level, int x, int y) {
        return nodes[static_cast<std::size_t>(face) * nodes_per_face + levels[level].first +
                     static_cast<std::size_t>(y * levels[level].side + x)];
    }

    double coordinate(double place) const { return 2 * place / fine - 1; }

    void set_cones(std::size_t level) {
        const int texels = kTileSide << level;
        const auto end = [&](int index) { return std::min(fine, (index + 1) * texels); };
        for (int y = 0; y < levels[level].side; ++y) {
            for (int x = 0; x < levels[level].side; ++x) {
                const Cone cone = cone_around(coordinate(x * texels), coordinate(y * texels),
                                              coordinate(end(x)), coordinate(end(y)));
                for (int face = 0; face < kFaces; ++face) {
                    Node& to = node(face, level, x, y);
                    to.axis[0] = static_cast<float>(cone.axis.x);
                    to.axis[1] = static_cast<float>(cone.axis.y);
                    to.axis[2] = static_cast<float>(cone.axis.z);
                    // A little more than needed, for float.
                    to.sine = static_cast<float>(std::sin(cone.radius) + 1e-6);
                }
            }
        }
    }

    void load(const CubeMap& environment, const Tile& tile, IrradianceBlock& block) const {
        block.s = static_cast<float>(coordinate(tile.x + .5));
        block.t = static_cast<float>(coordinate(tile.y + .5));
        block.side = static_cast<float>(2.0 / fine);
        for (int c = 0; c < 3; ++c) {
            float* to = block.radiance[c];
            std::fill_n(to, kTileTexels, 0.0F);
            for (int y = 0; y < tile.height; ++y) {
                const float* row = environment.row(tile.face, (tile.y + y) / parts, c);
                for (int x = 0; x < tile.width; ++x) {
                    to[y * kTileSide + x] = row[(tile.x + x) / parts];
                }
            }
        }
    }

    // As the kernel does for a block that is not cut, in double.
    void sum_block(const Tile& tile, const IrradianceBlock& block) {
        const double area = 4.0 / fine / fine;
        double sum[3][3] = {};
        for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) {
                const double s = coordinate(tile.x + x + .5);
                const double t = coordinate(tile.y + y + .5);
                const double r = 1 / (1 + s * s + t * t);
                const double across = area * r * r * (1 + area / 24 * r * (8 - 24 * r));
                const double along = area * r * r * (1 + area / 24 * r * (16 - 24 * r));
                const double vector[3] = {s * across, t * across, along};
                for (int c = 0; c < 3; ++c) {
                    const double radiance = block.radiance[c][y * kTileSide + x];
                    for (int k = 0; k < 3; ++k) sum[c][k] += radiance * vector[k];
                }
            }
        }
        Node& to = node(tile.face, 0, tile.x / kTileSide, tile.y / kTileSide);
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 3; ++k) to.vector[c][k] = static_cast<float>(sum[c][k]);
        }
    }

    void sum_children(int face, std::size_t level) {
        const int below = levels[level - 1].side;
        for (int y = 0; y < levels[level].side; ++y) {
            for (int x = 0; x < levels[level].side; ++x) {
                Node& to = node(face, level, x, y);
                for (auto& channel : to.vector)
                    std::fill(std::begin(channel), std::end(channel), 0);
                for (int v = 2 * y; v < std::min(2 * y + 2, below); ++v) {
                    for (int u = 2 * x; u < std::min(2 * x + 2, below); ++u) {
                        const Node& child = node(face, level - 1, u, v);
                        for (int c = 0; c < 3; ++c) {
                            for (int k = 0; k < 3; ++k) to.vector[c][k] += child.vector[c][k];
                        }
                    }
                }
            }
        }
    }

    void add_face(int face, const Direction& unit_normal, double (&rgb)[3]) const {
        const auto [s, t, a] = in_frame(frames[static_cast<std::size_t>(face)], unit_normal);
        const float n[3] = {static_cast<float>(s), static_cast<float>(t), static_cast<float>(a)};
        const auto along = [&](const float(&v)[3]) {
            return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
        };
        const Node* of_face = nodes.data() + static_cast<std::size_t>(face) * nodes_per_face;

        const IrradianceBlock* of_face_blocks =
            blocks.data() + static_cast<std::size_t>(face) * (blocks.size() / kFaces);

        struct Place {
            int level, x, y;
        };
        Place waiting[kMostWaiting];
        int count = 0;
        waiting[count++] = {static_cast<int>(levels.size()) - 1, 0, 0};
        while (count > 0) {
            const Place place = waiting[--count];
            const Level& level = levels[static_cast<std::size_t>(place.level)];
            const int index = place.y * level.side + place.x;
            const Node& node = of_face[level.first + static_cast<std::size_t>(index)];
            const float mu = along(node.axis);
            if (mu <= -node.sine) continue;
            if (mu >= node.sine) {
                for (int c = 0; c < 3; ++c) rgb[c] += along(node.vector[c]);
            } else if (place.level == 0) {
                add_irradiance_of_block()(of_face_blocks[index], n, rgb);
            } else {
                const int below = levels[static_cast<std::size_t>(place.level) - 1].side;
                for (int y = 2 * place.y; y < std::min(2 * place.y + 2, below); ++y) {
                    for (int x = 2 * place.x; x < std::min(2 * place.x + 2, below); ++x) {
                        waiting[count++] = {place.level - 1, x, y};
                    }
                }
            }
        }
    }
};

Irradiance::Irradiance(int size) {
    if (size < 1 || size > kLargestSize) {
        throw InvalidArgument("size", std::to_string(size), "must be in [1, 16384]");
    }
    impl_ = std::make_unique<Impl>(size);
}

Irradiance::~Irradiance() = default;
Irradiance::Irradiance(Irradiance&&) noexcept = default;
Irradiance& Irradiance::operator=(Irradiance&&) noexcept = default;

void Irradiance::prepare(const CubeMap& environment) noexcept {
    Impl& impl = *impl_;
    parallel_for(impl.blocks.size(), [&](std::size_t i, int) {
        const Tile tile = tile_at(static_cast<int>(i), impl.fine);
        impl.load(environment, tile, impl.blocks[i]);
        impl.sum_block(tile, impl.blocks[i]);
    });
    parallel_for(kFaces, [&](std::size_t face, int) {
        for (std::size_t level = 1; level < impl.levels.size(); ++level) {
            impl.sum_children(static_cast<int>(face), level);
        }
    });
}

std::array<double, 3> Irradiance::at(const Direction& normal) const noexcept {
    const Direction unit = normalized(normal);
    double rgb[3] = {};
    for (int face = 0; face < kFaces; ++face) impl_->add_face(face, unit, rgb);
    return {rgb[0], rgb[1], rgb[2]};
}

void Irradiance::fill(CubeMap& out) const noexcept {
    const int size = out.size();
    parallel_for(static_cast<std::size_t>(kFaces * size), [&](std::size_t row, int) {
        const int face = static_cast<int>(row) / size;
        const int y = static_cast<int>(row) % size;
        for (int x = 0; x < size; ++x) {
            const auto rgb = at(texel_direction(face, x, y, size));
            for (int c = 0; c < 3; ++c) {
                out.at(face, x, y, c) = static_cast<float>(rgb[static_cast<std::size_t>(c)]);
            }
        }
    });
}

CubeMap irradiance_map(const CubeMap& environment, int size) {
    CubeMap out(size);
    Irradiance irradiance(environment.size());
    irradiance.prepare(environment);
    irradiance.fill(out);
    return out;
}

}  // namespace aureole::ibl
