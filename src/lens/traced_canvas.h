// Drawing meshes onto canvas levels, in tiles that threads take one at a time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "aureole/base/buffer.h"
#include "lens/canvas.h"
#include "lens/traced_blur.h"
#include "lens/traced_mesh.h"

namespace aureole::lens {

// A mesh, where it goes and in what colour.
struct MeshPaint {
    const TracedMesh* mesh = nullptr;
    int level = 0;
    float weight[3] = {};
};

class TracedCanvas {
  public:
    // For canvases of this size.
    explicit TracedCanvas(const Canvas& canvas);

    // Adds meshes in their order, whatever the threads. Marks what it uses.
    void draw(std::span<const MeshPaint> meshes, const MeshMask& mask, Canvas& canvas);
    // The same for meshes of one level, blurred together; they may reach kernel.radius() pixels
    // beyond the level's margins.
    void draw_blurred(std::span<const MeshPaint> meshes, const MeshMask& mask,
                      const BlurKernel& kernel, Canvas& canvas);

  private:
    static constexpr int kTileRows = 64;

    struct Tile {
        int level = 0, y0 = 0, y1 = 0;
    };

    std::vector<Tile> tiles_;        // of all levels
    std::vector<Buffer> sums_;       // by worker
    std::array<Buffer, 3> scratch_;  // planes of the largest level with kMaxRadius around
    std::vector<Tile> scratch_tiles_;
};

}  // namespace aureole::lens
