// Regions too wide for one light, cut into several.
#pragma once

#include <vector>

#include "sources/find_lights_regions.h"

namespace aureole::sources {

// The sums of all regions whose r.m.s. radius is at most `widest` (tangents), and of the parts of
// the others: each cut in two through its centroid, across its longer principal axis, until it is
// below, or below one pixel. A pixel on the cut is shared between both sides by how much of it lies
// there, so that the parts change smoothly as a light moves; their sums are always those of the
// region.
std::vector<LightSums> split_regions(const BrightPixels& pixels, const Regions& regions,
                                     double widest);

}  // namespace aureole::sources
