// How far a filtered level is from the exact one, measured on a sample of its texels.
#pragma once

#include <cstdint>

#include "aureole/base/progress.h"
#include "aureole/ibl/cube_map.h"
#include "aureole/ibl/exact.h"

namespace aureole::ibl {

struct FilterErrorOptions {
    // Texels that are compared; all of a level that has no more. >= 1. Some milliseconds each.
    int texels = 768;
    std::uint64_t seed = 1;
};

// Of luminance (color/rgb.h), relative to the level's mean.
struct FilterError {
    int texels = 0;   // that were compared
    double rms = 0;   // root mean square over the level: "rRMSE"
    double bias = 0;  // mean difference
    double most = 0;  // largest |difference| among those compared
};

// Half of the sample is drawn evenly, half in proportion to luminance squared, each texel weighted
// by the inverse of its chance: a sun that covers few texels is not missed, and the estimate of the
// mean square has no bias. With all texels compared it is exact. `level` was filtered with `alpha`
// from the environment of `exact`. Throws InvalidArgument for an empty level, alpha outside (0, 1]
// or no texels, Cancelled.
FilterError measure_filter_error(const ExactFilter& exact, const CubeMap& level, double alpha,
                                 const FilterErrorOptions& options = {},
                                 Progress* progress = nullptr);

}  // namespace aureole::ibl
