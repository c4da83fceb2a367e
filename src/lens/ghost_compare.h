// How far linear optics is off for each ghost, from few rays.
#pragma once

#include <span>
#include <vector>

#include "lens/film.h"
#include "lens/ghost_draw.h"
#include "lens/matrix_ghosts.h"
#include "lens/traced_bands.h"
#include "lens/traced_mask.h"
#include "lens/traced_mesh.h"

namespace aureole::lens {

// Draws each ghost twice, by coarse grids of rays at a few of its wavelengths and by its placement,
// on a raster of at most kBins x kBins over the part of the picture that the two cover, and adds up
// the differences. What differs within a bin, a fortieth of the ghost, goes unseen.
class GhostCompare {
  public:
    GhostCompare(const Film& film, const TracedBands& bands);

    // One ghost of a light that was prepared; scratch memory is that of the worker. Without a
    // placement only the energy is found.
    GhostComparison compare(int ghost, const sources::Light& light, const TracedBands& bands,
                            const GhostLight& prepared, const TracedMask& mask,
                            const MatrixGhost* placement, int worker);

  private:
    static constexpr int kBins = 40;
    static constexpr int kRays = 32;  // per side of a grid
    static constexpr int kMostBands = 6;

    // Of one worker.
    struct Work {
        explicit Work(const TracedBands& bands);
        TracedMesh mesh{kRays};
        std::vector<RayStep> steps;
        std::vector<float> sums, coverage, difference;
    };

    Film film_;
    std::vector<Work> work_;
};

}  // namespace aureole::lens
