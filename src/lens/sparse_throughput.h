// Throughput of a grid of rays from that of some.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "aureole/base/buffer.h"
#include "lens/mesh_types.h"
#include "lens/ray_kernels.h"

namespace aureole::lens {

// It varies slowly over the pupil: it is traced for every 4th ray in each direction, and
// interpolated by cubics.
class SparseThroughput {
  public:
    // For grids of up to `side` x `side` rays, and meshes of up to so many columns.
    explicit SparseThroughput(int side);

    // Of a square grid. Returns how many rays it traced.
    std::size_t trace(std::span<const RayStep> way, const RayBundle& grid) noexcept;
    // Mesh::power, `scale` times the throughput, of a mesh that begins at (i, j) of the grid and
    // whose vertices are `step` cells of it apart.
    void interpolate(double i, double j, double step, float scale, Mesh& mesh) noexcept;

  private:
    static constexpr int kEvery = 4;
    static int nodes(int side) { return (side - 1 + kEvery - 1) / kEvery + 1; }

    // Where an index of the grid lies between nodes: the four around it, and the weights of a cubic
    // (Catmull & Rom 1974).
    struct Place {
        int node[4] = {};
        float weight[4] = {};
        Place() = default;
        Place(double index, int nodes);
    };

    int nodes_;
    Buffer values_;              // rows of ray_stride(nodes)
    std::vector<float> row_;     // between rows of them
    std::vector<Place> places_;  // of columns
};

}  // namespace aureole::lens
