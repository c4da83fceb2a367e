// Prefiltering by a hierarchical gather: see docs/environment_filtering.md.
#include <cmath>
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

class GatherFilter : public LevelFilter {
  public:
    GatherFilter(int size, const std::vector<FilteredLevel>& levels, FilterQuality quality)
        : tree_(size), kernels_(gather_kernels()), scratch_(static_cast<std::size_t>(max_workers())) {
        for (const FilteredLevel& level : levels) {
            sizes_.push_back(level.size);
            limits_.push_back(gather_lobe(level.alpha, quality));
        }
        lobes_ = limits_;
        for (int outputs = 1; outputs <= kTileSide; ++outputs) interpolations_.emplace_back(outputs);
    }

    ~GatherFilter() override {
        if (std::getenv("STATS")) for (auto& s : scratch_) if (s.visited)
            fprintf(stderr, "visited %ld far %ld near %ld deferred %ld\n", s.visited, s.nfar, s.nnear, s.ndef);
    }

    void prepare(const CubeMap& environment) noexcept override {
        tree_.build(environment);
        const auto mean = static_cast<float>(tree_.mean_luminance());
        for (std::size_t i = 0; i < lobes_.size(); ++i) {
            lobes_[i].most_error = limits_[i].most_error * limits_[i].total * mean;
            lobes_[i].most_interpolation_error = limits_[i].most_interpolation_error * limits_[i].total * mean;
            lobes_[i].most_horizon_error = limits_[i].most_horizon_error * limits_[i].total * mean;
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
    std::vector<GatherLobe> limits_;  // for an environment whose mean luminance is 1 / total
    std::vector<GatherLobe> lobes_;
    std::vector<Interpolation> interpolations_;
    std::vector<GatherScratch> scratch_;
};

}  // namespace

std::unique_ptr<LevelFilter> make_gather_filter(int size, const std::vector<FilteredLevel>& levels,
                                                FilterQuality quality) {
    return std::make_unique<GatherFilter>(size, levels, quality);
}

}  // namespace aureole::ibl
