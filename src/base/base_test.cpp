#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "aureole/base/buffer.h"
#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/base/random.h"

namespace aureole {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
    std::vector<std::atomic<int>> visits(1000);
    parallel_for(visits.size(), [&](std::size_t i, int worker) {
        EXPECT_GE(worker, 0);
        EXPECT_LT(worker, max_workers());
        ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count.load(), 1);
}

TEST(ParallelFor, RethrowsFromBody) {
    EXPECT_THROW(parallel_for(8, [](std::size_t, int) { throw InvalidArgument("x", "1", "no"); }),
                 InvalidArgument);
}

TEST(ThreadLimit, LimitsForItsLifeAndNests) {
    const int all = thread_count();
    {
        const ThreadLimit one(1);
        EXPECT_EQ(thread_count(), 1);
        const ThreadLimit many(all + 3);
        EXPECT_EQ(thread_count(), 1);
    }
    EXPECT_EQ(thread_count(), all);
}

TEST(ThreadLimit, RefusesNegative) { EXPECT_THROW(ThreadLimit(-1), InvalidArgument); }

// First outputs of the reference pcg32-demo: seed 42, stream 54.
TEST(Random, MatchesPublishedPcg32Sequence) {
    Random random(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U, 0xbfa4784bU, 0xcbed606eU}) {
        EXPECT_EQ(random.next_bits(), expected);
    }
}

TEST(Random, NormalHasUnitVariance) {
    Random random(1);
    double sum = 0;
    double squares = 0;
    constexpr int kCount = 100000;
    for (int i = 0; i < kCount; ++i) {
        const double value = random.normal();
        sum += value;
        squares += value * value;
    }
    EXPECT_NEAR(sum / kCount, 0, 0.02);
    EXPECT_NEAR(squares / kCount, 1, 0.02);
}

TEST(Buffer, IsAlignedForSimd) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{3}, std::size_t{1} << 20U}) {
        const Buffer buffer(count);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0U);
        EXPECT_EQ(buffer.size(), count);
    }
}

}  // namespace
}  // namespace aureole
