#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/ibl/exact.h"
#include "ibl/preview_test_support.h"

namespace aureole::ibl {
namespace {

// In white light the split sum is no approximation.
TEST(DominantDirectionPreview, RowsAgreeInWhiteLight) {
    PreviewOptions options = small_preview();
    options.roughness = {0, 0.3, 0.6, 0.9};
    options.integral_samples = 512;
    const CubeChain chain = unfiltered(8, 2, white);
    const PreviewSheet sheet = dominant_direction_preview({"a", &chain, {0, 1}}, preview_table(),
                                                          white_irradiance(), options);
    for (const int row : {0, 1, 3, 4}) {
        for (const double difference : sheet.rows[static_cast<std::size_t>(row)].difference) {
            EXPECT_LT(difference, 0.008) << row;
        }
    }
    EXPECT_TRUE(sheet.rows[2].difference.empty());
}

TEST(DominantDirectionPreview, MirrorsAgreeAndRoughSurfacesAreMended) {
    PreviewOptions options = small_preview();
    options.materials = {preview_gold()};
    options.roughness = {0, 0.6, 0.8, 1};
    const CubeMap environment = overcast_environment(8);
    const ExactFilter exact(environment);
    CubeChain chain = {environment};
    std::vector<double> roughness = {0};
    for (const double level_roughness : {0.6, 0.8, 1.0}) {
        const double alpha = level_roughness * level_roughness;
        chain.push_back(make_environment(8, [&](const Direction& d) {
            const auto rgb = exact.at(d, alpha);
            return Radiance{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                            static_cast<float>(rgb[2])};
        }));
        roughness.push_back(level_roughness);
    }
    const PreviewSheet sheet = dominant_direction_preview(
        {"exact", &chain, roughness}, preview_table(), white_irradiance(), options);
    const auto& mirrored = sheet.rows[0].difference;
    const auto& dominant = sheet.rows[1].difference;
    EXPECT_LT(mirrored[0], 1e-3);
    EXPECT_LT(dominant[0], 1e-3);
    for (std::size_t column = 1; column < 4; ++column) {
        EXPECT_LT(dominant[column], 0.7 * mirrored[column]) << column;
        EXPECT_LT(dominant[column], 0.1) << column;
    }
}

TEST(DominantDirectionPreview, ReportsAndStops) {
    struct Half : Progress {
        void report(std::string_view, double fraction) override {
            EXPECT_GT(fraction, done);
            done = fraction;
        }
        bool cancelled() const override { return stop && done >= 0.5; }
        double done = 0;
        bool stop = false;
    } progress;
    const CubeChain chain = unfiltered(8, 2, white);
    const PreviewChain named = {"a", &chain, {0, 1}};
    PreviewOptions options = small_preview();
    options.integral_samples = 2;
    dominant_direction_preview(named, preview_table(), white_irradiance(), options, &progress);
    EXPECT_EQ(progress.done, 1);
    progress.done = 0;
    progress.stop = true;
    EXPECT_THROW(
        dominant_direction_preview(named, preview_table(), white_irradiance(), options, &progress),
        Cancelled);
    EXPECT_LT(progress.done, 1);
}

TEST(DominantDirectionPreview, IsTheSameWithAnyNumberOfThreads) {
    const CubeChain chain = unfiltered(16, 2, sun_environment);
    const auto pixels = [&] {
        const PreviewOptions options = small_preview();
        return dominant_direction_preview({"a", &chain, {0, 1}}, preview_table(),
                                          white_irradiance(), options)
            .pixels;
    };
    const Image several = pixels();
    const ThreadLimit limit(1);
    const Image one = pixels();
    for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(std::equal(one.plane(c), one.plane(c) + one.pixels(), several.plane(c)));
    }
}

}  // namespace
}  // namespace aureole::ibl
