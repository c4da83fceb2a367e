#include "flare_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "aureole/base/random.h"

namespace aureole::lens {
namespace {

using Drawn = GhostReport::Drawn;

std::vector<GhostEstimate> random_ghosts(int count) {
    Random random(7);
    std::vector<GhostEstimate> ghosts(static_cast<std::size_t>(count));
    for (GhostEstimate& ghost : ghosts) {
        ghost.energy = random.log_uniform(1e-6, 1);
        ghost.radius_px = random.log_uniform(2, 3000);
        ghost.radiance = ghost.energy / (ghost.radius_px * ghost.radius_px);
        ghost.difference = ghost.energy * random.log_uniform(1e-4, 2);
    }
    return ghosts;
}

double energy_of(const std::vector<GhostEstimate>& ghosts, const std::vector<GhostPlan>& plans,
                 Drawn drawn) {
    double sum = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].drawn == drawn) sum += ghosts[i].energy;
    }
    return sum;
}

TEST(FlarePlan, DroppedEnergyStaysWithinTheBound) {
    const auto ghosts = random_ghosts(300);
    double total = 0;
    for (const auto& ghost : ghosts) total += ghost.energy;
    for (const double share : {0.0, 1e-4, 1e-3, 0.05}) {
        FlareOptions options;
        options.method = GhostMethod::kMatrix;
        options.energy_dropped = share;
        std::vector<GhostPlan> plans(ghosts.size());
        const PlanTotals totals = plan_ghosts(ghosts, options, 6, plans);
        const double dropped = energy_of(ghosts, plans, Drawn::kDropped);
        EXPECT_LE(dropped, share * total);
        EXPECT_NEAR(totals.energy_dropped, dropped / total, 1e-12);
        // The next one would have been too much: nothing is drawn that could be left out.
        double weakest = 2;
        for (std::size_t i = 0; i < plans.size(); ++i) {
            if (plans[i].drawn == Drawn::kMatrix) weakest = std::min(weakest, ghosts[i].energy);
        }
        EXPECT_GT(dropped + weakest, share * total);
    }
}

TEST(FlarePlan, StrongestKeepsTheBrightest) {
    const auto ghosts = random_ghosts(100);
    FlareOptions options;
    options.method = GhostMethod::kMatrix;
    options.energy_dropped = 0;
    options.strongest = 0.4;
    std::vector<GhostPlan> plans(ghosts.size());
    plan_ghosts(ghosts, options, 6, plans);
    double dimmest_kept = 1e9;
    double brightest_dropped = 0;
    int kept = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].drawn == Drawn::kMatrix) {
            ++kept;
            dimmest_kept = std::min(dimmest_kept, ghosts[i].radiance);
        } else {
            brightest_dropped = std::max(brightest_dropped, ghosts[i].radiance);
        }
    }
    EXPECT_EQ(kept, 40);
    EXPECT_LE(brightest_dropped, dimmest_kept);
}

TEST(FlarePlan, LevelsStayWithinTheirTolerance) {
    const auto ghosts = random_ghosts(300);
    double total = 0;
    for (const auto& ghost : ghosts) total += ghost.energy;
    double pixels_before = INFINITY;
    for (const double tolerance : {0.0, 1e-3, 1e-2}) {
        FlareOptions options;
        options.method = GhostMethod::kMatrix;
        options.energy_dropped = 0;
        options.coarse_tolerance = tolerance;
        std::vector<GhostPlan> plans(ghosts.size());
        const PlanTotals totals = plan_ghosts(ghosts, options, 6, plans);
        double displaced = 0;
        double pixels = 0;
        for (std::size_t i = 0; i < plans.size(); ++i) {
            const int level = plans[i].level;
            displaced += ghosts[i].energy * displaced_by_level(level, ghosts[i].radius_px);
            pixels += std::pow(ghosts[i].radius_px, 2) / std::pow(4, level);
            EXPECT_LE(level, 6);
            if (level > 0) {
                EXPECT_GE(ghosts[i].radius_px / (1 << level), 8);
            }
        }
        EXPECT_LE(displaced, tolerance * total);
        EXPECT_NEAR(totals.coarse_displaced, displaced / total, 1e-12);
        EXPECT_LT(pixels, pixels_before);
        if (tolerance == 0) {
            EXPECT_EQ(displaced, 0);
        }
        pixels_before = pixels;
    }
}

TEST(FlarePlan, HybridTracesWhatDiffers) {
    auto ghosts = random_ghosts(100);
    ghosts[3].difference = -1;  // not known
    ghosts[3].energy = 1;
    double total = 0;
    for (const auto& ghost : ghosts) total += ghost.energy;
    FlareOptions options;
    options.energy_dropped = 0;
    std::vector<GhostPlan> plans(ghosts.size());
    plan_ghosts(ghosts, options, 6, plans);
    double error = 0;
    int matrix = 0;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].drawn != Drawn::kMatrix) continue;
        ++matrix;
        error += ghosts[i].difference;
    }
    EXPECT_LE(error, options.hybrid_tolerance * total);
    EXPECT_GT(matrix, 10);
    EXPECT_EQ(plans[3].drawn, Drawn::kTraced);

    options.method = GhostMethod::kTraced;
    plan_ghosts(ghosts, options, 6, plans);
    for (const GhostPlan& plan : plans) EXPECT_EQ(plan.drawn, Drawn::kTraced);
}

TEST(FlarePlan, DisabledAndBlockedGhostsTakeNoPart) {
    std::vector<GhostEstimate> ghosts = random_ghosts(4);
    ghosts[1].enabled = false;
    ghosts[2].energy = 0;
    std::vector<GhostPlan> plans(4);
    plan_ghosts(ghosts, {}, 6, plans);
    EXPECT_EQ(plans[1].drawn, Drawn::kDisabled);
    EXPECT_EQ(plans[2].drawn, Drawn::kBlocked);

    for (auto& ghost : ghosts) ghost.energy = 0;
    const PlanTotals totals = plan_ghosts(ghosts, {}, 6, plans);
    EXPECT_EQ(totals.energy_dropped, 0);
    EXPECT_EQ(totals.coarse_displaced, 0);
}

}  // namespace
}  // namespace aureole::lens
