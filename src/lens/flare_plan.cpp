#include "flare_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace aureole::lens {
namespace {

using Drawn = GhostReport::Drawn;

// A ghost is never drawn with fewer pixels of a level than this across its radius.
constexpr double kLeastRadius = 8;

// Indices of the ghosts that light passes, by rising key.
template <class Key>
std::vector<std::size_t> sorted_open(std::span<const GhostPlan> plans, const Key& key) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].drawn == Drawn::kMatrix) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return order;
}

// Minimising sum of area / 4^l + k * energy * displaced share over l gives 2^l in proportion to
// radius * energy^(-1/3).
int level_for(const GhostEstimate& ghost, double fineness, int max_level) {
    const double wanted = ghost.radius_px / (fineness * std::cbrt(ghost.energy));
    const double most = std::min(wanted, ghost.radius_px / kLeastRadius);
    if (!(most >= 2)) return 0;
    return std::min(max_level, static_cast<int>(std::log2(most)));
}

// The coarsest levels whose displacement stays within the budget: by bisection of the logarithm of
// the one multiplier. Returns what they displace.
double choose_levels(std::span<const GhostEstimate> ghosts, double budget, int max_level,
                     std::span<GhostPlan> plans) {
    const auto displaced_at = [&](double fineness) {
        double sum = 0;
        for (std::size_t i = 0; i < ghosts.size(); ++i) {
            if (plans[i].drawn != Drawn::kMatrix) continue;
            plans[i].level = level_for(ghosts[i], fineness, max_level);
            sum += ghosts[i].energy * displaced_by_level(plans[i].level, ghosts[i].radius_px);
        }
        return sum;
    };
    constexpr double kFinest = 1e15;
    double coarse = -40;
    double fine = std::log(kFinest);
    if (!(budget > 0)) return displaced_at(kFinest * kFinest);
    for (int step = 0; step < 48; ++step) {
        const double middle = 0.5 * (coarse + fine);
        (displaced_at(std::exp(middle)) > budget ? coarse : fine) = middle;
    }
    return displaced_at(std::exp(fine));
}

}  // namespace

double displaced_by_level(int level, double radius_px) {
    if (level <= 0) return 0;
    return std::min(2.0, 0.92 * static_cast<double>(1 << level) / radius_px);
}

PlanTotals plan_ghosts(std::span<const GhostEstimate> ghosts, const FlareOptions& options,
                       int max_level, std::span<GhostPlan> plans) {
    PlanTotals totals;
    double energy = 0;
    std::size_t open = 0;
    for (std::size_t i = 0; i < ghosts.size(); ++i) {
        plans[i] = {Drawn::kMatrix, 0};
        if (!ghosts[i].enabled) {
            plans[i].drawn = Drawn::kDisabled;
        } else if (!(ghosts[i].energy > 0)) {
            plans[i].drawn = Drawn::kBlocked;
        } else {
            energy += ghosts[i].energy;
            ++open;
        }
    }
    if (open == 0) return totals;

    double dropped = 0;
    const auto drop = [&](std::size_t i) {
        plans[i].drawn = Drawn::kDropped;
        dropped += ghosts[i].energy;
    };
    const auto kept =
        static_cast<std::size_t>(std::ceil(options.strongest * static_cast<double>(open) - 1e-9));
    const auto by_radiance = sorted_open(plans, [&](std::size_t i) { return ghosts[i].radiance; });
    for (std::size_t i = 0; i + kept < open; ++i) drop(by_radiance[i]);

    const double left = energy - dropped;
    double left_out = 0;
    for (const std::size_t i :
         sorted_open(plans, [&](std::size_t k) { return ghosts[k].energy; })) {
        left_out += ghosts[i].energy;
        if (left_out > options.energy_dropped * left) break;
        drop(i);
    }

    totals.energy_dropped = dropped / energy;
    totals.coarse_displaced =
        choose_levels(ghosts, options.coarse_tolerance * energy, max_level, plans) / energy;

    if (options.method == GhostMethod::kMatrix) return totals;
    double budget = options.method == GhostMethod::kHybrid ? options.hybrid_tolerance * energy : 0;
    const auto error = [&](std::size_t i) {
        return ghosts[i].difference < 0 ? 2 * ghosts[i].energy : ghosts[i].difference;
    };
    for (const std::size_t i : sorted_open(plans, error)) {
        if (options.method == GhostMethod::kTraced || error(i) > budget) {
            plans[i].drawn = Drawn::kTraced;
        }
        budget -= error(i);
    }
    return totals;
}

}  // namespace aureole::lens
