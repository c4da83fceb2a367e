#include "lens/traced_canvas.h"

#include <algorithm>

#include "aureole/base/parallel.h"
#include "lens/mesh_planes.h"

namespace aureole::lens {
namespace {

// Planes that are drawn on, each at pixel (0, 0).
struct Target {
    float* planes[3] = {};
    std::ptrdiff_t stride = 0;
    int x0 = 0, x1 = 0;
};

constexpr int kReach = BlurKernel::kMaxRadius;

// Draws one mesh on rows [y0, y1) through `sums`, which are zero before and after. Returns the
// pixels of a row that it may have drawn on.
RowSpan draw_on(const MeshPaint& paint, const MeshMask& mask, const Target& target, int y0, int y1,
                float* sums) {
    const TracedMesh::Bounds& b = paint.mesh->bounds();
    const int top = std::max(y0, b.y0);
    const int bottom = std::min(y1, b.y1);
    const int left = std::max(target.x0, b.x0);
    const int right = std::min(target.x1, b.x1);
    if (top >= bottom || left >= right) return {};
    MeshTile tile;
    tile.sums = sums;
    tile.stride = right - left + 2;
    tile.x0 = left;
    tile.x1 = right;
    tile.y0 = top;
    tile.y1 = bottom;
    paint.mesh->draw(mask, tile);
    for (int y = top; y < bottom; ++y) {
        float* planes[3];
        for (std::size_t c = 0; c < 3; ++c) {
            planes[c] = target.planes[c] + y * target.stride + left;
        }
        flush_row(sums + (y - top + 1) * tile.stride + 1, right - left, paint.weight, planes);
    }
    // The rim.
    std::fill(sums, sums + tile.stride, 0.0F);
    for (int y = 0; y <= bottom - top; ++y) {
        float* row = sums + (y + 1) * tile.stride;
        row[-1] = row[0] = 0;
    }
    std::fill(sums + (bottom - top + 1) * tile.stride, sums + (bottom - top + 2) * tile.stride,
              0.0F);
    return {left, right};
}

}  // namespace

TracedCanvas::TracedCanvas(const Canvas& canvas) {
    for (int l = 0; l < canvas.levels(); ++l) {
        const CanvasLevel& level = canvas.level(l);
        for (int y = -level.margin; y < level.height + level.margin; y += kTileRows) {
            tiles_.push_back({l, y, std::min(y + kTileRows, level.height + level.margin)});
        }
    }
    const CanvasLevel& largest = canvas.level(0);
    const auto columns =
        static_cast<std::size_t>(largest.width + 2 * largest.margin + 4 * kReach + 2);
    const auto rows = static_cast<std::size_t>(largest.height + 2 * largest.margin + 4 * kReach);
    for (int w = 0; w < max_workers(); ++w) {
        sums_.emplace_back(columns * (kTileRows + 2));
        std::fill(sums_.back().data(), sums_.back().data() + sums_.back().size(), 0.0F);
    }
    for (Buffer& plane : scratch_) plane = Buffer(columns * rows);
    scratch_tiles_.reserve(rows / kTileRows + 1);
}

void TracedCanvas::draw(std::span<const MeshPaint> meshes, const MeshMask& mask, Canvas& canvas) {
    parallel_for(tiles_.size(), [&](std::size_t t, int worker) {
        const Tile& tile = tiles_[t];
        const CanvasLevel& level = canvas.level(tile.level);
        Target target;
        std::copy(level.planes, level.planes + 3, target.planes);
        target.stride = level.stride;
        target.x0 = -level.margin;
        target.x1 = level.width + level.margin;
        RowSpan used;
        for (const MeshPaint& paint : meshes) {
            if (paint.level != tile.level) continue;
            const RowSpan span = draw_on(paint, mask, target, tile.y0, tile.y1,
                                         sums_[static_cast<std::size_t>(worker)].data());
            if (!span.empty()) used.include(span.begin, span.end);
        }
        if (used.empty()) return;
        for (int y = tile.y0; y < tile.y1; ++y) level.mark_used(y, used.begin, used.end);
    });
}

void TracedCanvas::draw_blurred(std::span<const MeshPaint> meshes, const MeshMask& mask,
                                const BlurKernel& kernel, Canvas& canvas) {
    if (meshes.empty()) return;
    const CanvasLevel& level = canvas.level(meshes.front().level);
    const int reach = kernel.radius();
    const int margin = level.margin;
    // What the meshes cover, and what they cover once blurred.
    TracedMesh::Bounds drawn;
    for (const MeshPaint& paint : meshes) {
        const TracedMesh::Bounds& b = paint.mesh->bounds();
        if (b.y0 >= b.y1) continue;
        drawn = drawn.y0 >= drawn.y1
                    ? b
                    : TracedMesh::Bounds{std::min(drawn.x0, b.x0), std::max(drawn.x1, b.x1),
                                         std::min(drawn.y0, b.y0), std::max(drawn.y1, b.y1)};
    }
    drawn.x0 = std::max(drawn.x0, -margin - reach);
    drawn.y0 = std::max(drawn.y0, -margin - reach);
    drawn.x1 = std::min(drawn.x1, level.width + margin + reach);
    drawn.y1 = std::min(drawn.y1, level.height + margin + reach);
    if (drawn.x0 >= drawn.x1 || drawn.y0 >= drawn.y1) return;

    Target target;
    // A box of its own, with room for the kernel on every side.
    target.stride = drawn.x1 - drawn.x0 + 2 * reach;
    for (std::size_t c = 0; c < 3; ++c) {
        target.planes[c] =
            scratch_[c].data() + (reach - drawn.y0) * target.stride + reach - drawn.x0;
    }
    target.x0 = drawn.x0;
    target.x1 = drawn.x1;
    const auto tiles_between = [&](int y0, int y1) {
        scratch_tiles_.clear();
        for (int y = y0; y < y1; y += kTileRows) {
            scratch_tiles_.push_back({0, y, std::min(y + kTileRows, y1)});
        }
    };
    tiles_between(drawn.y0 - reach, drawn.y1 + reach);
    parallel_for(scratch_tiles_.size(), [&](std::size_t t, int worker) {
        const Tile& tile = scratch_tiles_[t];
        for (float* plane : target.planes) {
            std::fill(plane + tile.y0 * target.stride + drawn.x0 - reach,
                      plane + tile.y1 * target.stride + drawn.x0 - reach, 0.0F);
        }
        for (const MeshPaint& paint : meshes) {
            draw_on(paint, mask, target, std::max(tile.y0, drawn.y0), std::min(tile.y1, drawn.y1),
                    sums_[static_cast<std::size_t>(worker)].data());
        }
    });
    const int left = std::max(-margin, drawn.x0 - reach);
    const int right = std::min(level.width + margin, drawn.x1 + reach);
    const int top = std::max(-margin, drawn.y0 - reach);
    const int bottom = std::min(level.height + margin, drawn.y1 + reach);
    tiles_between(top, bottom);
    parallel_for(scratch_tiles_.size(), [&](std::size_t t, int) {
        const Tile& tile = scratch_tiles_[t];
        for (int y = tile.y0; y < tile.y1; ++y) {
            level.mark_used(y, left, right);
            for (int dy = -reach; dy <= reach; ++dy) {
                const int half = kernel.half_width(dy);
                if (half < 0 || y + dy < drawn.y0 || y + dy >= drawn.y1) continue;
                // Only where the row under the kernel's has something.
                const int begin = std::max(left, drawn.x0 - half);
                const int end = std::min(right, drawn.x1 + half);
                for (std::size_t c = 0; c < 3; ++c) {
                    blur_row(target.planes[c] + (y + dy) * target.stride + begin - half,
                             kernel.row(dy) + reach - half, 2 * half + 1, end - begin,
                             level.planes[c] + y * level.stride + begin);
                }
            }
        }
    });
}

}  // namespace aureole::lens
