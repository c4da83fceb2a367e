// Where sprites end: all of them at one brightness in the picture, the highest at which the light
// that is lost stays below what may be. That is the least area for the light lost: it is the
// condition of Lagrange for the sum of areas.
#pragma once

#include <vector>

#include "aureole/sources/clusters.h"
#include "glare/sprite_kernel.h"

namespace aureole::glare {

// `most_lost`: of the sum over clusters and channels of |energy| that fades out with their radius.
// 0 if nothing may be lost.
double crop_level(const std::vector<sources::Cluster>& clusters, const KernelProfile& profile,
                  double most_lost);

// Distance from the centroid, in pixels, from which on nothing of the cluster reaches `level`.
int crop_radius(const sources::Cluster& cluster, const KernelProfile& profile, double level);

// Bound on what is lost of one cluster, summed over channels.
double energy_lost(const sources::Cluster& cluster, const KernelProfile& profile, int radius);

}  // namespace aureole::glare
