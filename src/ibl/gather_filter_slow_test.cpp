// The bars of the gather at the size of use: 256 texels per side, five levels as Filament has them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "aureole/base/units.h"
#include "aureole/ibl/roughness.h"
#include "ibl/filter_checks.h"
#include "ibl/test_environments.h"
#include "radiance_file.h"

namespace aureole::ibl {
namespace {

constexpr int kSize = 256;

std::vector<FilteredLevel> filament_levels() {
    const auto roughness = level_roughness(RoughnessMapping::kFilament, 5, kSize);
    std::vector<FilteredLevel> levels;
    for (std::size_t k = 1; k < roughness.size(); ++k) {
        levels.push_back({kSize >> k, alpha_from_roughness(roughness[k]), 0});
    }
    return levels;
}

void expect_bars(const CubeMap& environment) {
    const FilterOracle oracle(environment);
    const auto levels = filament_levels();
    std::vector<LevelTruth> truths;
    for (const FilteredLevel& level : levels) {
        truths.emplace_back(environment, oracle, level.alpha, level.size, 100);
    }
    for (const auto& [quality, bar] : {std::pair{FilterQuality::kDraft, 1e-2},
                                       {FilterQuality::kNormal, 2e-3},
                                       {FilterQuality::kHigh, 1e-3}}) {
        const auto maps = filtered_levels(environment, levels, quality);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            EXPECT_LT(truths[k].rms_error(maps[k]), bar)
                << "level " << k + 1 << " of "
                << kFilterQualityNames[static_cast<std::size_t>(quality)];
        }
    }
}

// Of every channel in its own mean: .1 % in kNormal.
void expect_color_bars(const CubeMap& environment) {
    const FilterOracle oracle(environment);
    const auto levels = filament_levels();
    const auto maps = filtered_levels(environment, levels, FilterQuality::kNormal);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const LevelTruth truth(environment, oracle, levels[k].alpha, levels[k].size, 100);
        EXPECT_LT(truth.worst_channel_error(maps[k]), 1e-3) << "level " << k + 1;
    }
}

TEST(GatherFilterSlow, Studio) { expect_bars(studio_environment(kSize)); }
TEST(GatherFilterSlow, Interior) { expect_bars(interior_environment(kSize)); }
TEST(GatherFilterSlow, Overcast) { expect_bars(overcast_environment(kSize)); }
TEST(GatherFilterSlow, Sun) { expect_bars(sun_environment(kSize)); }
TEST(GatherFilterSlow, CornerTexel) { expect_bars(corner_texel_environment(kSize)); }
TEST(GatherFilterSlow, ColorsOfARedSun) { expect_color_bars(red_sun_environment(kSize)); }
TEST(GatherFilterSlow, ColorsOfPatches) { expect_color_bars(patches_environment(kSize)); }

// Neighbouring tiles have different cuts; on a smooth sky that must not be seen.
TEST(GatherFilterSlow, TilesOfASmoothSkyDoNotShow) {
    const CubeMap map = overcast_environment(kSize);
    const FilterOracle oracle(map);
    const auto levels = filament_levels();
    const auto maps = filtered_levels(map, levels, FilterQuality::kNormal);
    for (std::size_t k = 0; k < 3; ++k) {
        const int size = levels[k].size;
        Random random(9);
        std::vector<Output> left;
        std::vector<Output> right;
        for (int i = 0; i < 200; ++i) {
            const int x =
                kTileSide * (1 + static_cast<int>(random.uniform() * (tiles_per_side(size) - 1)));
            const int y = static_cast<int>(random.uniform() * size);
            const int face = static_cast<int>(random.uniform() * kFaces);
            left.push_back({face, x - 1, y});
            right.push_back({face, x, y});
        }
        const auto a = true_luminances(oracle, levels[k].alpha, size, left);
        const auto b = true_luminances(oracle, levels[k].alpha, size, right);
        std::vector<double> steps;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const double step = luminance_at(maps[k], left[i]) - luminance_at(maps[k], right[i]);
            steps.push_back(std::abs(step - (a[i] - b[i])) / a[i]);
        }
        std::sort(steps.begin(), steps.end());
        EXPECT_LT(steps[steps.size() * 99 / 100], 3e-3) << "level " << k + 1;
    }
}

// A sunset over water.
TEST(GatherFilterSlow, RealPicture) {
    const char* const folder = std::getenv("AUREOLE_TEST_IMAGES");
    if (folder == nullptr) GTEST_SKIP() << "AUREOLE_TEST_IMAGES is not set";
    const Image picture = read_radiance(std::string(folder) + "/venice_sunset_1k.hdr");
    if (picture.empty()) GTEST_SKIP() << "venice_sunset_1k.hdr is not in AUREOLE_TEST_IMAGES";
    const CubeMap map = make_environment(kSize, [&](const Direction& d) {
        const double u = 0.5 + std::atan2(d.x, -d.z) / (2 * kPi);
        const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi;
        const int x = std::min(static_cast<int>(u * picture.width()), picture.width() - 1);
        const int y = std::min(static_cast<int>(v * picture.height()), picture.height() - 1);
        return Radiance{picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)};
    });
    expect_bars(map);
    expect_color_bars(map);
}

}  // namespace
}  // namespace aureole::ibl
