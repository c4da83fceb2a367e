// The starburst of a camera over the field of view.
//
// Off the axis the mounts of a lens cut into its pupil: what is left is the overlap of two or three
// discs, a cat's eye that leans towards the middle of the picture, and so does the star of a light.
// docs/field_varying.md derives and measures it.
#pragma once

#include <optional>

#include "aureole/base/progress.h"
#include "aureole/image/view.h"
#include "aureole/lens/iris.h"
#include "aureole/lens/lens.h"
#include "aureole/lens/starburst.h"
#include "aureole/wave/field_error.h"
#include "aureole/wave/mask_shapes.h"
#include "aureole/wave/varying_psf.h"

namespace aureole::lens {

// The outline of the beam that passes all apertures and the iris, across its direction (x to the
// right, y up as seen by the camera, mm; about the middle of the outline). Light at infinity in
// direction (tan_x, tan_y), right and up. Exact rays, at the d line. Nothing if no light passes, or
// only light of less than a hundredth of the pupil's width.
// The beam must be star-shaped about its middle, as those of all irises without image are.
// Throws InvalidArgument for an iris that is an image.
std::optional<wave::Shape> pupil_outline(const Lens& lens, const Iris& iris, double tan_x,
                                         double tan_y);

struct FieldStarburstOptions {
    // Of the pattern at each node. Rasters of half the side serve: the laws for what lies beyond
    // take over sooner.
    StarburstOptions psf = {2048, 0, color::Illuminant::kD65};
    double spacing_deg = 4;  // between nodes on the axis; 0.5 to 30
    double reach_deg = 6;    // beyond that the star is that of the axis; 0.2 to 45
    int rank = 0;            // as in eye/field_psf.h
};

// starburst_psf() with the pupil of each position. Where no light passes the lens, the star is that
// of the axis. Throws InvalidArgument as starburst_psf() and pupil_outline() do, Cancelled.
wave::VaryingPsf field_starburst(const Lens& lens, const Iris& iris, double pupil_diameter_mm,
                                 const View& view, const FieldStarburstOptions& options = {},
                                 Progress* progress = nullptr);

// How well `psf`, made with the same arguments, follows the stars of `positions` pixels drawn at
// random over the picture, within the reach and beyond the light's own pixel. .3 s each at the
// default raster.
wave::FieldError field_starburst_error(const Lens& lens, const Iris& iris, double pupil_diameter_mm,
                                       const wave::VaryingPsf& psf,
                                       const FieldStarburstOptions& options, int positions);

}  // namespace aureole::lens
