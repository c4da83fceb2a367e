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

// Draws each ghost twice, by coarse grids of rays at three wavelengths and by its placement, on a
// raster of at most kBins x kBins over the part of the picture that the two cover, and adds up the
// differences. What differs within a bin, a fortieth of the ghost, goes unseen.
class GhostCompare {
  public:
    GhostCompare(const Lens& lens, const Film& film, std::span<const Bounces> ghosts);

    // Of every ghost; `placements` are those of the same light. By several threads.
    void compare(const sources::Light& light, const TracedMask& mask,
                 std::span<const MatrixGhost> placements, std::span<GhostComparison> comparisons);

  private:
    static constexpr int kBins = 40;
    static constexpr int kRays = 32;  // per side of a grid
    static constexpr int kBands = 3;

    // Of one worker.
    struct Work {
        explicit Work(const TracedBands& bands);
        TracedBands::Probe probe;
        GhostLight ghost;
        TracedMesh mesh{kRays};
        std::vector<RayStep> steps;
        std::vector<float> sums, coverage, difference;
    };

    GhostComparison comparison_of(int ghost, const sources::Light& light, const TracedMask& mask,
                                  const MatrixGhost& placement, Work& work) const;

    Film film_;
    TracedBands bands_;
    std::vector<Work> work_;
};

}  // namespace aureole::lens
