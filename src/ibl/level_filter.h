// What the methods of prefilter.h have in common.
#pragma once

#include <memory>
#include <vector>

#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/prefilter.h"
#include "ibl/tile.h"

namespace aureole::ibl {

// One level that is to be filtered; alpha > 0.
struct FilteredLevel {
    int size = 0;  // texels per side
    double alpha = 1;
    int samples = 0;  // of the sampling methods
};

// Configured for environments of one size and a list of levels; allocates nothing after that.
class LevelFilter {
  public:
    virtual ~LevelFilter() = default;
    // Once per environment, which stays alive and unchanged until the last tile is done. May run
    // parallel loops.
    virtual void prepare(const CubeMap& environment) noexcept = 0;
    // Fills one tile of `out`, a map of levels[level].size. Several threads do so at once, each
    // with a `worker` of its own.
    virtual void filter(int level, const Tile& tile, int worker, CubeMap& out) noexcept = 0;
};

std::unique_ptr<LevelFilter> make_gather_filter(int size, const std::vector<FilteredLevel>& levels,
                                                FilterQuality quality);
std::unique_ptr<LevelFilter> make_exact_filter(int size, const std::vector<FilteredLevel>& levels);
// kReference, kFis, kPrecomputed or kNlWeighted.
std::unique_ptr<LevelFilter> make_sampling_filter(int size,
                                                  const std::vector<FilteredLevel>& levels,
                                                  const PrefilterOptions& options);

}  // namespace aureole::ibl
