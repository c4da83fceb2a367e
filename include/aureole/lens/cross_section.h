// The cross-section of a lens as a drawing: elements coloured by index, stop, image plane, fans of
// rays, and the way of one ghost. It is the plane of y and z, light coming from the left; faces are
// numbered from 1, as in files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aureole/image/drawing.h"
#include "aureole/lens/ghosts.h"
#include "aureole/lens/lens.h"

namespace aureole::lens {

struct CrossSectionOptions {
    double sheet_width_mm = 240;  // 120 to 2000
    std::string title = {};       // empty: the name of the prescription
    // Angles of the light above the axis, one colour each, d line.
    std::vector<double> field_angles_deg = {0};
    // Across the light that passes; those next to it at the same distances that an aperture ends
    // are drawn up to there, fainter. 0: no rays.
    int rays_per_field = 7;
    std::optional<Bounces> ghost =
        {};              // its way from the first of the angles, over faint image rays
    bool legend = true;  // title, EFL, f-number, colour scale of the index, mm scale
};

// Throws InvalidArgument for angles outside (-90, 90) or more than 32 of them, a ghost that the
// lens has not, fewer than 0 or more than 1000 rays, a sheet out of range.
Drawing cross_section(const Lens& lens, const CrossSectionOptions& options = {});

}  // namespace aureole::lens
