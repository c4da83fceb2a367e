// The gather against the truth, on maps small enough for all outputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "aureole/ibl/roughness.h"
#include "ibl/filter_checks.h"
#include "ibl/level_filter.h"
#include "ibl/test_environments.h"

namespace aureole::ibl {
namespace {

constexpr FilterQuality kNormal = FilterQuality::kNormal;

// The same picture with smaller texels.
CubeMap with_parts(const CubeMap& map, int parts) {
    CubeMap fine(map.size() * parts);
    for (const Output& at : all_outputs(fine.size())) {
        for (int c = 0; c < 3; ++c) {
            fine.at(at.face, at.x, at.y, c) = map.at(at.face, at.x / parts, at.y / parts, c);
        }
    }
    return fine;
}

double rms_error(const CubeMap& environment, double alpha, FilterQuality quality, int size) {
    const CubeMap level = filtered_levels(environment, {{size, alpha, 0}}, quality)[0];
    const CubeMap fine = with_parts(environment, (63 + environment.size()) / environment.size());
    const FilterOracle oracle(fine);
    return LevelTruth(environment, oracle, alpha, size, 40).rms_error(level);
}

TEST(GatherFilterSlow, IsRightOnEveryMap) {
    for (const double alpha : {.02, .2, 1.0}) {
        EXPECT_LT(rms_error(studio_environment(64), alpha, kNormal, 32), 3e-3) << alpha;
        EXPECT_LT(rms_error(interior_environment(64), alpha, kNormal, 32), 3e-3) << alpha;
        EXPECT_LT(rms_error(overcast_environment(64), alpha, kNormal, 32), 1e-3) << alpha;
        EXPECT_LT(rms_error(sun_environment(64), alpha, kNormal, 32), 1e-3) << alpha;
        EXPECT_LT(rms_error(corner_texel_environment(64), alpha, kNormal, 32), 1e-3) << alpha;
    }
}

// Lights of saturated colors beside one another: the tree's centroids are those of luminance.
TEST(GatherFilter, ColorsAreAsGoodAsLuminance) {
    for (const CubeMap& map : {red_sun_environment(64), patches_environment(64)}) {
        const FilterOracle oracle(map);
        for (const double alpha : {.1, .5, 1.0}) {
            const CubeMap level = filtered_levels(map, {{16, alpha, 0}}, kNormal)[0];
            EXPECT_LT(LevelTruth(map, oracle, alpha, 16, 60).worst_channel_error(level), 1e-3)
                << alpha;
        }
    }
}

TEST(GatherFilter, QualitiesAreInOrder) {
    const CubeMap map = studio_environment(64);
    const double draft = rms_error(map, .06, FilterQuality::kDraft, 32);
    const double normal = rms_error(map, .06, kNormal, 32);
    const double high = rms_error(map, .06, FilterQuality::kHigh, 32);
    EXPECT_LT(draft, 2e-2);
    EXPECT_LT(normal, 0.5 * draft);
    EXPECT_LT(high, 0.7 * normal);
}

TEST(GatherFilterSlow, TakesAnySizeAndRoughness) {
    for (const auto& [size, level] : {std::array{1, 1}, {2, 1}, {3, 3}, {9, 9}, {45, 22}}) {
        for (const double alpha : {.004, .05, .97, 1.0}) {
            EXPECT_LT(rms_error(studio_environment(size), alpha, kNormal, level), 4e-3)
                << size << " to " << level << ", alpha " << alpha;
        }
    }
}

// A lobe much narrower than a texel shows the texel.
TEST(GatherFilter, ALobeWithoutWidthCopies) {
    const CubeMap map = interior_environment(32);
    const CubeMap level = filtered_levels(map, {{32, 1e-7, 0}}, kNormal)[0];
    double sum = 0;
    double error = 0;
    for (const Output& at : all_outputs(32)) {
        sum += luminance_at(map, at);
        error += std::abs(luminance_at(level, at) - luminance_at(map, at));
    }
    // The lobe is a tenth of a texel wide; of GGX's tail some percent are farther away.
    EXPECT_LT(error / sum, 0.08);
}

TEST(GatherFilter, AConstantStaysConstant) {
    const CubeMap map = constant_environment(128, {2, 3, 5});
    for (const auto& [size, alpha] : {std::pair{64, .02}, {64, .09}, {32, .25}, {16, 1.0}}) {
        const CubeMap level = filtered_levels(map, {{size, alpha, 0}}, kNormal)[0];
        double mean = 0;
        double square = 0;
        const auto outputs = all_outputs(size);
        for (const Output& at : outputs) {
            const double red = level.at(at.face, at.x, at.y, 0) / 2.0;
            EXPECT_NEAR(red, 1, 2e-3);
            EXPECT_NEAR(level.at(at.face, at.x, at.y, 2) / 5.0 / red, 1, 1e-5);
            mean += red / static_cast<double>(outputs.size());
            square += (red - 1) * (red - 1) / static_cast<double>(outputs.size());
        }
        EXPECT_NEAR(mean, 1, 5e-4) << alpha;
        EXPECT_LT(std::sqrt(square), 6e-4) << alpha;
    }
}

// What one texel adds to all outputs together.
TEST(GatherFilterSlow, OneTexelKeepsItsEnergy) {
    constexpr int kSize = 64;
    for (const auto& [face, x, y] : {std::array{0, 0, 0}, {2, 20, 45}, {5, 63, 31}}) {
        const CubeMap map = one_texel_environment(kSize, face, x, y, {1e5F, 1e5F, 1e5F});
        const FilterOracle oracle(map);
        for (const auto& [size, alpha] : {std::pair{32, .02}, {16, .12}, {8, .5}, {8, 1.0}}) {
            const CubeMap level = filtered_levels(map, {{size, alpha, 0}}, kNormal)[0];
            const auto outputs = all_outputs(size);
            const auto truth = true_luminances(oracle, alpha, size, outputs);
            double sum = 0;
            double true_sum = 0;
            for (std::size_t i = 0; i < outputs.size(); ++i) {
                const double area = texel_solid_angle_sr(outputs[i].x, outputs[i].y, size);
                sum += area * luminance_at(level, outputs[i]);
                true_sum += area * truth[i];
            }
            EXPECT_NEAR(sum / true_sum, 1, 1e-3) << alpha << " face " << face;
        }
    }
}

// The difference between neighbouring outputs, compared with the true one, across the edges of the
// faces and inside them.
TEST(GatherFilterSlow, SeamsDoNotShow) {
    constexpr int kSize = 32;
    constexpr double kAlpha = .06;
    const CubeMap map = interior_environment(64);
    const CubeMap level = filtered_levels(map, {{kSize, kAlpha, 0}}, kNormal)[0];
    const FilterOracle oracle(map);
    const auto rms_step = [&](const std::vector<Output>& from, const std::vector<Output>& to) {
        const auto a = true_luminances(oracle, kAlpha, kSize, from);
        const auto b = true_luminances(oracle, kAlpha, kSize, to);
        double sum = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const double step = luminance_at(level, from[i]) - luminance_at(level, to[i]);
            sum += std::pow(step - (a[i] - b[i]), 2) / static_cast<double>(from.size());
        }
        return std::sqrt(sum);
    };
    std::vector<Output> inside[2];
    std::vector<Output> edges[2];
    for (int face = 0; face < kFaces; ++face) {
        for (int i = 0; i < kSize; ++i) {
            inside[0].push_back({face, 15, i});
            inside[1].push_back({face, 16, i});
            // Just beyond the right edge; the texel of that direction on the next face.
            const double s = 1 + 0.5 / kSize;
            const double t = (2.0 * i + 1) / kSize - 1;
            const auto [next, x, y] = texel_of(direction_of({face, s, t}), kSize);
            edges[0].push_back({face, kSize - 1, i});
            edges[1].push_back({next, x, y});
        }
    }
    EXPECT_LT(rms_step(edges[0], edges[1]), 1.5 * rms_step(inside[0], inside[1]));
}

TEST(GatherFilter, NegativeTexelsAreLinear) {
    constexpr int kSize = 64;
    CubeMap map = interior_environment(kSize);
    Random random(3);
    for (int i = 0; i < 400; ++i) {
        set_texel(map, static_cast<int>(random.uniform() * kFaces),
                  static_cast<int>(random.uniform() * kSize),
                  static_cast<int>(random.uniform() * kSize), {-2, -1, -3});
    }
    for (const double alpha : {.02, .3, 1.0}) {
        EXPECT_LT(rms_error(map, alpha, kNormal, 32), 5e-3) << alpha;
    }
    const CubeMap black = filtered_levels(CubeMap(kSize), {{32, .1, 0}}, kNormal)[0];
    for (const Output& at : all_outputs(32)) EXPECT_EQ(luminance_at(black, at), 0);
}

// Nothing in it depends on the unit of radiance.
TEST(GatherFilter, ScalesWithTheEnvironment) {
    const std::vector<FilteredLevel> levels = {{20, .004, 0}, {20, .2, 0}, {20, 1, 0}};
    const CubeMap map = sun_environment(40);
    const auto unit = filtered_levels(map, levels, kNormal);
    for (const float factor : {0x1p-40F, 0x1p40F}) {
        CubeMap scaled_map = map;
        for (int i = 0; i < kFaces * 40; ++i) {
            for (int c = 0; c < 3; ++c) {
                float* row = scaled_map.stacked().row(i, c);
                for (int x = 0; x < 40; ++x) row[x] *= factor;
            }
        }
        const auto scaled_levels = filtered_levels(scaled_map, levels, kNormal);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            for (const Output& at : all_outputs(20)) {
                EXPECT_NEAR(luminance_at(scaled_levels[k], at) / factor / luminance_at(unit[k], at),
                            1, 1e-5);
            }
        }
    }
}

