// Prefiltering by a hierarchical gather: see docs/environment_filtering.md.
#include <algorithm>
#include <memory>
#include <vector>

#include "aureole/base/parallel.h"
#include "ibl/gather_kernels.h"
#include "ibl/gather_lobe.h"
#include "ibl/gather_tile.h"
#include "ibl/level_filter.h"
#include "ibl/radiance_tree.h"

namespace aureole::ibl {
namespace {

// A lobe whose alpha is less than this many texels blurs nothing that a texel could show; it is
// taken as that wide, which bounds the parts into which texels are split.
constexpr double kNarrowestLobe = 0.1;

class GatherFilter : public LevelFilter {
  public:
    GatherFilter(int size, const std::vector<FilteredLevel>& levels, FilterQuality quality)
        : tree_(size),
          kernels_(gather_kernels()),
          scratch_(static_cast<std::size_t>(max_workers())) {
        const double narrowest = kNarrowestLobe / tree_.levels().front().nodes_per_side;
        for (const FilteredLevel& level : levels) {
            sizes_.push_back(level.size);
            unit_lobes_.push_back(gather_lobe(std::max(level.alpha, narrowest), quality));
        }
        lobes_ = unit_lobes_;
        for (int outputs = 1; outputs <= kTileSide; ++outputs)
            interpolations_.emplace_back(outputs);
    }

    void prepare(const CubeMap& environment) noexcept override {
        tree_.build(environment);
        for (std::size_t i = 0; i < lobes_.size(); ++i) {
            lobes_[i] = scaled_to(unit_lobes_[i], tree_.mean_luminance());
        }
    }

    void filter(int level, const Tile& tile, int worker, CubeMap& out) noexcept override {
        const auto index = static_cast<std::size_t>(level);
        const GatherLobe& lobe = lobes_[index];
        TileSums sums = {};
        kernels_.gather(tree_.levels(), lobe, gather_tile(tile, sizes_[index]),
                        scratch_[static_cast<std::size_t>(worker)], sums);
        store_tile(sums, interpolations_[static_cast<std::size_t>(tile.width - 1)],
                   interpolations_[static_cast<std::size_t>(tile.height - 1)], 1 / lobe.total, tile,
                   out);
    }

  private:
    RadianceTree tree_;
    const GatherKernels& kernels_;
    std::vector<int> sizes_;
    std::vector<GatherLobe> unit_lobes_;
    std::vector<GatherLobe> lobes_;  // for the environment that was prepared
    std::vector<Interpolation> interpolations_;
    std::vector<GatherScratch> scratch_;
};

}  // namespace

std::unique_ptr<LevelFilter> make_gather_filter(int size, const std::vector<FilteredLevel>& levels,
                                                FilterQuality quality) {
    return std::make_unique<GatherFilter>(size, levels, quality);
}

}  // namespace aureole::ibl
