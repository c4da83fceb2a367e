// Which ghosts there are, and the way of each.
#include "aureole/lens/ghosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "aureole/base/error.h"
#include "aureole/lens/library.h"
#include "aureole/lens/paraxial.h"

namespace aureole::lens {
namespace {

std::size_t pairs(std::size_t n) { return n * (n - 1) / 2; }

TEST(Ghosts, NumberOfPairs) {
    // Refracting faces in front of the stop and behind it, counted in the tables. Of the Canon,
    // row 27 is a fixed stop: a plane in air.
    const struct {
        const char* id;
        std::size_t front, rear;
    } lenses[] = {{"heliar", 5, 3},
                  {"nikon-28-75", 14, 13},
                  {"biotar", 5, 5},
                  {"canon-35-135", 13, 15},
                  {"biconvex", 0, 2}};
    for (const auto& expected : lenses) {
        SCOPED_TRACE(expected.id);
        const Lens lens(shipped_lens(expected.id));
        const auto all = enumerate_ghosts(lens, GhostSet::kAll);
        EXPECT_EQ(all.size(), pairs(expected.front + expected.rear));
        const auto same = enumerate_ghosts(lens, GhostSet::kSameSide);
        EXPECT_EQ(same.size(), pairs(expected.front) + pairs(expected.rear));
        for (const Bounces& ghost : same) EXPECT_EQ(std::count(all.begin(), all.end(), ghost), 1);
        for (const Bounces& ghost : all) {
            EXPECT_LT(ghost.near, ghost.far);
            EXPECT_NE(ghost.near, lens.stop());
            EXPECT_NE(ghost.far, lens.stop());
        }
        EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.near != b.near ? a.near < b.near : a.far < b.far;
        }));
    }
}

TEST(Ghosts, TheWayOfOne) {
    const Lens lens(shipped_lens("biconvex"));  // stop, front, back
    std::string way;
    for (const Step& step : steps_of(lens, {2, 0})) {
        way += std::to_string(step.face);
        if (step.reflects) way += 'r';
        if (step.backwards) way += '<';
        way += ' ';
    }
    EXPECT_EQ(way, "0 1 2r 1< 0r< 1 2 ");
    EXPECT_EQ(steps_of(lens, Bounces{}).size(), 3u);
    for (const Bounces& wrong : {Bounces{3, 0}, Bounces{1, 1}, Bounces{0, 1}, Bounces{1, -1}}) {
        EXPECT_THROW(steps_of(lens, wrong), InvalidArgument);
        EXPECT_THROW(ghost_matrices(lens, wrong, 550), InvalidArgument);
    }
}

TEST(Ghosts, CrossTheStopOnceOrThreeTimes) {
    const Lens lens(shipped_lens("nikon-28-75"));
    for (const Bounces& ghost : enumerate_ghosts(lens, GhostSet::kAll)) {
        const GhostMatrices matrices = ghost_matrices(lens, ghost, 550);
        const bool across = ghost.near < lens.stop() && lens.stop() < ghost.far;
        ASSERT_EQ(matrices.stop_crossings.size(), across ? 3u : 1u);
        for (const int crossing : matrices.stop_crossings) {
            EXPECT_EQ(matrices.crossings[static_cast<std::size_t>(crossing)].face, lens.stop());
        }
        const auto steps = steps_of(lens, ghost);
        ASSERT_EQ(steps.size(), matrices.crossings.size());
        for (std::size_t i = 0; i < steps.size(); ++i) {
            EXPECT_EQ(steps[i].face, matrices.crossings[i].face);
        }
    }
}

}  // namespace
}  // namespace aureole::lens