TEST(GatherFilter, ThreadsDoNotChangeABit) {
    const CubeMap map = studio_environment(48);
    const std::vector<FilteredLevel> levels = {{24, .05, 0}, {12, .4, 0}, {6, 1, 0}};
    const auto many = filtered_levels(map, levels, kNormal);
    const ThreadLimit limit(1);
    const auto one = filtered_levels(map, levels, kNormal);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        EXPECT_EQ(std::memcmp(one[k].stacked().plane(0), many[k].stacked().plane(0),
                              3 * one[k].stacked().pixels() * sizeof(float)),
                  0);
    }
}

// A filter that has seen a sun gives what a new one gives.
TEST(GatherFilter, ForgetsTheLastEnvironment) {
    const CubeMap map = overcast_environment(32);
    const auto filter = make_gather_filter(32, {{8, .2, 0}}, kNormal);
    filter->prepare(sun_environment(32));
    CubeMap again(8);
    for (const CubeMap& environment : {sun_environment(32), map}) {
        filter->prepare(environment);
        for (int i = 0; i < tile_count(8); ++i) filter->filter(0, tile_at(i, 8), 0, again);
    }
    const CubeMap fresh = filtered_levels(map, {{8, .2, 0}}, kNormal)[0];
    for (const Output& at : all_outputs(8)) {
        EXPECT_EQ(luminance_at(again, at), luminance_at(fresh, at));
    }
}

}  // namespace
}  // namespace aureole::ibl
