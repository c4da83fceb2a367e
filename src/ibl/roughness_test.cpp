#include "aureole/ibl/roughness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "aureole/base/error.h"

namespace aureole::ibl {
namespace {

constexpr RoughnessMapping kAll[] = {RoughnessMapping::kFilament, RoughnessMapping::kGltf,
                                     RoughnessMapping::kUe4, RoughnessMapping::kUnity,
                                     RoughnessMapping::kLinear};

TEST(Roughness, RisesFromAMirrorAndStaysInRange) {
    for (const RoughnessMapping mapping : kAll) {
        for (const int size : {1, 16, 100, 256, 2048}) {
            for (int levels = 1; levels <= most_levels(size); ++levels) {
                const auto roughness = level_roughness(mapping, levels, size);
                ASSERT_EQ(roughness.size(), static_cast<std::size_t>(levels));
                EXPECT_EQ(roughness[0], 0);
                for (std::size_t i = 1; i < roughness.size(); ++i) {
                    EXPECT_GE(roughness[i], roughness[i - 1]);
                    EXPECT_GT(roughness[i], 0);
                    EXPECT_LE(roughness[i], 1);
                }
            }
        }
    }
}

// alpha of levels 1 to 4 as Filament's cmgen prints them for five levels.
TEST(Roughness, FilamentIsThatOfCmgen) {
    const auto roughness = level_roughness(RoughnessMapping::kFilament, 5, 256);
    const double alpha[] = {0, .018, .086, .25, 1};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(alpha_from_roughness(roughness[i]), alpha[i], 5e-4) << i;
    }
}

TEST(Roughness, UnityInvertsItsPolynomial) {
    const auto roughness = level_roughness(RoughnessMapping::kUnity, 7, 128);
    for (std::size_t i = 0; i < 7; ++i) {
        const double r = roughness[i];
        EXPECT_NEAR(r * (1.7 - .7 * r), static_cast<double>(i) / 6, 1e-12);
    }
}

// One step of its scale is a factor of 2^(1/1.2); 4 x 4 texels are for roughness 1.
TEST(Roughness, Ue4CountsFromTheSmallEnd) {
    const auto roughness = level_roughness(RoughnessMapping::kUe4, 9, 256);
    EXPECT_DOUBLE_EQ(roughness[6], 1);
    EXPECT_DOUBLE_EQ(roughness[8], 1);
    for (std::size_t i = 1; i < 6; ++i) {
        EXPECT_NEAR(roughness[i + 1] / roughness[i], std::exp2(1 / 1.2), 1e-12);
    }
    const auto larger = level_roughness(RoughnessMapping::kUe4, 10, 512);
    EXPECT_DOUBLE_EQ(larger[4], roughness[3]);
}

TEST(Roughness, CountsLevels) {
    EXPECT_EQ(most_levels(1), 1);
    EXPECT_EQ(most_levels(255), 8);
    EXPECT_EQ(most_levels(256), 9);
    EXPECT_EQ(default_levels(RoughnessMapping::kFilament, 256), 5);
    EXPECT_EQ(default_levels(RoughnessMapping::kLinear, 8), 1);
    EXPECT_EQ(default_levels(RoughnessMapping::kUe4, 256), 9);
}

TEST(Roughness, RefusesChainsThatCannotBe) {
    EXPECT_THROW(level_roughness(RoughnessMapping::kGltf, 0, 256), InvalidArgument);
    EXPECT_THROW(level_roughness(RoughnessMapping::kGltf, 10, 256), InvalidArgument);
    EXPECT_THROW(level_roughness(RoughnessMapping::kGltf, 1, 0), InvalidArgument);
    EXPECT_THROW(level_roughness(RoughnessMapping::kGltf, 1, 20000), InvalidArgument);
}

TEST(Roughness, LevelsAreFoundAgain) {
    for (const RoughnessMapping mapping : kAll) {
        const auto roughness = level_roughness(mapping, 7, 256);
        for (std::size_t i = 0; i + 1 < roughness.size(); ++i) {
            if (i > 0 && roughness[i] == roughness[i - 1]) continue;
            EXPECT_EQ(level_of_roughness(roughness, roughness[i]), static_cast<double>(i));
            if (roughness[i] == roughness[i + 1]) continue;
            const double between = 0.75 * roughness[i] + 0.25 * roughness[i + 1];
            EXPECT_NEAR(level_of_roughness(roughness, between), static_cast<double>(i) + 0.25,
                        1e-12);
        }
    }
    EXPECT_EQ(level_of_roughness({0, 0.5, 1, 1, 1}, 1), 2);
    EXPECT_EQ(level_of_roughness({0, 0.5, 0.8, 0.8}, 1), 2);
    EXPECT_EQ(level_of_roughness({0.2, 0.5}, 0.1), 0);
    EXPECT_EQ(level_of_roughness({0}, 0.5), 0);
}

}  // namespace
}  // namespace aureole::ibl
