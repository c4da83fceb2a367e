// One ghost at one wavelength as meshes of rays: the grid, and finer patches where it needs them.
#pragma once

#include <span>
#include <vector>

#include "aureole/base/buffer.h"
#include "lens/film.h"
#include "lens/mesh_pieces.h"
#include "lens/mesh_types.h"
#include "lens/ray_grid.h"
#include "lens/ray_kernels.h"
#include "lens/sparse_throughput.h"

namespace aureole::lens {

// What to trace, and onto what.
struct MeshJob {
    int side = 0;  // rays of the grid, at most what the mesh was made for; at least 8
    std::span<const RayStep> way;
    float sensor_distance_mm = 0;
    RayDirection direction;
    PlaneBox box;
    IrisField iris;
    float inner_radius = 1;  // of the iris; see ClassifyOptions
    float outer_radius = 1;
    bool all_masked = false;
    const Film* film = nullptr;
    int level = 0;
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // what can be drawn on, pixels of the level
    // Energy in pixels of the level times radiance per mm^2 of the entrance and unit throughput.
    double power_per_mm2 = 0;
};

// The part of the sensor that a picture shows, and so many pixels around it.
PlaneBox picture_on_sensor(const Film& film, double margin_px);

class TracedMesh {
  public:
    // For grids of up to `side` x `side` rays.
    explicit TracedMesh(int side);

    void build(const MeshJob& job) noexcept;

    // Draws all that falls into a tile.
    void draw(const MeshMask& mask, const MeshTile& tile) const noexcept;
    // Pixels of the level that draw() may touch: [x0, x1) x [y0, y1); empty if y0 >= y1.
    struct Bounds {
        int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    };
    const Bounds& bounds() const noexcept { return bounds_; }
    std::size_t rays() const noexcept { return rays_; }
    static std::size_t bytes(int side);

  private:
    // A refined cell is divided into kFiner x kFiner; a patch is a run of up to kRun such cells
    // with a rim, one block of rays wide.
    static constexpr int kFiner = 4;
    static constexpr int kRun = 7;
    static constexpr int kPatchColumns = kRun * kFiner + 3;
    static constexpr int kPatchRows = kFiner + 3;
    static constexpr int kMaxPatches = 256;
    // A grid is upsampled up to so many vertices per side.
    static constexpr int kFineSide = 300;
    static constexpr int kMaxDepth = 3;
    static_assert(ray_stride(kPatchColumns) == kRayBlock);

    struct Patch {
        Mesh mesh;
        int first_group = 0, group_count = 0;
        int depth = 0;
        // Of vertex (0, 0) and steps, in cells of the grid.
        double i = 0, j = 0, step = 1;
    };

    void allocate(Mesh& mesh, int columns, int rows, float* memory) const;
    void trace(const MeshJob& job, Mesh& mesh, double i, double j, double step) noexcept;
    void refine(const MeshJob& job, const Mesh& mesh, double i, double j, double step,
                int depth) noexcept;
    int upsampling(int side) const noexcept;
    void add_bounds(std::span<const MeshGroup> groups) noexcept;
    void draw_groups(const Mesh& mesh, std::span<const MeshGroup> groups, const MeshMask& mask,
                     const MeshTile& tile) const noexcept;

    int side_;
    Buffer memory_;
    Mesh grid_;
    Mesh fine_;  // the grid upsampled, if that is what is drawn
    bool upsampled_ = false;
    RayBundle bundle_;
    std::vector<std::uint8_t> states_;
    std::vector<MeshGroup> groups_;
    int grid_groups_ = 0;
    std::vector<Patch> patches_;
    SparseThroughput throughput_;
    int patch_count_ = 0;
    int group_count_ = 0;
    Bounds bounds_;
    std::size_t rays_ = 0;
};

}  // namespace aureole::lens
