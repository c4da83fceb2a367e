// The cross-section of a lens as a drawing: elements coloured by index, stop, image plane, fans of
// rays, and the way of one ghost.
#pragma once

#include <optional>
#include <vector>

#include "aureole/image/drawing.h"
#include "aureole/lens/ghosts.h"
#include "aureole/lens/lens.h"

namespace aureole::lens {

struct CrossSectionOptions {
    double sheet_width_mm = 240;
    // Angles of the light, one colour each. Rays that an aperture stops end there.
    std::vector<double> field_angles_deg = {0};
    int rays_per_field = 7;
    std::optional<Bounces> ghost;  // its way from the first of the angles, over faint image rays
    bool legend = true;            // name, EFL, f-number, colour scale of the index, mm scale
};

// Throws InvalidArgument for angles outside (-90, 90), a ghost that the lens has not, fewer than 1
// or more than 1000 rays.
Drawing cross_section(const Lens& lens, const CrossSectionOptions& options = {});

}  // namespace aureole::lens
