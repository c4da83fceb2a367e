#include "ibl/bordered_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"
#include "aureole/base/units.h"

namespace aureole::ibl {
namespace {

CubeMap random_map(int size, std::uint64_t seed) {
    CubeMap map(size);
    Random random(seed);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                for (int c = 0; c < 3; ++c) {
                    map.at(face, x, y, c) = static_cast<float>(random.uniform());
                }
            }
        }
    }
    return map;
}

// Every level keeps the mean over the sphere, to what sharing a texel by area allows.
TEST(EnvironmentMips, KeepConstantsAndTheMean) {
    for (const int size : {1, 2, 7, 16, 40, 100}) {
        CubeMap map = random_map(size, 9);
        std::fill_n(map.stacked().plane(1), map.stacked().pixels(), 0.3F);
        const auto mean = mean_radiance(map);
        const int levels = 1 + static_cast<int>(std::log2(size));
        EnvironmentMips mips(size, levels);
        for (int repeat = 0; repeat < 2; ++repeat) mips.fill(map);
        const BorderedChain& chain = mips.chain();
        ASSERT_EQ(chain.levels().size(), static_cast<std::size_t>(levels));
        EXPECT_EQ(chain.levels().back().size, 1);
        for (const BorderedLevel& level : chain.levels()) {
            double sum = 0;
            for (int face = 0; face < kFaces; ++face) {
                for (int y = -1; y <= level.size; ++y) {
                    for (int x = -1; x <= level.size; ++x) {
                        const float* texel =
                            chain.texels() + std::size_t{kTexelFloats} * level.texel(face, x, y);
                        EXPECT_NEAR(texel[1], 0.3, 1e-6);
                        EXPECT_EQ(texel[3], 0);
                        if (std::min(x, y) < 0 || std::max(x, y) == level.size) continue;
                        sum +=
                            static_cast<double>(texel[0]) * texel_solid_angle_sr(x, y, level.size);
                    }
                }
            }
            const bool whole = level.size << (&level - chain.levels().data()) == size;
            EXPECT_NEAR(sum / (4 * kPi) / mean[0], 1, whole ? 1e-5 : 0.02)
                << size << " to " << level.size;
        }
    }
}

}  // namespace
}  // namespace aureole::ibl
