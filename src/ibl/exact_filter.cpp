#include <algorithm>
#include <memory>

#include "aureole/base/error.h"
#include "aureole/ibl/exact.h"
#include "ibl/exact_sum.h"
#include "ibl/level_filter.h"

namespace aureole::ibl {
namespace {

class ExactLevels final : public LevelFilter {
  public:
    ExactLevels(int size, const std::vector<FilteredLevel>& levels) : sum_(size), levels_(levels) {}

    void prepare(const CubeMap& environment) noexcept override { sum_.prepare(environment); }

    void filter(int level, const Tile& tile, int /*worker*/, CubeMap& out) noexcept override {
        const double alpha =
            std::max(kLeastExactAlpha, levels_[static_cast<std::size_t>(level)].alpha);
        Direction normals[kTileTexels];
        const int count = tile.width * tile.height;
        for (int i = 0; i < count; ++i) {
            normals[i] = texel_direction(tile.face, tile.x + i % tile.width,
                                         tile.y + i / tile.width, out.size());
        }
        LobeSums sums = {};
        sum_.add(alpha, normals, count, sums);
        const double scale = 1 / GgxLobe(alpha).integral();
        for (int i = 0; i < count; ++i) {
            for (int c = 0; c < 3; ++c) {
                out.at(tile.face, tile.x + i % tile.width, tile.y + i / tile.width, c) =
                    static_cast<float>(sums.rgb[c][i] * scale);
            }
        }
    }

  private:
    ExactSum sum_;
    std::vector<FilteredLevel> levels_;
};

}  // namespace

std::unique_ptr<LevelFilter> make_exact_filter(int size, const std::vector<FilteredLevel>& levels) {
    return std::make_unique<ExactLevels>(size, levels);
}

struct ExactFilter::Impl {
    ExactSum sum;
};

ExactFilter::ExactFilter(const CubeMap& environment) {
    if (environment.empty()) {
        throw InvalidArgument("environment", "empty", "a cube map has texels");
    }
    impl_ = std::make_unique<Impl>(Impl{ExactSum(environment.size())});
    impl_->sum.prepare(environment);
}

ExactFilter::~ExactFilter() = default;
ExactFilter::ExactFilter(ExactFilter&&) noexcept = default;
ExactFilter& ExactFilter::operator=(ExactFilter&&) noexcept = default;

std::array<double, 3> ExactFilter::at(const Direction& normal, double alpha) const noexcept {
    const double at_least = std::max(kLeastExactAlpha, alpha);
    const Direction unit = normalized(normal);
    LobeSums sums = {};
    impl_->sum.add(at_least, &unit, 1, sums);
    const double scale = 1 / GgxLobe(at_least).integral();
    return {sums.rgb[0][0] * scale, sums.rgb[1][0] * scale, sums.rgb[2][0] * scale};
}

}  // namespace aureole::ibl
