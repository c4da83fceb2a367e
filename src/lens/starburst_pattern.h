// The diffraction pattern of an iris: two rasters around the axis, and a law for all that lies
// beyond them.
#pragma once

#include <optional>

#include "aureole/wave/spectral_psf.h"
#include "lens/starburst_aperture.h"
#include "lens/starburst_profile.h"

namespace aureole::lens {

// Where one description of the pattern hands over to the next, in samples from the axis: the first
// has all up to `full` and nothing from `end` on, smoothly in log rho.
struct Crossover {
    double full = 0;
    double end = 0;
    double before(double rho) const;
};

// Energy per sample of a part of the pattern.
struct PatternRaster {
    wave::PatternIntegral energy;
    double extent_mm = 0;
    double end = 0;  // samples from the axis to the last that hold light
};

struct StarburstPattern {
    // The core, where light varies within a sample of the wide raster; none if that is fine enough.
    std::optional<PatternRaster> core;
    PatternRaster wide;
    Crossover crossover;  // from the wide raster to the laws, in samples of that raster
    // Energy per sample of the wide raster: of straight blades, and of all else.
    SpikeProfile spikes;
    AngularProfile beyond;
};

// Unit energy over all directions.
StarburstPattern starburst_pattern(const Iris& iris, double pupil_diameter_mm,
                                   const RasterPlan& plan, const Obstacles& obstacles);

}  // namespace aureole::lens
