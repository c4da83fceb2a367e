// The sampling methods of prefilter.h.
#include <algorithm>

#include "aureole/ibl/roughness.h"
#include "ibl/level_filter.h"
#include "ibl/lobe_taps.h"
#include "ibl/sampling_kernels.h"

namespace aureole::ibl {
namespace {

void store(const TileColors& colors, const Tile& tile, CubeMap& out) {
    for (int y = 0; y < tile.height; ++y) {
        for (int c = 0; c < 3; ++c) {
            float* row = out.row(tile.face, tile.y + y, c) + tile.x;
            for (int x = 0; x < tile.width; ++x) row[x] = colors.rgb[y * tile.width + x][c];
        }
    }
}

// Texels that compute their own samples: kReference and kFis.
class LoopFilter final : public LevelFilter {
  public:
    LoopFilter(int size, const std::vector<FilteredLevel>& levels, const PrefilterOptions& options)
        : levels_(levels) {
        const bool filtered = options.method == FilterMethod::kFis;
        const int mips = filtered ? most_levels(size) : 1;
        environment_ = EnvironmentMips(size, mips);
        const FisLevel fis = {size, mips, options.fis_overlap, options.fis_bias};
        for (const FilteredLevel& level : levels) {
            loops_.push_back({static_cast<float>(std::max(level.alpha, kLeastAlpha)), level.samples,
                              filtered, static_cast<float>(fis.log2_offset())});
        }
    }

    void prepare(const CubeMap& environment) noexcept override { environment_.fill(environment); }

    void filter(int level, const Tile& tile, int /*worker*/, CubeMap& out) noexcept override {
        const auto index = static_cast<std::size_t>(level);
        TileColors colors;
        sampling_kernels().run_loop(environment_.chain(), loops_[index], tile, levels_[index].size,
                                    colors);
        store(colors, tile, out);
    }

  private:
    std::vector<FilteredLevel> levels_;
    std::vector<LobeLoop> loops_;
    EnvironmentMips environment_;
};

// Samples found beforehand: kPrecomputed and kNlWeighted.
class TapFilter final : public LevelFilter {
  public:
    TapFilter(int size, const std::vector<FilteredLevel>& levels, const PrefilterOptions& options)
        : levels_(levels), environment_(size, most_levels(size)) {
        const FisLevel fis = {size, most_levels(size), options.fis_overlap, options.fis_bias};
        const LobeDensity density = options.method == FilterMethod::kNlWeighted
                                        ? LobeDensity::kLight
                                        : LobeDensity::kHalfVector;
        for (const FilteredLevel& level : levels) {
            taps_.push_back(hammersley_taps(Lobe(level.alpha, density), level.samples, fis));
        }
    }

    void prepare(const CubeMap& environment) noexcept override { environment_.fill(environment); }

    void filter(int level, const Tile& tile, int /*worker*/, CubeMap& out) noexcept override {
        const auto index = static_cast<std::size_t>(level);
        TileColors colors;
        sampling_kernels().sum_taps(environment_.chain(), taps_[index], tile, levels_[index].size,
                                    colors);
        store(colors, tile, out);
    }

  private:
    std::vector<FilteredLevel> levels_;
    std::vector<std::vector<LobeTap>> taps_;
    EnvironmentMips environment_;
};

}  // namespace

std::unique_ptr<LevelFilter> make_sampling_filter(int size,
                                                  const std::vector<FilteredLevel>& levels,
                                                  const PrefilterOptions& options) {
    if (options.method == FilterMethod::kReference || options.method == FilterMethod::kFis) {
        return std::make_unique<LoopFilter>(size, levels, options);
    }
    return std::make_unique<TapFilter>(size, levels, options);
}

}  // namespace aureole::ibl
