// Which ghosts are drawn, by which renderer, and how finely.
#pragma once

#include <span>
#include <vector>

#include "aureole/lens/flare.h"
#include "ghost_draw.h"

namespace aureole::lens {

// What is known about one ghost of one light before it is drawn.
struct GhostEstimate {
    double energy = 0;    // sum over the picture's pixels and RGB, gains included; 0: blocked
    double radiance = 0;  // mean of RGB where nothing is clipped
    double radius_px = 0;
    // Sum of |matrix - traced| over the same pixels; < 0: not known.
    double difference = -1;
    bool enabled = true;
};

struct GhostPlan {
    GhostReport::Drawn drawn = GhostReport::Drawn::kDropped;
    int level = 0;
};

struct PlanTotals {
    double energy_dropped = 0;    // share of the energy of all enabled ghosts
    double coarse_displaced = 0;  // the same, bound of what low resolution displaces
};

// How large a share of a ghost's energy drawing at level l >= 1 displaces at most: the edge of
// coverage is averaged over a pixel of 2^l and interpolated by a B-spline, together a kernel of
// mean absolute deviation .46 * 2^l; times the perimeter over the area of a disc, 2 / r.
double displaced_by_level(int level, double radius_px);

// Decides for all ghosts of one light; `plans` has their number. Keeps the strongest by radiance
// (FlareOptions::strongest), then drops the weakest by energy within FlareOptions::energy_dropped;
// gives levels up to `max_level` that minimise the pixels drawn within coarse_tolerance; with
// kHybrid gives to matrix the ghosts that differ least, within hybrid_tolerance.
PlanTotals plan_ghosts(std::span<const GhostEstimate> ghosts, const FlareOptions& options,
                       int max_level, std::span<GhostPlan> plans);

}  // namespace aureole::lens
