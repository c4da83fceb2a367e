// What the entrance pupil lets through, as a raster for diffraction.
#pragma once

#include "aureole/lens/iris.h"
#include "aureole/wave/aperture.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/psf.h"

namespace aureole::lens {

// The outline of an iris that is no image; `radius_mm` is that of the round stop of its area.
wave::Shape outline_of(const Iris& iris, double radius_mm);

// The square to transform, and how far from the axis its pattern is used.
struct RasterPlan {
    wave::ApertureGrid grid;
    double end_samples = 0;
};
// The larger the square, the finer the directions, and the sooner the raster ends:
// docs/starburst.md derives the rule.
RasterPlan plan_raster(const Iris& iris, double pupil_diameter_mm, int samples,
                       const wave::KernelGrid& kernel);

// Amplitude behind the pupil, and by how much the samples dim its transform.
struct StarburstAperture {
    wave::Field field;
    // 1 / (what the mean over a sample leaves of |F|^2) at k samples from the axis along one axis,
    // k = 0 .. N/2; those of both axes multiply.
    std::vector<float> gain;
};
// What stands between a light and the iris as it is on the axis.
struct Obstacles {
    const Occluder* occluder = nullptr;    // null: clean
    const wave::Shape* outline = nullptr;  // of what is left of the pupil, in place of the iris's
    bool none() const { return occluder == nullptr && outline == nullptr; }
};
StarburstAperture draw_aperture(const Iris& iris, double pupil_diameter_mm,
                                const wave::ApertureGrid& grid, const Obstacles& obstacles);

}  // namespace aureole::lens
