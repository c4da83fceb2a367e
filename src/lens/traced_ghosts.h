// Ghosts by exact rays: grids that adapt to each ghost, and drawing them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "aureole/lens/flare.h"
#include "canvas.h"
#include "film.h"
#include "ghost_draw.h"
#include "matrix_ghosts.h"
#include "progress_part.h"

namespace aureole::lens {

class TracedGhosts {
  public:
    TracedGhosts(const Lens& lens, const Iris& iris, const Film& film, const FlareOptions& options,
                 std::vector<Bounces> ghosts, const Occluder* occluder);
    ~TracedGhosts();
    TracedGhosts(TracedGhosts&&) noexcept;

    // Traces and draws by several threads, all wavelengths; marks the levels it uses. The same
    // bits on any number of threads. Throws Cancelled between batches of meshes only, when some
    // ghosts are on the canvas.
    void draw(const sources::Light& light, std::span<const GhostDraw> ghosts, Canvas& canvas,
              const ProgressPart& progress = {});

    // Of every ghost of the list; `placements` are those of the same light. Differences are only
    // found for GhostMethod::kHybrid.
    void compare(const sources::Light& light, std::span<const MatrixGhost> placements,
                 std::span<GhostComparison> comparisons);

    // Traced by the last draw().
    std::size_t rays() const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace aureole::lens
