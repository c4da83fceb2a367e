#include "lens/traced_mesh.h"

#include <algorithm>
#include <cmath>

#include "lens/mesh_classify.h"
#include "lens/mesh_divide.h"
#include "lens/mesh_facets.h"
#include "lens/mesh_upsample.h"

namespace aureole::lens {
namespace {

std::size_t field_floats(int columns, int rows) {
    return static_cast<std::size_t>(ray_stride(columns)) * static_cast<std::size_t>(rows) +
           kMeshPadding;
}

// Rays that never arrive still serve as neighbours of cells that do: their positions are continued
// from the two rays beyond.
void continue_over_lost(const Mesh& mesh) {
    const auto stride = mesh.stride;
    for (int j = 0; j < mesh.rows; ++j) {
        for (int i = 0; i < mesh.columns; ++i) {
            const std::ptrdiff_t at = j * stride + i;
            if (mesh.clip[at] < kLostRay) continue;
            float x = 0;
            float y = 0;
            int ways = 0;
            const auto from = [&](bool exists, std::ptrdiff_t step) {
                if (!exists || mesh.clip[at + step] >= kLostRay ||
                    mesh.clip[at + 2 * step] >= kLostRay) {
                    return;
                }
                x += 2 * mesh.x[at + step] - mesh.x[at + 2 * step];
                y += 2 * mesh.y[at + step] - mesh.y[at + 2 * step];
                ++ways;
            };
            from(i + 2 < mesh.columns, 1);
            from(i >= 2, -1);
            from(j + 2 < mesh.rows, stride);
            from(j >= 2, -stride);
            if (ways == 0) continue;
            mesh.x[at] = x / static_cast<float>(ways);
            mesh.y[at] = y / static_cast<float>(ways);
        }
    }
}

}  // namespace

PlaneBox picture_on_sensor(const Film& film, double margin_px) {
    const auto x_mm = [&](double px) { return (film.axis_x - px) * film.mm_per_px; };
    const auto y_mm = [&](double px) { return (px - film.axis_y) * film.mm_per_px; };
    return {x_mm(film.width + margin_px), x_mm(-margin_px), y_mm(-margin_px),
            y_mm(film.height + margin_px)};
}

TracedMesh::TracedMesh(int side)
    : side_(side),
      memory_(bytes(side) / sizeof(float)),
      states_(static_cast<std::size_t>(side * side + kFineSide * kFineSide +
                                       kMaxPatches * kPatchColumns * kPatchRows)),
      groups_(static_cast<std::size_t>(
          most_groups(std::max(side, kFineSide), std::max(side, kFineSide)) +
          kMaxPatches * most_groups(kPatchColumns, kPatchRows))),
      patches_(kMaxPatches),
      throughput_(std::max(side, kPatchColumns)) {
    std::fill(memory_.data(), memory_.data() + memory_.size(), 0.0F);
    float* memory = memory_.data();
    allocate(grid_, side, side, memory);
    std::uint8_t* states = states_.data();
    grid_.state = states;
    states += side * side;
    memory += kMeshFields * field_floats(side, side);
    allocate(fine_, kFineSide, kFineSide, memory);
    fine_.state = states;
    states += kFineSide * kFineSide;
    memory += kMeshFields * field_floats(kFineSide, kFineSide);
    for (Patch& patch : patches_) {
        allocate(patch.mesh, kPatchColumns, kPatchRows, memory);
        patch.mesh.state = states;
        states += kPatchColumns * kPatchRows;
        memory += kMeshFields * field_floats(kPatchColumns, kPatchRows);
    }
}

std::size_t TracedMesh::bytes(int side) {
    return sizeof(float) * (kMeshFields * field_floats(side, side) +
                            kMeshFields * field_floats(kFineSide, kFineSide) +
                            kMaxPatches * kMeshFields * field_floats(kPatchColumns, kPatchRows));
}

void TracedMesh::allocate(Mesh& mesh, int columns, int rows, float* memory) const {
    mesh.columns = columns;
    mesh.rows = rows;
    mesh.stride = ray_stride(columns);
    float** const fields[kMeshFields] = {&mesh.x,      &mesh.y,        &mesh.u,
                                         &mesh.v,      &mesh.clip,     &mesh.power,
                                         &mesh.smooth, &mesh.radiance, &mesh.share};
    for (float** field : fields) {
        *field = memory;
        memory += field_floats(columns, rows);
    }
}

// Fills the vertices of a mesh that begins at (i, j) of the grid, `step` cells of it apart.
void TracedMesh::trace(const MeshJob& job, Mesh& mesh, double i, double j, double step) noexcept {
    RayBundle rays = bundle_;
    rays.columns = mesh.columns;
    rays.rows = mesh.rows;
    rays.x_mm = static_cast<float>(bundle_.x_mm + i * static_cast<double>(bundle_.step_x_mm));
    rays.y_mm = static_cast<float>(bundle_.y_mm + j * static_cast<double>(bundle_.step_y_mm));
    rays.step_x_mm = static_cast<float>(step * static_cast<double>(bundle_.step_x_mm));
    rays.step_y_mm = static_cast<float>(step * static_cast<double>(bundle_.step_y_mm));
    mesh.entrance_x = rays.x_mm;
    mesh.entrance_y = rays.y_mm;
    mesh.entrance_step_x = rays.step_x_mm;
    mesh.entrance_step_y = rays.step_y_mm;
    // In pixels of the level.
    const Film& film = *job.film;
    const double per_px = 1.0 / (1 << job.level);
    const auto scale = static_cast<float>(per_px / film.mm_per_px);
    const bool some_lost = ray_kernels().trace(job.way, job.sensor_distance_mm, rays, job.iris,
                                               {.x = mesh.x,
                                                .y = mesh.y,
                                                .u = mesh.u,
                                                .v = mesh.v,
                                                .clip = mesh.clip,
                                                .begin_x = static_cast<float>(film.axis_x * per_px),
                                                .begin_y = static_cast<float>(film.axis_y * per_px),
                                                .scale_x = -scale,
                                                .scale_y = scale});
    rays_ += static_cast<std::size_t>(mesh.columns) * static_cast<std::size_t>(mesh.rows);
    if (some_lost) continue_over_lost(mesh);

    const double cell_mm2 = static_cast<double>(rays.step_x_mm) * rays.step_y_mm;
    const auto power = static_cast<float>(job.power_per_mm2 * cell_mm2);
    throughput_.interpolate(i, j, step, power, mesh);
}

// Gives refined cells patches as long as there are any; the others are drawn as they are.
void TracedMesh::refine(const MeshJob& job, const Mesh& mesh, double i, double j, double step,
                        int depth) noexcept {
    for (int row = 1; row + 2 < mesh.rows; ++row) {
        std::uint8_t* cell = mesh.state + static_cast<std::ptrdiff_t>(row) * mesh.columns;
        const float* clip = mesh.clip + row * mesh.stride;
        for (int column = 1; column + 2 < mesh.columns; ++column) {
            if (cell[column] != kCellRefined) continue;
            if (depth == kMaxDepth || patch_count_ == kMaxPatches) {
                const auto there = [&](std::ptrdiff_t k) { return clip[column + k] < kLostRay; };
                const bool whole =
                    there(0) && there(1) && there(mesh.stride) && there(mesh.stride + 1);
                cell[column] = whole ? kCellMasked : kCellDead;
                continue;
            }
            int run = 1;
            while (run < kRun && column + run + 2 < mesh.columns &&
                   cell[column + run] == kCellRefined) {
                ++run;
            }
            Patch& patch = patches_[static_cast<std::size_t>(patch_count_++)];
            patch.mesh.columns = run * kFiner + 3;
            patch.depth = depth + 1;
            patch.step = step / kFiner;
            patch.i = i + column * step - patch.step;
            patch.j = j + row * step - patch.step;
            trace(job, patch.mesh, patch.i, patch.j, patch.step);
            column += run - 1;
        }
    }
}

void TracedMesh::add_bounds(std::span<const MeshGroup> groups) noexcept {
    for (const MeshGroup& group : groups) {
        const auto whole = [](float at, float low, float high) {
            return static_cast<int>(std::floor(std::clamp(at, low, high)));
        };
        const Bounds b = {whole(group.x0, -1e6F, 1e6F), whole(group.x1, -1e6F, 1e6F) + 1,
                          whole(group.y0, -1e6F, 1e6F), whole(group.y1, -1e6F, 1e6F) + 1};
        if (bounds_.y0 >= bounds_.y1) {
            bounds_ = b;
        } else {
            bounds_ = {std::min(bounds_.x0, b.x0), std::max(bounds_.x1, b.x1),
                       std::min(bounds_.y0, b.y0), std::max(bounds_.y1, b.y1)};
        }
    }
}

// Into how many parts cells are best divided: facets are smoothest if they are some pixels wide,
// and what folds spoil of them is least.
int TracedMesh::upsampling(int side) const noexcept {
    constexpr double kGoodFacetPx = 7;
    constexpr int kEvery = 3;  // rows looked at
    double area = 0;
    int count = 0;
    for (int row = 1; row + 2 < side; row += kEvery) {
        for (int column = 1; column + 2 < side; ++column) {
            const std::uint8_t state = grid_.state[row * side + column];
            if (state != kCellOpen && state != kCellMasked) continue;
            const std::ptrdiff_t a = row * grid_.stride + column;
            const std::ptrdiff_t b = a + grid_.stride;
            area += std::abs((grid_.x[b + 1] - grid_.x[a]) * (grid_.y[a + 1] - grid_.y[b]) -
                             (grid_.x[a + 1] - grid_.x[b]) * (grid_.y[b + 1] - grid_.y[a]));
            ++count;
        }
    }
    if (count == 0) return 1;
    const double size_px = std::sqrt(0.5 * area / count);
    int factor = std::clamp(static_cast<int>(size_px / kGoodFacetPx + 0.5), 1, kMostUpsampling);
    while (factor > 1 && upsampled(side, factor) > kFineSide) --factor;
    return factor;
}

void TracedMesh::build(const MeshJob& job) noexcept {
    rays_ = 0;
    patch_count_ = group_count_ = grid_groups_ = 0;
    bounds_ = {};
    side_ = job.side;
    grid_.columns = grid_.rows = side_;
    grid_.stride = ray_stride(side_);
    // One cell on each side is the rim, which is not drawn.
    const double step_x = (job.box.x1 - job.box.x0) / (side_ - 3);
    const double step_y = (job.box.y1 - job.box.y0) / (side_ - 3);
    bundle_ = {};
    bundle_.direction[0] = static_cast<float>(job.direction.x);
    bundle_.direction[1] = static_cast<float>(job.direction.y);
    bundle_.direction[2] = static_cast<float>(job.direction.z);
    bundle_.columns = bundle_.rows = side_;
    bundle_.x_mm = static_cast<float>(job.box.x0 - step_x);
    bundle_.y_mm = static_cast<float>(job.box.y0 - step_y);
    bundle_.step_x_mm = static_cast<float>(step_x);
    bundle_.step_y_mm = static_cast<float>(step_y);
    rays_ += throughput_.trace(job.way, bundle_);
    trace(job, grid_, 0, 0, 1);

    ClassifyOptions options;
    options.inner_radius = job.inner_radius;
    options.outer_radius = job.outer_radius;
    options.all_masked = job.all_masked;
    options.x0 = job.x0;
    options.x1 = job.x1;
    options.y0 = job.y0;
    options.y1 = job.y1;
    const auto divide = [&](const Mesh& mesh) {
        const int first = group_count_;
        const int count = lens::divide(mesh, groups_.data() + first);
        group_count_ += count;
        add_bounds(std::span(groups_).subspan(static_cast<std::size_t>(first),
                                              static_cast<std::size_t>(count)));
        return count;
    };
    classify(grid_, options);
    refine(job, grid_, 0, 0, 1, 0);
    const int factor = upsampling(side_);
    upsampled_ = factor > 1;
    if (upsampled_) {
        fine_.columns = fine_.rows = upsampled(side_, factor);
        fine_.stride = ray_stride(fine_.columns);
        upsample(grid_, factor, fine_);
        options.upsampled = true;
        classify(fine_, options);
        options.upsampled = false;
    }
    grid_groups_ = divide(upsampled_ ? fine_ : grid_);
    // The list grows while it is worked through.
    for (int k = 0; k < patch_count_; ++k) {
        Patch& patch = patches_[static_cast<std::size_t>(k)];
        patch.first_group = group_count_;
        classify(patch.mesh, options);
        refine(job, patch.mesh, patch.i, patch.j, patch.step, patch.depth);
        patch.group_count = divide(patch.mesh);
    }
}

void TracedMesh::draw_groups(const Mesh& mesh, std::span<const MeshGroup> groups,
                             const MeshMask& mask, const MeshTile& tile) const noexcept {
    const auto x0 = static_cast<float>(tile.x0);
    const auto x1 = static_cast<float>(tile.x1);
    const auto y0 = static_cast<float>(tile.y0);
    const auto y1 = static_cast<float>(tile.y1);
    for (const MeshGroup& group : groups) {
        if (group.y1 < y0 || group.y0 > y1 || group.x1 < x0 || group.x0 > x1) continue;
        if (group.pieces_i > 0) {
            draw_pieces(mesh, group, mask, tile);
        } else {
            draw_facets(mesh, group, mask, tile);
        }
    }
}

void TracedMesh::draw(const MeshMask& mask, const MeshTile& tile) const noexcept {
    const std::span groups(groups_);
    draw_groups(upsampled_ ? fine_ : grid_, groups.first(static_cast<std::size_t>(grid_groups_)),
                mask, tile);
    for (int k = 0; k < patch_count_; ++k) {
        const Patch& patch = patches_[static_cast<std::size_t>(k)];
        draw_groups(patch.mesh,
                    groups.subspan(static_cast<std::size_t>(patch.first_group),
                                   static_cast<std::size_t>(patch.group_count)),
                    mask, tile);
    }
}

}  // namespace aureole::lens
